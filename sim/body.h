/* body.h: what a robot is made of, and how it moves (equation 1). */
#ifndef BODY_H
#define BODY_H

#include "scenario.h"

struct wheel_kind {
    double gain;      /* its speed at full PWM, in wheel_max */
    double dead_band; /* PWM steps up to which it stands */
};

/* A differential drive. */
struct body_kind {
    double track;     /* distance between the wheels, m */
    double wheel_max; /* speed at full PWM of a wheel with gain 1, m/s */
    double lag;       /* time constant of a wheel's speed, s; 0 = at once */
    struct wheel_kind left, right;
};

struct body {
    double x, y, theta; /* m, rad in [-pi, pi] */
    double left, right; /* wheel speeds, m/s */
    bool held;          /* stalled or without power: still */
};

/* The scenario's body as it is designed. An ideal one is as fast as the motion law may ask. */
struct body_kind body_kind_nominal(const struct scenario *scenario);

/* Robot `id`'s as it was built: with the scenario's scatter S, gains are within 1 +- S, dead bands
 * within S/2 of full PWM, the track is within +-S/5 and the lag within +-S of the nominal one.
 * Draws by the id alone: a robot is the same one in every run. */
struct body_kind body_kind_of(const struct scenario *scenario, uint16_t id);

/* The speed that a wheel settles on at `steps` of PWM, m/s. */
double body_wheel_speed(const struct body_kind *kind, const struct wheel_kind *wheel,
                        int16_t steps);

double body_v(const struct body *body);
double body_omega(const struct body_kind *kind, const struct body *body);

/* Moves on by `seconds` with the motors at `left` and `right` PWM steps. */
void body_move(const struct body_kind *kind, struct body *body, int16_t left, int16_t right,
               double seconds);

#endif
