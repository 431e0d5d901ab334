/* body.h: what a robot is made of, and how it moves (equation 1). */
#ifndef BODY_H
#define BODY_H

#include "scenario.h"

/* A differential drive. */
struct body_kind {
    double track;     /* distance between the wheels, m */
    double wheel_max; /* wheel speed at full PWM, m/s */
    double lag;       /* time constant of a wheel's speed, s; 0 = at once */
};

struct body {
    double x, y, theta; /* m, rad in [-pi, pi] */
    double left, right; /* wheel speeds, m/s */
    bool held;          /* stalled or without power: still */
};

/* The scenario's body. An ideal one is as fast as the motion law may ask. */
struct body_kind body_kind_of(const struct scenario *scenario);

double body_v(const struct body *body);
double body_omega(const struct body_kind *kind, const struct body *body);

/* Moves on by `seconds` with the motors at `left` and `right` PWM steps. */
void body_move(const struct body_kind *kind, struct body *body, int16_t left, int16_t right,
               double seconds);

#endif
