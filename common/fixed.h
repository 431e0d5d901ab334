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

static inline int32_t mul16(int16_t a, int16_t b)
{
    return (int32_t)a * b;
}

/* a * b in Q1.15, rounded half up. a = b = -32,768 is the one input that does not fit. */
static inline int16_t mul_q15(int16_t a, int16_t b)
{
    return (int16_t)((mul16(a, b) + 0x4000) >> 15);
}

/* rate * value in the units of value: what v becomes in v' = omega x v. */
static inline int32_t mul_rate(int16_t rate, int16_t value)
{
    return mul16(rate, value) >> 10;
}

static inline int16_t saturate16(int32_t value)
{
    return value > INT16_MAX ? INT16_MAX : value < -INT16_MAX ? -INT16_MAX : (int16_t)value;
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

/* A vector's direction, and what it takes to divide by its length: one reciprocal from a table
 * serves both, and nothing is divided. */
struct polar {
    angle_t angle;    /* error below 1 unit; 0 for (0, 0) */
    uint8_t up;       /* larger part * 2^up lies in [2^15, 2^16) */
    bool steep;       /* |y| > |x| */
    uint16_t inverse; /* 2^30 / (larger part * 2^up); 0 for (0, 0) */
    uint16_t ratio;   /* smaller part / larger part, Q0.16 */
    uint16_t falloff; /* 1 / (1 + ratio^2), Q1.15 */
};

struct polar polar_of(struct vec16 v);
angle_t direction_of(struct vec16 v);

/* (v x w) / |v|^2 as a rate: how fast v turns when it changes by w a second. `p` is v's. Error
 * below 2 units and (0.1 % of |w|, + 5) over |v|. */
int32_t polar_turn(const struct polar *p, struct vec16 v, struct vec16 w);

/* The vector shortened until both parts lie in +-32,767; keeps its direction within the
 * rounding of the shortened parts. What fits is returned as it is. */
struct vec16 vec_saturate(struct vec32 v);

/* Compares lengths: below, at or above 0 as |a| is less than, equal to or greater than |b|. Exact
 * where every part is narrow; of longer vectors the low bits are left out, of both alike. */
int8_t vec_compare(struct vec32 a, struct vec32 b);

/* (v.x, v.y) turned by the angle whose sine and cosine are given: parts may grow by sqrt(2). */
struct vec32 vec_rotate(struct vec16 v, struct sincos by);

/* The same, turned the other way. */
struct vec32 vec_rotate_back(struct vec16 v, struct sincos by);

/* rate * ms as an angle. |ms| <= 1,000. */
int16_t angle_of_rate(int16_t rate, int16_t ms);

/* speed * ms as a distance, narrow. |ms| <= 1,000. */
int16_t distance_of_speed(int16_t speed, int16_t ms);

/* A pose carried on for `ms` at constant speed and rate, along the chord of the arc (equation 1
 * of the paper, heading taken at the middle). |ms| <= 1,000. */
struct pose pose_advance(struct pose from, int16_t speed, int16_t rate, int16_t ms);

#endif
