/* metrics.h: what a run is judged by, tick by tick, from the true poses. */
#ifndef METRICS_H
#define METRICS_H

#include "scenario.h"
#include "scene.h"
#include "server.h"

/* One robot at one tick: a row of trace.csv. */
struct sample {
    double x, y, theta, v, omega; /* m, rad, m/s, rad/s */
    uint8_t role;                 /* enum role */
    uint16_t vertex;
    bool alive;            /* takes part: has power, and a battery that is not spent */
    double distance_error; /* m; filled in by metrics_tick() */
};

struct metrics;

struct metrics *metrics_new(const struct scenario *scenario);
void metrics_free(struct metrics *metrics);

/* One control tick: one sample per robot in the scenario's order. `leader` is an index or
 * SERVER_NOBODY, `formation` the one in force, of no more vertices than there are robots,
 * `reference` the trajectory's state, `event` true when one took effect in this tick. */
void metrics_tick(struct metrics *metrics, double t, struct sample *samples, size_t leader,
                  const struct scenario_formation *formation,
                  const struct reference_state *reference, bool event);

/* The same between two ticks, or before the first, for those who look on: nothing is counted. */
void metrics_place(struct metrics *metrics, struct sample *samples, size_t leader,
                   const struct scenario_formation *formation,
                   const struct reference_state *reference);

/* What was measured last. */
struct metrics_look {
    double mean_distance_error; /* m, of the live robots */
    bool complete;
    struct scene_pose about; /* what the formation is placed about: the leader, or the last one, or
                                who would be the first */
    size_t vertex_count;
    const struct scene_point *vertices; /* where they are */
};

const struct metrics_look *metrics_look(const struct metrics *metrics);

struct metrics_result {
    size_t leader; /* index, SERVER_NOBODY */
    bool complete;
    double time_to_complete; /* s; negative when it is not */
    uint64_t switches, elections;
    double error_final, error_peak, error_integral; /* m, m, m s */
    double path_length, min_separation;             /* m */
};

struct metrics_result metrics_result(const struct metrics *metrics);

#endif
