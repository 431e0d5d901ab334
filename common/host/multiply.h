/* multiply.h (host): the products that fixed.h is made of, in plain C.
 *
 * The twin of firmware/atmega128/multiply.h, which has them in the chip's own instructions;
 * tests/avr holds the two together. */
#ifndef MULTIPLY_H
#define MULTIPLY_H

#include <stdint.h>

static inline uint16_t mul8(uint8_t a, uint8_t b)
{
    return (uint16_t)(a * b);
}

static inline int32_t mul16(int16_t a, int16_t b)
{
    return (int32_t)a * b;
}

static inline uint32_t square16(int16_t a)
{
    return (uint32_t)((int32_t)a * a);
}

/* a * b / 256, rounded down. */
static inline int16_t mul16_8_high(int16_t a, uint8_t b)
{
    return (int16_t)(((int32_t)a * b) >> 8);
}

static inline uint32_t mul16_unsigned(uint16_t a, uint16_t b)
{
    return (uint32_t)a * b;
}

static inline int32_t mul16_mixed(int16_t a, uint16_t b)
{
    return (int32_t)a * (int32_t)b;
}

/* a * b in Q1.15, rounded half up. a = b = -32,768 is the one input that does not fit. */
static inline int16_t mul_q15(int16_t a, int16_t b)
{
    return (int16_t)((mul16(a, b) + 0x4000) >> 15);
}

/* value * by / 256, rounded down; `value` has 24 bits. With by = 2^n a shift to the right by
 * 8 - n. */
static inline int32_t mul24_high(int32_t value, uint8_t by)
{
    return (value * by) >> 8;
}

#endif
