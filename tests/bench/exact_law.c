#include "exact_law.h"

#include "fixed.h"

#include <math.h>

#define JUDGED_M_S 0.064

double metres(int32_t value)
{
    return (double)value / NARROW_PER_M;
}

static double clamp(double value, double limit)
{
    return fmin(fmax(value, -limit), limit);
}

struct exact_command exact_law(const struct exact_law *in)
{
    double c = cos(in->theta), s = sin(in->theta);
    double ux = in->vel_x + in->k * in->error_x;
    double uy = in->vel_y + in->k * in->error_y;
    double v = clamp(ux * c + uy * s, in->v_max);
    double ux_dot = in->acc_x + in->k * (in->vel_x - v * c);
    double uy_dot = in->acc_y + in->k * (in->vel_y - v * s);
    double turn = (ux * uy_dot - uy * ux_dot) / (ux * ux + uy * uy);
    double off = remainder(atan2(uy, ux) - in->theta, 2 * M_PI);

    return (struct exact_command){
        .v = v,
        .omega = clamp(turn + in->k_theta * off, in->omega_max),
        .u = hypot(ux, uy),
        .judged = hypot(ux, uy) >= JUDGED_M_S && fabs(off) < 0.99 * M_PI,
    };
}
