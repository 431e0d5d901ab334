#include "wheels.h"

#include "limits.h"

#define GAIN_HALF 0x2000 /* of a gain in 1/16,384 */

static void set_wheel(struct wheel *wheel, int16_t wheel_max, uint16_t gain, uint16_t dead)
{
    uint32_t full = (mul16_unsigned((uint16_t)wheel_max, gain) + GAIN_HALF) >> 14;

    wheel->full = full > INT16_MAX ? INT16_MAX : (int16_t)full;
    wheel->dead = (int16_t)dead;
    wheel->gain =
        (((uint32_t)(PWM_STEPS - dead) << 14) + (uint16_t)wheel->full / 2) / (uint16_t)wheel->full;
}

/* 1 - e^-x for x = TICK_MS / lag, as 1 - 1 / (1 + x + x^2 / 2), which is 3 % of it off where the
 * lag is a tick and less where it is longer. */
static uint8_t share_of(uint16_t lag)
{
    uint32_t way = (uint32_t)TICK_MS * lag + TICK_MS * TICK_MS / 2;

    return (uint8_t)((way << 8) / ((uint32_t)lag * lag + way));
}

void wheels_set(struct wheels *wheels, int16_t track, int16_t wheel_max,
                const struct parameters *parameters)
{
    const uint16_t *value = parameters->value;

    wheels->track = value[PARAMETER_TRACK] != 0 ? (int16_t)value[PARAMETER_TRACK] : track;
    wheels->share = share_of(value[PARAMETER_MOTOR_LAG]);
    set_wheel(&wheels->left, wheel_max, value[PARAMETER_LEFT_GAIN],
              value[PARAMETER_LEFT_DEAD_BAND]);
    set_wheel(&wheels->right, wheel_max, value[PARAMETER_RIGHT_GAIN],
              value[PARAMETER_RIGHT_DEAD_BAND]);
}

static uint16_t size_of(int16_t speed)
{
    return speed < 0 ? (uint16_t)-speed : (uint16_t)speed;
}

/* |speed| <= full, so the product stays below 2^28. Rounded alike on both sides of 0. */
static int16_t steps_of(const struct wheel *wheel, int16_t speed)
{
    if (speed == 0)
        return 0;
    int16_t steps = wheel->dead + (int16_t)((size_of(speed) * wheel->gain + GAIN_HALF) >> 14);

    if (steps > PWM_STEPS)
        steps = PWM_STEPS;
    return speed < 0 ? (int16_t)-steps : steps;
}

static int16_t slowed(int16_t speed, int16_t full, int16_t fastest)
{
    return (int16_t)(mul16(speed, full) / fastest);
}

static struct wheel_steps turn(const struct wheels *wheels, struct vec16 speed,
                               struct motion_command *command)
{
    int16_t full = wheels->left.full, fastest = (int16_t)size_of(speed.x);
    int16_t right = (int16_t)size_of(speed.y);

    /* Of the two the one that is asked for more of what it can. */
    if (mul16(right, full) > mul16(fastest, wheels->right.full)) {
        full = wheels->right.full;
        fastest = right;
    }
    if (fastest > full) {
        speed.x = slowed(speed.x, full, fastest);
        speed.y = slowed(speed.y, full, fastest);
        command->v = slowed(command->v, full, fastest);
        command->omega = slowed(command->omega, full, fastest);
    }
    return (struct wheel_steps){steps_of(&wheels->left, speed.x),
                                steps_of(&wheels->right, speed.y)};
}

struct wheel_steps wheels_turn(const struct wheels *wheels, struct motion_command *command)
{
    /* omega b / 2, rounded: Q5.10 rad/s times narrow, halved. */
    int32_t half = (mul16(command->omega, wheels->track) + RATE_ONE) >> 11;

    return turn(wheels, vec_saturate(command->v - half, command->v + half), command);
}

struct wheel_steps wheels_correct(const struct wheels *wheels, int16_t left, int16_t right)
{
    struct motion_command command = {0, 0};

    return turn(wheels, (struct vec16){left, right}, &command);
}

void wheels_follow(const struct wheels *wheels, struct motion_command *moving,
                   const struct motion_command *command)
{
    if (wheels->share == 0) {
        *moving = *command;
        return;
    }
    moving->v += mul16_8_high(minus16(command->v, moving->v), wheels->share);
    moving->omega += mul16_8_high(minus16(command->omega, moving->omega), wheels->share);
}
