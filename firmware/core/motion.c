#include "motion.h"

#include "limits.h"
#include "motion_parts.h"

/* 8 m s in Q.8: far more than a steady state asks for. */
#define PID_INTEGRAL_MAX (8L * NARROW_PER_M * 256)

struct motion_command motion_kanayama(const struct message_mission *mission,
                                      const struct motion_goal *goal, const struct pose *own)
{
    struct sincos heading = sincos_of(own->theta);
    struct vec16 error = motion_error(goal, own);
    struct vec16 seen = {vec_along(error, heading),
                         vec_along(error, (struct sincos){heading.cos, (int16_t)-heading.sin})};
    int32_t forward = motion_by_gain(seen.x, mission->k);
    struct motion_command command = {.v = (int16_t)clamp32(forward, mission->v_max)};

    if (motion_larger_part(goal->velocity) < MOTION_HOLD)
        return command;

    struct course course = course_of(goal->velocity, goal->acceleration);
    int16_t v_r = motion_along(goal->velocity, sincos_of(course.angle), INT16_MAX);
    struct sincos off = sincos_of((angle_t)(course.angle - own->theta));
    /* K_y in Q8.8, as far as it fits; K_y e_y from 1/4,000 to Q5.10, 262 / 2^10 = 1,024 / 4,000. */
    uint32_t k_y = ((uint32_t)mission->k_theta * mission->k_theta) >> 10;
    int32_t sideways = motion_by_gain(seen.y, k_y > UINT16_MAX ? UINT16_MAX : (uint16_t)k_y);
    int32_t curve =
        (((sideways >> 2) * 262) >> 8) + (((int32_t)off.sin * (int32_t)mission->k_theta) >> 13);
    int32_t omega = course.turn + mul16(saturate16(curve), v_r) / NARROW_PER_M;

    command.v = (int16_t)clamp32(forward + mul_q15(v_r, off.cos), mission->v_max);
    command.omega = (int16_t)clamp32(omega, mission->omega_max);
    return command;
}

/* A tick of the integral: error / 50 in Q.8; 1,311 / 2^8 = 256 / 50. */
static int32_t tick_part(int16_t error)
{
    return ((int32_t)error * 1311) >> 8;
}

struct motion_command motion_pid(const struct message_mission *mission,
                                 struct motion_memory *memory, const struct motion_goal *goal,
                                 const struct pose *own)
{
    struct sincos heading = sincos_of(own->theta);
    struct vec16 error = motion_error(goal, own);
    struct vec16 drift = motion_slip(goal, memory->last.v, heading);
    uint32_t k_i = ((uint32_t)mission->k * mission->k) >> 10; /* k^2 / 4 in Q8.8 */

    if (abs32(memory->last.v) < mission->v_max) {
        memory->integral.x = clamp32(memory->integral.x + tick_part(error.x), PID_INTEGRAL_MAX);
        memory->integral.y = clamp32(memory->integral.y + tick_part(error.y), PID_INTEGRAL_MAX);
    }
    struct vec16 sum = {(int16_t)(memory->integral.x >> 8), (int16_t)(memory->integral.y >> 8)};
    struct vec16 slow = {drift.x >> 2, drift.y >> 2};
    struct vec16 u =
        vec_add_scaled(vec_add_scaled(slow, k_i > UINT16_MAX ? UINT16_MAX : (uint16_t)k_i, sum),
                       mission->k, error);
    struct motion_command command = {.v = motion_along(u, heading, mission->v_max)};

    if (motion_larger_part(u) >= MOTION_HOLD) {
        int16_t off = (int16_t)(angle_t)(direction_of(u) - own->theta);
        command.omega =
            (int16_t)clamp32(motion_heading_rate(off, mission->k_theta), mission->omega_max);
    }
    return command;
}

struct motion_command motion_step(const struct message_mission *mission,
                                  struct motion_memory *memory, const struct motion_goal *goal,
                                  const struct pose *own)
{
    switch (mission->law) {
    case LAW_KANAYAMA: memory->last = motion_kanayama(mission, goal, own); break;
    case LAW_PID: memory->last = motion_pid(mission, memory, goal, own); break;
    default: memory->last = motion_fl(mission, goal, own);
    }
    return memory->last;
}
