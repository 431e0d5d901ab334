/* fixed.h: the fixed-point units of Muster and the arithmetic on them.
 *
 *   wide    int32_t   1/4 mm           positions, +-536 km (the wire carries 24 bits: +-2,097 m)
 *   narrow  int16_t   1/4 mm           differences of positions, +-8.19 m
 *                     1/4 mm/s         speeds, +-8.19 m/s
 *                     1/4 mm/s^2       accelerations, +-8.19 m/s^2
 *   angle   uint16_t  1/65,536 turn    wraps by itself; as int16_t it is the shortest way round
 *   rate    int16_t   Q5.10 rad/s      +-31.99 rad/s
 *   gain    uint16_t  Q8.8 1/s         0 to 255.99
 *   sine    int16_t   Q1.15            +-32,767
 *
 * Every function gives the same bits on the ATmega128 and on a host: no float, no `int`-sized
 * intermediate, no shift of a negative number to the left. */
#ifndef FIXED_H
#define FIXED_H

#include "multiply.h"

#include <stdbool.h>
#include <stdint.h>

_Static_assert((-3 >> 1) == -2, "signed right shift must be arithmetic");

typedef uint16_t angle_t;

#define ANGLE_TURN 65536L
#define ANGLE_QUARTER 16384u
#define RATE_ONE 1024     /* 1 rad/s */
#define GAIN_ONE 256      /* 1 /s */
#define NARROW_PER_M 4000 /* 1 m, 1 m/s or 1 m/s^2 */

struct vec16 {
    int16_t x, y;
};
struct vec32 {
    int32_t x, y;
};
struct sincos {
    int16_t sin, cos;
};

/* A planar pose: wide x and y, heading. */
struct pose {
    struct vec32 at;
    angle_t theta;
};

/* rate * value in the units of value: what v becomes in v' = omega x v. */
static inline int32_t mul_rate(int16_t rate, int16_t value)
{
    return mul24_high(mul16(rate, value) >> 8, 64);
}

static inline int16_t saturate16(int32_t value)
{
    return value > INT16_MAX ? INT16_MAX : value < -INT16_MAX ? -INT16_MAX : (int16_t)value;
}

/* a - b, limited to 16 bits. */
static inline int16_t minus16(int16_t a, int16_t b)
{
    int32_t difference = (int32_t)a - b;

    return difference > INT16_MAX   ? INT16_MAX
           : difference < INT16_MIN ? INT16_MIN
                                    : (int16_t)difference;
}

static inline int16_t no_minimum(int16_t value)
{
    return value == INT16_MIN ? -INT16_MAX : value;
}

static inline int32_t clamp32(int32_t value, int32_t limit)
{
    return value > limit ? limit : value < -limit ? -limit : value;
}

static inline int32_t abs32(int32_t value)
{
    return value < 0 ? -value : value;
}

static inline struct vec32 vec_add(struct vec32 a, struct vec32 b)
{
    return (struct vec32){a.x + b.x, a.y + b.y};
}

static inline struct vec32 vec_sub(struct vec32 a, struct vec32 b)
{
    return (struct vec32){a.x - b.x, a.y - b.y};
}

/* Sine and cosine, error at most 1.01 units of Q1.15 (table of 257 over a quarter turn, linear). */
struct sincos sincos_of(angle_t angle);

/* Where a vector points, and how fast that turns. */
struct course {
    angle_t angle; /* error below 1 unit; 0 for (0, 0) */
    int16_t turn;  /* a rate, limited to +-32,767 */
};

/* The course of v while it changes by w a second: turn = (v x w) / |v|^2, error below 3 units and
 * (0.1 % of |w|, + 5) over |v|. One reciprocal from a table serves both, and nothing is divided.
 * No part is -32,768. */
struct course course_of(struct vec16 v, struct vec16 w);

static inline angle_t direction_of(struct vec16 v)
{
    return course_of(v, (struct vec16){0, 0}).angle;
}

/* (x, y), but -32,767 for -32,768; where a part does not fit into 16 bits both are shortened by a
 * power of two until they do, which keeps the direction within the rounding of the shortened
 * parts. */
struct vec16 vec_saturate(int32_t x, int32_t y);

/* Compares lengths: below, at or above 0 as |a| is less than, equal to or greater than |b|. Exact
 * where every part is narrow; of longer vectors the low bits are left out, of both alike. */
int8_t vec_compare(const struct vec32 *a, const struct vec32 *b);

/* The part of v along the direction whose sine and cosine are given, rounded half up; limited to
 * +-32,767. */
int16_t vec_along(struct vec16 v, struct sincos direction);

/* v turned by the angle whose sine and cosine are given. |v| <= 32,767, for its parts may grow. */
static inline struct vec16 vec_rotate(struct vec16 v, struct sincos by)
{
    return (struct vec16){vec_along(v, (struct sincos){(int16_t)-by.sin, by.cos}),
                          vec_along(v, (struct sincos){by.cos, by.sin})};
}

/* The same, turned the other way. */
static inline struct vec16 vec_rotate_back(struct vec16 v, struct sincos by)
{
    return vec_rotate(v, (struct sincos){(int16_t)-by.sin, by.cos});
}

/* a + gain * b, the gain in Q8.8; saturated with the direction kept. */
struct vec16 vec_add_scaled(struct vec16 a, uint16_t gain, struct vec16 b);

/* v times by / 256, rounded down; v itself where by is 0. */
static inline struct vec16 vec_scale(struct vec16 v, uint8_t by)
{
    return by == 0 ? v : (struct vec16){mul16_8_high(v.x, by), mul16_8_high(v.y, by)};
}

/* |a - b|^2. The differences are narrow. */
uint32_t vec_square_between(struct vec16 a, struct vec16 b);

/* rate * ms as an angle, within rate / 4,096 + 1 units. |ms| <= 1,000. */
int16_t angle_of_rate(int16_t rate, int16_t ms);

/* speed * ms as a distance, narrow, within 2 units. |ms| <= 1,000. */
int16_t distance_of_speed(int16_t speed, int16_t ms);

/* Carries a pose on for `ms` at constant speed and rate, along the chord of the arc (equation 1
 * of the paper, heading taken at the middle). |ms| <= 1,000. */
void pose_advance(struct pose *pose, int16_t speed, int16_t rate, int16_t ms);

#endif
