/* q16.h: Q16.16 numbers as generic libraries have them: 64-bit products, CORDIC for angles. */
#ifndef Q16_H
#define Q16_H

#include <stdint.h>

typedef int32_t q16;

#define Q16_ONE ((q16)65536)
#define Q16_PI ((q16)205887)

static inline q16 q16_mul(q16 a, q16 b)
{
    return (q16)(((int64_t)a * b + 0x8000) >> 16);
}

/* b is not 0. */
static inline q16 q16_div(q16 a, q16 b)
{
    return (q16)((int64_t)a * Q16_ONE / b);
}

/* The same angle within +-pi rad. */
q16 q16_wrap(q16 angle);

/* Of an angle within +-pi rad. */
void q16_sincos(q16 angle, q16 *sin, q16 *cos);

/* rad, within +-pi. */
q16 q16_atan2(q16 y, q16 x);

#endif
