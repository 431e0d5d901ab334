/* trajectory.h: the reference that the leader follows, as knots in time.
 *
 * Between two knots v and omega run linearly; the pose follows from the first knot along the
 * chord of the arc. Every knot has its own absolute pose, so nothing accumulates. The server
 * sets the knots as far apart as this same function allows, and the robots evaluate it: both
 * sides see the same reference to the bit. */
#ifndef TRAJECTORY_H
#define TRAJECTORY_H

#include "message.h"

/* The reference's state: pose, speed (narrow) and rate, and their derivatives (narrow per s^2,
 * Q5.10 rad/s^2). */
struct reference {
    struct pose pose;
    int16_t v, omega;
    int16_t v_dot, omega_dot;
};

/* The state at `time` (ms), from.time <= time <= to.time, which lie 1..KNOT_SPACING_MAX_MS
 * apart. */
struct reference reference_between(const struct knot *from, const struct knot *to, int32_t time);

/* The state at `time` >= at.time with v and omega held, up to KNOT_SPACING_MAX_MS on; after
 * that the reference stands there. */
struct reference reference_after(const struct knot *at, int32_t time);

#endif
