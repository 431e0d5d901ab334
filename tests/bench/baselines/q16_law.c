#include "q16_law.h"

#define HOLD ((q16)524) /* 8 mm/s */

static q16 clamp(q16 value, q16 limit)
{
    return value > limit ? limit : value < -limit ? -limit : value;
}

static q16 magnitude(q16 value)
{
    return value < 0 ? -value : value;
}

struct q16_command q16_law(const struct q16_law *in)
{
    q16 s, c;
    q16 ux = in->vel_x + q16_mul(in->k, in->goal_x - in->x);
    q16 uy = in->vel_y + q16_mul(in->k, in->goal_y - in->y);

    q16_sincos(in->theta, &s, &c);
    struct q16_command command = {.v = clamp(q16_mul(ux, c) + q16_mul(uy, s), in->v_max)};

    if (magnitude(ux) < HOLD && magnitude(uy) < HOLD)
        return command;

    q16 ux_dot = in->acc_x + q16_mul(in->k, in->vel_x - q16_mul(command.v, c));
    q16 uy_dot = in->acc_y + q16_mul(in->k, in->vel_y - q16_mul(command.v, s));
    q16 cross = q16_mul(ux, uy_dot) - q16_mul(uy, ux_dot);
    q16 turn = q16_div(cross, q16_mul(ux, ux) + q16_mul(uy, uy));
    q16 off = q16_wrap(q16_atan2(uy, ux) - in->theta);

    command.omega = clamp(turn + q16_mul(in->k_theta, off), in->omega_max);
    return command;
}
