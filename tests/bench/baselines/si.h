/* si.h: from the units of fixed.h to SI units, in floating point and in Q16.16. */
#ifndef SI_H
#define SI_H

#include "fixed.h"
#include "q16.h"

#include <math.h>

static inline float float_metres(int32_t value)
{
    return (float)value / NARROW_PER_M;
}

static inline float float_radians(angle_t angle)
{
    return (float)(int16_t)angle * (float)M_PI / 32768;
}

static inline float float_rate(int16_t rate)
{
    return (float)rate / RATE_ONE;
}

static inline float float_gain(uint16_t gain)
{
    return (float)gain / GAIN_ONE;
}

/* 65,536 / NARROW_PER_M = 16,384 / 1,000. */
static inline q16 q16_metres(int32_t value)
{
    return (q16)((int64_t)value * 16384 / 1000);
}

static inline q16 q16_radians(angle_t angle)
{
    return (q16)((int64_t)(int16_t)angle * Q16_PI / 32768);
}

static inline q16 q16_rate(int16_t rate)
{
    return (q16)rate * (Q16_ONE / RATE_ONE);
}

static inline q16 q16_gain(uint16_t gain)
{
    return (q16)gain * (Q16_ONE / GAIN_ONE);
}

#endif
