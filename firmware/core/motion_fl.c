/* motion_fl.c: the feedback-linearising law. The ATmega128 has it in its own instructions,
 * firmware/atmega128/motion_fl.S, to the same bit. */
#include "motion_parts.h"

struct motion_command motion_fl(const struct message_mission *mission,
                                const struct motion_goal *goal, const struct pose *own)
{
    struct sincos heading = sincos_of(own->theta);
    struct vec16 u = vec_add_scaled(goal->velocity, mission->k, motion_error(goal, own));
    struct motion_command command = {.v = motion_along(u, heading, mission->v_max)};

    if (motion_larger_part(u) < MOTION_HOLD)
        return command;

    struct vec16 u_dot =
        vec_add_scaled(goal->acceleration, mission->k, motion_slip(goal, command.v, heading));
    struct course course = course_of(u, u_dot);
    int16_t off = (int16_t)(angle_t)(course.angle - own->theta);
    int32_t omega = course.turn + motion_heading_rate(off, mission->k_theta);

    command.omega = (int16_t)clamp32(omega, mission->omega_max);
    return command;
}
