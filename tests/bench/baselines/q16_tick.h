/* q16_tick.h: what a follower reckons in a control tick, in Q16.16 and SI units: where it
 * and its leader are now, which vertex is its own, how to drive there. */
#ifndef Q16_TICK_H
#define Q16_TICK_H

#include "q16_allocation.h"
#include "q16_law.h"

/* A robot as it was `age` ms ago. */
struct q16_state {
    q16 x, y, theta, v, omega;
    uint16_t age;
};

struct q16_tick {
    struct q16_state own, leader;
    struct q16_contest contest; /* without the poses, which the tick works out */
    struct q16_law law;         /* the gains and limits */
    q16 track, wheel_max;       /* m, m/s */
};

struct q16_wheels {
    q16 left, right; /* parts of full scale */
    uint16_t held;   /* vertex, 0 = none */
};

/* `taboo` as for q16_allocate(). */
struct q16_wheels q16_tick(struct q16_tick *tick, bool *taboo);

#endif
