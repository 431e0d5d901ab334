/* sweep.S: firmware/core/sweep.c in the chip's own instructions; tests/avr holds the two together.
 * A vertex takes 65 cycles, 37 where its x alone is too far away, 9 where it is left out. */
#include "arithmetic.inc"
#include "layout.h"

#define vertex  r24             /* its number, r25:r24 */
#define skip    r19
#define bits    r17
#define zero    r16
#define at_x    r8
#define at_y    r10
#define best    r12             /* square, r15 to r12 */
#define closest r6
#define by      r18
#define bytes   r4

/* high:low = the next part of a vertex, in the scale of the pass, less that of the place. */
.macro next_part high, low, at_h, at_l
    ld   \low, Z+
    ld   \high, Z+
    cpse by, zero
    rjmp 8f
7:  sub  \low, \at_l
    sbc  \high, \at_h
    .subsection 1
8:  mul  \low, by
    mov  \low, r1
    mulsu \high, by
    mov  \high, r1
    add  \low, r0
    adc  \high, zero
    rjmp 7b
    .previous
.endm

/* Goes to `reject` unless r29:r28:r27:r26 is below the best. */
.macro unless_below reject
    cp   r26, r12
    cpc  r27, r13
    cpc  r28, r14
    cpc  r29, r15
    brsh \reject
.endm

/* void sweep_vertices(struct sweep *r25:r24) */
function sweep_vertices
    save r2, r3, r4, r6, r7, r8, r9, r10, r11, r12, r13, r14, r15, r16, r17, r28, r29, r24, r25

    movw r28, r24
    ldd  r30, Y+SWEEP_VERTEX
    ldd  r31, Y+SWEEP_VERTEX+1
    ldd  r2, Y+SWEEP_SKIP
    ldd  r3, Y+SWEEP_SKIP+1
    ldd  r8, Y+SWEEP_AT
    ldd  r9, Y+SWEEP_AT+1
    ldd  r10, Y+SWEEP_AT+2
    ldd  r11, Y+SWEEP_AT+3
    ldd  bytes, Y+SWEEP_BYTES
    ldd  by, Y+SWEEP_BY
    ldi  zero, 0
    mov  r7, zero
    mov  r6, zero
    ldi  vertex, lo8(1)
    ldi  r25, hi8(1)
    ldi  r26, 0xFF
    mov  r12, r26
    mov  r13, r26
    movw r14, r12

1:  movw r26, r2
    ld   skip, X+
    movw r2, r26
    ldi  bits, 8
2:  lsr  skip
    brcs 5f
    next_part r23, r22, r9, r8
    square r29, r28, r27, r26, r23, r22, zero
    unless_below 6f
    next_part r21, r20, r11, r10
    add_square r29, r28, r27, r26, r21, r20, zero
    unless_below 3f
    movw r12, r26
    movw r14, r28
    movw closest, vertex
    rjmp 3f
5:  adiw r30, 2                 /* left out */
6:  adiw r30, 2                 /* too far in x */
3:  adiw vertex, 1
    dec  bits
    brne 2b
4:  dec  bytes
    brne 1b

    clr  r1
    pop  r29
    pop  r28
    std  Y+SWEEP_CLOSEST, r6
    std  Y+SWEEP_CLOSEST+1, r7
    std  Y+SWEEP_SQUARE, r12
    std  Y+SWEEP_SQUARE+1, r13
    std  Y+SWEEP_SQUARE+2, r14
    std  Y+SWEEP_SQUARE+3, r15
    restore r29, r28, r17, r16, r15, r14, r13, r12, r11, r10, r9, r8, r7, r6, r4, r3, r2
    ret
