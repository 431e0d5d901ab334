/* float_tick.h: what a follower reckons in a control tick, in floating point and SI units: where it
 * and its leader are now, which vertex is its own, how to drive there. */
#ifndef FLOAT_TICK_H
#define FLOAT_TICK_H

#include "float_allocation.h"
#include "float_law.h"

/* A robot as it was `age` ms ago. */
struct float_state {
    float x, y, theta, v, omega;
    uint16_t age;
};

struct float_tick {
    struct float_state own, leader;
    struct float_contest contest; /* without the poses, which the tick works out */
    struct float_law law;         /* the gains and limits */
    float track, wheel_max;       /* m, m/s */
};

struct float_wheels {
    float left, right; /* parts of full scale */
    uint16_t held;     /* vertex, 0 = none */
};

/* `taboo` as for float_allocate(). */
struct float_wheels float_tick(struct float_tick *tick, bool *taboo);

#endif
