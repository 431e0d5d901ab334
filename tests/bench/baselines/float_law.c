#include "float_law.h"

#include <math.h>

#define HOLD_M_S 0.008f

static float clamp(float value, float limit)
{
    return value > limit ? limit : value < -limit ? -limit : value;
}

static float wrap(float angle)
{
    while (angle > (float)M_PI)
        angle -= 2 * (float)M_PI;
    while (angle < -(float)M_PI)
        angle += 2 * (float)M_PI;
    return angle;
}

struct float_command float_law(const struct float_law *in)
{
    float c = cosf(in->theta);
    float s = sinf(in->theta);
    float ux = in->vel_x + in->k * (in->goal_x - in->x);
    float uy = in->vel_y + in->k * (in->goal_y - in->y);
    struct float_command command = {.v = clamp(ux * c + uy * s, in->v_max)};

    if (fabsf(ux) < HOLD_M_S && fabsf(uy) < HOLD_M_S)
        return command;

    float ux_dot = in->acc_x + in->k * (in->vel_x - command.v * c);
    float uy_dot = in->acc_y + in->k * (in->vel_y - command.v * s);
    float turn = (ux * uy_dot - uy * ux_dot) / (ux * ux + uy * uy);
    float off = wrap(atan2f(uy, ux) - in->theta);

    command.omega = clamp(turn + in->k_theta * off, in->omega_max);
    return command;
}
