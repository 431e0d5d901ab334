/* exact_fight.h: a fight (fights.h) in double, to judge by. */
#ifndef EXACT_FIGHT_H
#define EXACT_FIGHT_H

#include "fights.h"

#include <stdbool.h>

struct point {
    double x, y; /* m */
};

/* A robot at one moment: m, rad, m/s, rad/s. */
struct motion {
    struct point at;
    double theta, v, omega;
};

/* Where it is `age` s later, along the chord of its arc. */
void motion_advance(struct motion *motion, double age);

struct exact_fight {
    const struct fight *fight;
    struct motion base;
    struct point own;
    struct point vertex[VERTICES_MAX_CHIP + 1];   /* [0] is none, as below */
    double own_distance[VERTICES_MAX_CHIP + 1];   /* m */
    double rival_distance[VERTICES_MAX_CHIP + 1]; /* of the closest that holds it */
    bool taboo[VERTICES_MAX_CHIP + 1];
};

/* The poses of the leader and of the robot as the fight has them. */
struct motion exact_base(const struct fight *fight);
struct motion exact_own(const struct fight *fight);

void exact_prepare(struct exact_fight *exact, const struct fight *fight, const struct motion *base,
                   struct point own);

/* The vertex that Algorithm 1 comes to, 0 for none. */
uint16_t exact_allocate(struct exact_fight *exact);

/* `chosen` is not `right`, and yet no fault: distances are nearly the same. */
bool exact_is_tied(const struct exact_fight *exact, uint16_t chosen, uint16_t right);

#endif
