#include "trajectory.h"

/* Change per second of a quantity that goes from `a` to `b` in `ms`. */
static int16_t slope(int16_t a, int16_t b, int16_t ms)
{
    return saturate16(((int32_t)b - a) * 1000 / ms);
}

struct reference reference_between(const struct knot *from, const struct knot *to, int32_t time)
{
    int16_t span = (int16_t)(to->time - from->time);
    int16_t since = (int16_t)(time - from->time);
    int32_t v_part = ((int32_t)to->v - from->v) * since / span;
    int32_t omega_part = ((int32_t)to->omega - from->omega) * since / span;
    struct reference r = {
        .v = (int16_t)(from->v + v_part),
        .omega = (int16_t)(from->omega + omega_part),
        .v_dot = slope(from->v, to->v, span),
        .omega_dot = slope(from->omega, to->omega, span),
        .pose = from->pose,
    };
    /* The means over the time gone by turn and carry the pose as far as the varying ones do. */
    pose_advance(&r.pose, (int16_t)(from->v + v_part / 2), (int16_t)(from->omega + omega_part / 2),
                 since);
    return r;
}

struct reference reference_after(const struct knot *at, int32_t time)
{
    struct reference r = {.pose = at->pose, .v = at->v, .omega = at->omega};
    int32_t since = time - at->time;

    if (since > KNOT_SPACING_MAX_MS) {
        since = KNOT_SPACING_MAX_MS;
        r.v = r.omega = 0;
    }
    pose_advance(&r.pose, at->v, at->omega, (int16_t)since);
    return r;
}
