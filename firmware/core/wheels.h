/* wheels.h: from speeds to the set-points of two wheels that are not quite alike.
 *
 * The mission says how fast a wheel turns at full PWM and how far apart the two are. The robot's
 * parameters correct that: wheel i's full speed is wheel_max * gain_i, and it begins to turn at
 * dead_band_i of PWM_STEPS. */
#ifndef WHEELS_H
#define WHEELS_H

#include "motion.h"
#include "parameters.h"

struct wheel {
    int16_t full;  /* its speed at PWM_STEPS, narrow, > 0 */
    int16_t dead;  /* steps at which it begins to turn */
    uint32_t gain; /* steps from there on, per speed, Q18.14 */
};

struct wheels {
    int16_t track; /* narrow */
    uint8_t share; /* of the way to the speed commanded that a tick takes it, 1/256; 0 = all */
    struct wheel left, right;
};

/* Wheel speeds as PWM steps. */
struct wheel_steps {
    int16_t left, right; /* +-PWM_STEPS */
};

/* Here is what has to be divided: once a mission or set of parameters, and not in every tick.
 * `track`, unless the parameters have their own, and `wheel_max` are narrow and > 0. */
void wheels_set(struct wheels *wheels, int16_t track, int16_t wheel_max,
                const struct parameters *parameters);

/* v -+ omega b / 2 in steps. Where a wheel would have to turn faster than it can, both are slowed
 * alike, so the curve stays, and `command` is slowed with them. */
struct wheel_steps wheels_turn(const struct wheels *wheels, struct motion_command *command);

/* The same for wheels that are to turn at `left` and `right` of PWM_STEPS, whose full speed was set
 * as PWM_STEPS: what the parameters make of it. */
struct wheel_steps wheels_correct(const struct wheels *wheels, int16_t left, int16_t right);

/* What the wheels do a tick after they did `moving`, `command` being in force: they follow it with
 * the time constant motor_lag. */
void wheels_follow(const struct wheels *wheels, struct motion_command *moving,
                   const struct motion_command *command);

#endif
