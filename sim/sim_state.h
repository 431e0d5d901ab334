/* sim_state.h: a simulation's own memory, seen by its parts only.
 *
 *   sim.c       building, the tick, the run
 *   steering.c  what those who look on may do, and the run's pace
 */
#ifndef SIM_STATE_H
#define SIM_STATE_H

#include "body.h"
#include "crew.h"
#include "link_loss.h"
#include "metrics.h"
#include "mocap.h"
#include "onlookers.h"
#include "pace.h"
#include "plan.h"
#include "radio.h"
#include "record.h"
#include "robot.h"
#include "sim.h"
#include "steer.h"

/* One robot: what computes, what moves, and what passes between them in a period. */
struct machine {
    struct sim_robot *robot;
    struct body_kind kind;
    struct body body;
    struct radio_pipe *down, *up;
    bool powered;
    bool booting;
    bool stalled;
    int16_t left, right; /* set-points in force */
    struct robot_period period;
    struct link_loss loss;  /* of the last second */
    struct robot_load load; /* a second ago */
};

struct sim {
    const struct scenario *scenario;
    const struct sim_options *options;
    struct plan *plan;
    struct server *server;
    struct drawings *drawings;
    struct steer steer;
    struct avr_image *image;
    struct link_timing timing;
    double actuation; /* s after the start of a period */
    struct mocap mocap;
    struct mocap_sample sample; /* the newest at the end of this period */
    struct radio radio;
    uint64_t tick;
    struct machine *machine;
    struct sample *samples;
    struct metrics *metrics;
    struct scene scene; /* of the last row */
    struct record *record;
    struct crew *crew;
    struct reference_state reference;
    bool event;    /* one took effect since the last row */
    int32_t until; /* mission time of the last row, ms */
    struct pace pace;
    bool ended; /* by one who looks on */
};

/* sim.c: takes what the core reports and orders. False when there is no memory for a robot. */
bool sim_drain(struct sim *sim);

/* The scene as it is between two ticks, for those who look on alone. */
void sim_show(struct sim *sim);

/* steering.c */
void steering_begin(struct sim *sim);

/* After each tick: does what those who look on ask for, until the next tick is due, the run was
 * ended, or *stop is true. False when there is no memory for a robot. */
bool steering_wait(struct sim *sim, const volatile bool *stop);

/* Says how it stands, in a word. */
void steering_tell(struct sim *sim, const char *phase, bool over);

#endif
