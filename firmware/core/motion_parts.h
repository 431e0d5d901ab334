/* motion_parts.h: what the laws of motion.h have in common. */
#ifndef MOTION_PARTS_H
#define MOTION_PARTS_H

#include "motion.h"

/* value * gain (Q8.8). */
int32_t motion_by_gain(int16_t value, uint16_t gain);

/* From the robot to the goal, narrow. */
struct vec16 motion_error(const struct motion_goal *goal, const struct pose *own);

/* The larger of |x| and |y|. */
int16_t motion_larger_part(struct vec16 v);

/* k_theta * angle in Q5.10 rad/s; 201 / 2^11 = 2 pi * 1,024 / 65,536 within 3e-4. */
int32_t motion_heading_rate(int16_t angle, uint16_t k_theta);

/* The speed along a heading, within `limit`. */
int16_t motion_along(struct vec16 u, struct sincos heading, int16_t limit);

/* How fast the goal moves away from a robot that moves at v. */
struct vec16 motion_slip(const struct motion_goal *goal, int16_t v, struct sincos heading);

#endif
