/* reference.h: the reference trajectory, integrated in double from the scenario's expressions. */
#ifndef SCENARIO_REFERENCE_H
#define SCENARIO_REFERENCE_H

#include <stdbool.h>
#include <stddef.h>

struct expression;

/* The `trajectory:` of a scenario: start pose, v(t), omega(t). */
struct trajectory;

struct reference_state {
    double t, x, y, theta; /* s, m, rad (not wrapped) */
    double v, omega;       /* m/s, rad/s at t */
};

/* From a start pose (m, m, rad) and two expressions in t, which become the trajectory's unless
 * the result is NULL for want of memory. */
struct trajectory *trajectory_new(const double start[3], struct expression *v,
                                  struct expression *omega);

void trajectory_free(struct trajectory *trajectory);

/* The state at t = 0. */
struct reference_state trajectory_start(struct trajectory *trajectory);

/* The state at the next control tick (TICK_MS), equation 1 integrated by RK4 in steps of 5 ms.
 * Values that are not finite come out as such: scenario_read() has refused them. */
struct reference_state trajectory_step(struct trajectory *trajectory,
                                       const struct reference_state *from);

#endif
