/* motion_parts.h: what the laws of motion.h have in common. */
#ifndef MOTION_PARTS_H
#define MOTION_PARTS_H

#include "motion.h"

/* value * gain (Q8.8). */
static inline int32_t by_gain(int16_t value, uint16_t gain)
{
    return mul16_mixed(value, gain) >> 8;
}

/* From the robot to the goal, narrow. */
static inline struct vec16 motion_error(const struct motion_goal *goal, const struct pose *own)
{
    return vec_saturate(goal->at.x - own->at.x, goal->at.y - own->at.y);
}

static inline int16_t larger_part(struct vec16 v)
{
    int16_t x = v.x < 0 ? (int16_t)-v.x : v.x;
    int16_t y = v.y < 0 ? (int16_t)-v.y : v.y;

    return x > y ? x : y;
}

/* k_theta * angle in Q5.10 rad/s; 201 / 2^11 = 2 pi * 1,024 / 65,536 within 3e-4. */
static inline int32_t heading_rate(int16_t angle, uint16_t k_theta)
{
    return mul24_high(by_gain(angle, k_theta), 201) >> 3;
}

/* The speed along a heading, within `limit`. */
static inline int16_t along(struct vec16 u, struct sincos heading, int16_t limit)
{
    int16_t v = vec_along(u, heading);

    return v > limit ? limit : v < -limit ? (int16_t)-limit : v;
}

/* How fast the goal moves away from a robot that moves at v. */
static inline struct vec16 slip(const struct motion_goal *goal, int16_t v, struct sincos heading)
{
    return (struct vec16){minus16(goal->velocity.x, mul_q15(v, heading.cos)),
                          minus16(goal->velocity.y, mul_q15(v, heading.sin))};
}

#endif
