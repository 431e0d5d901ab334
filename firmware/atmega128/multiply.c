#include "multiply.h"

int32_t mul16(int16_t a, int16_t b)
{
    int32_t product;
    uint8_t zero;

    __asm__("clr %[zero]\n\t"
            "muls %B[a], %B[b]\n\t"
            "movw %C[p], r0\n\t"
            "mul %A[a], %A[b]\n\t"
            "movw %A[p], r0\n\t"
            "mulsu %B[a], %A[b]\n\t"
            "sbc %D[p], %[zero]\n\t"
            "add %B[p], r0\n\t"
            "adc %C[p], r1\n\t"
            "adc %D[p], %[zero]\n\t"
            "mulsu %B[b], %A[a]\n\t"
            "sbc %D[p], %[zero]\n\t"
            "add %B[p], r0\n\t"
            "adc %C[p], r1\n\t"
            "adc %D[p], %[zero]\n\t"
            "clr r1"
            : [p] "=&r"(product), [zero] "=&r"(zero)
            : [a] "a"(a), [b] "a"(b)
            : "r0");
    return product;
}

int16_t mul_q15(int16_t a, int16_t b)
{
    int16_t product;
    uint8_t zero, below;

    /* The fractional products come shifted to the left by one, the carry being their top bit. */
    __asm__("clr %[zero]\n\t"
            "fmuls %B[a], %B[b]\n\t"
            "movw %A[p], r0\n\t"
            "fmul %A[a], %A[b]\n\t"
            "adc %A[p], %[zero]\n\t"
            "adc %B[p], %[zero]\n\t"
            "mov %[below], r1\n\t"
            "fmulsu %B[a], %A[b]\n\t"
            "sbc %B[p], %[zero]\n\t"
            "add %[below], r0\n\t"
            "adc %A[p], r1\n\t"
            "adc %B[p], %[zero]\n\t"
            "fmulsu %B[b], %A[a]\n\t"
            "sbc %B[p], %[zero]\n\t"
            "add %[below], r0\n\t"
            "adc %A[p], r1\n\t"
            "adc %B[p], %[zero]\n\t"
            "lsl %[below]\n\t"
            "adc %A[p], %[zero]\n\t"
            "adc %B[p], %[zero]\n\t"
            "clr r1"
            : [p] "=&r"(product), [zero] "=&r"(zero), [below] "=&r"(below)
            : [a] "a"(a), [b] "a"(b)
            : "r0");
    return product;
}
