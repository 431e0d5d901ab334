/* plan.h: a scenario in the units of the wire, ready for the server core. */
#ifndef PLAN_H
#define PLAN_H

#include "scenario.h"
#include "server.h"

/* What the robots' bodies and links add to it. */
struct plan_robot {
    double track;       /* distance between the wheels, m */
    double wheel_max;   /* wheel speed at full PWM, m/s */
    uint8_t latency_ms; /* at least, from a pose's measurement to the tick that uses it */
};

/* Vertices of a formation that is drawn, at the most: what any robot can hold. */
#define DRAWING_VERTICES_MAX VERTICES_MAX_CHIP

struct plan {
    struct server_config config; /* points into this plan and into the scenario */
    struct server_robot *robots;
    struct server_formation *formations;
    struct polar_vertex *vertices;
    struct knot *knots;
};

/* NULL when there is no memory. The scenario must outlive the plan. */
struct plan *plan_new(const struct scenario *scenario, const struct plan_robot *robot,
                      uint64_t seed);

/* A formation in the units of the wire; its vertices go to `vertices`. */
struct server_formation plan_formation(const struct scenario_formation *formation,
                                       struct polar_vertex *vertices);

void plan_free(struct plan *plan);

#endif
