#include "motion.h"

#include "limits.h"

/* value * gain (Q8.8). */
static int32_t by_gain(int16_t value, uint16_t gain)
{
    return ((int32_t)value * (int32_t)gain) >> 8;
}

/* a + gain * b, saturated with its direction kept. */
static struct vec16 add_scaled(struct vec16 a, uint16_t gain, struct vec16 b)
{
    return vec_saturate((struct vec32){a.x + by_gain(b.x, gain), a.y + by_gain(b.y, gain)});
}

static int16_t larger_part(struct vec16 v)
{
    int16_t x = v.x < 0 ? (int16_t)-v.x : v.x;
    int16_t y = v.y < 0 ? (int16_t)-v.y : v.y;

    return x > y ? x : y;
}

/* (u x u_dot) / |u|^2 in Q5.10 rad/s. u is first scaled to parts below 2^14, the larger at least
 * 2^13, so that numerator and denominator keep their bits at every length of u. */
static int32_t turn_rate(struct vec16 u, struct vec16 u_dot)
{
    int8_t up = 0;

    while (larger_part(u) >= 1 << 14) {
        u.x >>= 1;
        u.y >>= 1;
        up--;
    }
    while (larger_part(u) < 1 << 13) {
        u.x = (int16_t)(u.x * 2);
        u.y = (int16_t)(u.y * 2);
        up++;
    }
    int32_t cross = mul16(u.x, u_dot.y) - mul16(u.y, u_dot.x);
    uint16_t square = (uint16_t)((mul16(u.x, u.x) + mul16(u.y, u.y)) >> 13);
    int32_t quotient = cross / (int32_t)square; /* of cross / |u|^2, times 2^13 */

    return up >= 3 ? quotient * ((int32_t)1 << (up - 3)) : quotient >> (3 - up);
}

/* k_theta * angle in Q5.10 rad/s; 201 / 2^11 = 2 pi * 1,024 / 65,536 within 3e-4. */
static int32_t heading_rate(int16_t angle, uint16_t k_theta)
{
    return (by_gain(angle, k_theta) * 201) >> 11;
}

struct motion_command motion_fl(const struct message_mission *mission,
                                const struct motion_goal *goal, angle_t theta)
{
    struct sincos heading = sincos_of(theta);
    struct vec16 u = add_scaled(goal->velocity, mission->k, vec_saturate(goal->error));
    int32_t along = (mul16(u.x, heading.cos) + mul16(u.y, heading.sin)) >> 15;
    struct motion_command command = {.v = (int16_t)clamp32(along, mission->v_max)};

    if (larger_part(u) < MOTION_HOLD)
        return command;

    struct vec16 own = {mul_q15(command.v, heading.cos), mul_q15(command.v, heading.sin)};
    struct vec16 lag = vec_saturate((struct vec32){(int32_t)goal->velocity.x - own.x,
                                                   (int32_t)goal->velocity.y - own.y});
    struct vec16 u_dot = add_scaled(goal->acceleration, mission->k, lag);
    int16_t off = (int16_t)(angle_t)(direction_of(u) - theta);
    int32_t omega = turn_rate(u, u_dot) + heading_rate(off, mission->k_theta);

    command.omega = (int16_t)clamp32(omega, mission->omega_max);
    return command;
}

/* speed / wheel_max in PWM steps, rounded away from 0 alike on both sides. */
static int16_t steps_of(int16_t speed, int16_t wheel_max)
{
    int32_t scaled = mul16(speed, PWM_STEPS);
    int32_t half = wheel_max / 2;

    return (int16_t)((scaled + (scaled < 0 ? -half : half)) / wheel_max);
}

struct wheel_steps motion_wheels(const struct message_mission *mission,
                                 struct motion_command *command)
{
    /* omega b / 2: Q5.10 rad/s times narrow, halved. */
    int32_t half = mul16(command->omega, mission->track) / (2 * RATE_ONE);
    struct vec16 wheel = vec_saturate((struct vec32){command->v - half, command->v + half});
    int16_t fastest = larger_part(wheel);

    if (fastest > mission->wheel_max) {
        wheel.x = (int16_t)(mul16(wheel.x, mission->wheel_max) / fastest);
        wheel.y = (int16_t)(mul16(wheel.y, mission->wheel_max) / fastest);
        command->v = (int16_t)(mul16(command->v, mission->wheel_max) / fastest);
        command->omega = (int16_t)(mul16(command->omega, mission->wheel_max) / fastest);
    }
    return (struct wheel_steps){steps_of(wheel.x, mission->wheel_max),
                                steps_of(wheel.y, mission->wheel_max)};
}
