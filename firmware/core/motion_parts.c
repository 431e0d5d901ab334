#include "motion_parts.h"

int32_t motion_by_gain(int16_t value, uint16_t gain)
{
    return mul16_mixed(value, gain) >> 8;
}

struct vec16 motion_error(const struct motion_goal *goal, const struct pose *own)
{
    return vec_saturate(goal->at.x - own->at.x, goal->at.y - own->at.y);
}

int16_t motion_larger_part(struct vec16 v)
{
    int16_t x = v.x < 0 ? (int16_t)-v.x : v.x;
    int16_t y = v.y < 0 ? (int16_t)-v.y : v.y;

    return x > y ? x : y;
}

int32_t motion_heading_rate(int16_t angle, uint16_t k_theta)
{
    return mul24_high(motion_by_gain(angle, k_theta), 201) >> 3;
}

int16_t motion_along(struct vec16 u, struct sincos heading, int16_t limit)
{
    int16_t v = vec_along(u, heading);

    return v > limit ? limit : v < -limit ? (int16_t)-limit : v;
}

struct vec16 motion_slip(const struct motion_goal *goal, int16_t v, struct sincos heading)
{
    return (struct vec16){minus16(goal->velocity.x, mul_q15(v, heading.cos)),
                          minus16(goal->velocity.y, mul_q15(v, heading.sin))};
}
