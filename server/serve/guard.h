/* guard.h: whether robots are where they may be. The paper's robots avoid nobody: in random fleets
 * of eight their centres came within centimetres of one another. */
#ifndef GUARD_H
#define GUARD_H

#include <stdbool.h>
#include <stddef.h>

struct guard_limits {
    bool fenced;
    double fence[4];   /* x_min, y_min, x_max, y_max, m, inclusive */
    double separation; /* m between centres; 0: no matter how near */
};

struct guard_robot {
    bool placed; /* where it is is known */
    double x, y; /* m */
};

enum guard_finding { GUARD_GOOD, GUARD_FENCE, GUARD_SEPARATION };

struct guard_alarm {
    enum guard_finding finding;
    size_t robot;    /* index */
    size_t other;    /* separation: of the second one */
    double distance; /* beyond the fence, or between the two, m */
};

/* The worst that there is: a robot beyond the fence, or the nearest pair. */
struct guard_alarm guard_judge(const struct guard_limits *limits, const struct guard_robot *robots,
                               size_t count);

#endif
