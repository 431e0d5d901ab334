/* multiply.h (ATmega128): the products that fixed.h is made of, in the chip's own instructions.
 *
 * The twin of common/host/multiply.h, which has them in plain C; tests/avr holds the two together.
 * The compiler multiplies 16 by 16 bits with a call and 40 to 50 cycles; these take about 20. The
 * two that are wanted everywhere are called: in line they would cost 260 bytes. MUL leaves its
 * result in r1:r0, and r1 has to be zero again afterwards. */
#ifndef MULTIPLY_H
#define MULTIPLY_H

#include <stdint.h>

static inline uint16_t mul8(uint8_t a, uint8_t b)
{
    uint16_t product;

    __asm__("mul %[a], %[b]\n\t"
            "movw %[p], r0\n\t"
            "clr r1"
            : [p] "=r"(product)
            : [a] "r"(a), [b] "r"(b)
            : "r0");
    return product;
}

int32_t mul16(int16_t a, int16_t b);

static inline uint32_t square16(int16_t a)
{
    uint32_t product;
    uint8_t zero;

    /* Twice the product of the bytes, whose carry is its sign. */
    __asm__("clr %[zero]\n\t"
            "muls %B[a], %B[a]\n\t"
            "movw %C[p], r0\n\t"
            "mul %A[a], %A[a]\n\t"
            "movw %A[p], r0\n\t"
            "fmulsu %B[a], %A[a]\n\t"
            "sbc %D[p], %[zero]\n\t"
            "add %B[p], r0\n\t"
            "adc %C[p], r1\n\t"
            "adc %D[p], %[zero]\n\t"
            "clr r1"
            : [p] "=&r"(product), [zero] "=&r"(zero)
            : [a] "a"(a)
            : "r0");
    return product;
}

/* a * b / 256, rounded down. */
static inline int16_t mul16_8_high(int16_t a, uint8_t b)
{
    int16_t high;

    __asm__("mulsu %B[a], %[b]\n\t"
            "movw %[h], r0\n\t"
            "mul %A[a], %[b]\n\t"
            "add %A[h], r1\n\t"
            "clr r1\n\t"
            "adc %B[h], r1"
            : [h] "=&r"(high)
            : [a] "a"(a), [b] "a"(b)
            : "r0");
    return high;
}

static inline uint32_t mul16_unsigned(uint16_t a, uint16_t b)
{
    uint32_t product;
    uint8_t zero;

    __asm__("clr %[zero]\n\t"
            "mul %B[a], %B[b]\n\t"
            "movw %C[p], r0\n\t"
            "mul %A[a], %A[b]\n\t"
            "movw %A[p], r0\n\t"
            "mul %B[a], %A[b]\n\t"
            "add %B[p], r0\n\t"
            "adc %C[p], r1\n\t"
            "adc %D[p], %[zero]\n\t"
            "mul %A[a], %B[b]\n\t"
            "add %B[p], r0\n\t"
            "adc %C[p], r1\n\t"
            "adc %D[p], %[zero]\n\t"
            "clr r1"
            : [p] "=&r"(product), [zero] "=&r"(zero)
            : [a] "r"(a), [b] "r"(b)
            : "r0");
    return product;
}

static inline int32_t mul16_mixed(int16_t a, uint16_t b)
{
    int32_t product;
    uint8_t zero;

    __asm__("clr %[zero]\n\t"
            "mulsu %B[a], %B[b]\n\t"
            "movw %C[p], r0\n\t"
            "mul %A[a], %A[b]\n\t"
            "movw %A[p], r0\n\t"
            "mulsu %B[a], %A[b]\n\t"
            "sbc %D[p], %[zero]\n\t"
            "add %B[p], r0\n\t"
            "adc %C[p], r1\n\t"
            "adc %D[p], %[zero]\n\t"
            "mul %A[a], %B[b]\n\t"
            "add %B[p], r0\n\t"
            "adc %C[p], r1\n\t"
            "adc %D[p], %[zero]\n\t"
            "clr r1"
            : [p] "=&r"(product), [zero] "=&r"(zero)
            : [a] "a"(a), [b] "a"(b)
            : "r0");
    return product;
}

/* a * b in Q1.15, rounded half up. a = b = -32,768 is the one input that does not fit. */
int16_t mul_q15(int16_t a, int16_t b);

/* value * by / 256, rounded down; `value` has 24 bits. With by = 2^n a shift to the right by
 * 8 - n. */
static inline int32_t mul24_high(int32_t value, uint8_t by)
{
    int32_t high;

    __asm__("mulsu %C[v], %[by]\n\t"
            "mov %B[h], r0\n\t"
            "mov %C[h], r1\n\t"
            "sbc %D[h], %D[h]\n\t"
            "mul %A[v], %[by]\n\t"
            "mov %A[h], r1\n\t"
            "mul %B[v], %[by]\n\t"
            "add %A[h], r0\n\t"
            "adc %B[h], r1\n\t"
            "clr r1\n\t"
            "adc %C[h], r1\n\t"
            "adc %D[h], r1"
            : [h] "=&r"(high)
            : [v] "a"(value), [by] "a"(by)
            : "r0");
    return high;
}

#endif
