/* rival.S: firmware/core/rival.c in the chip's own instructions; tests/avr holds the two together.
 * A hundred robots that meet ask this of one another: 370 cycles, where the compiler's takes 760. */
#include "arithmetic.inc"
#include "layout.h"

/* r3:r2:r1:r0 = four bytes of the neighbour plus dh:dl, less four of the lookout. Uses r26. */
.macro offset_of r3, r2, r1, r0, at, dh, dl, origin
    ldd  \r0, Z+\at
    ldd  \r1, Z+\at+1
    ldd  \r2, Z+\at+2
    ldd  \r3, Z+\at+3
    mov  r26, \dh
    lsl  r26
    sbc  r26, r26
    add  \r0, \dl
    adc  \r1, \dh
    adc  \r2, r26
    adc  \r3, r26
    ldd  r26, Y+\origin
    sub  \r0, r26
    ldd  r26, Y+\origin+1
    sbc  \r1, r26
    ldd  r26, Y+\origin+2
    sbc  \r2, r26
    ldd  r26, Y+\origin+3
    sbc  \r3, r26
.endm

/* high:low = drift * r18 / 256, rounded down. Uses r22 and r23; r27 is 0. */
.macro drifted high, low, drift
    ldd  r22, Z+\drift
    ldd  r23, Z+\drift+1
    mulsu r23, r18
    movw \low, r0
    mul  r22, r18
    add  \low, r1
    adc  \high, r27
.endm

/* v3:v2:v1:v0 complemented where sign is negative. */
.macro size_of v3, v2, v1, v0, sign
    sbrs \sign, 7
    rjmp 1f
    com  \v0
    com  \v1
    com  \v2
    com  \v3
1:
.endm

/* uint32_t r25:r22 rival_square(const struct lookout *r25:r24, const struct neighbour *r23:r22,
 *                               struct vec16 place {x r19:r18, y r21:r20}) */
function rival_square
    save r10, r11, r12, r13, r14, r15, r16, r17, r28, r29
    movw r28, r24
    movw r30, r22
    movw r14, r18               /* place.x */
    movw r16, r20               /* place.y */

    ldd  r24, Y+LOOKOUT_NOW     /* r18 = age in 1/256 s */
    ldd  r25, Y+LOOKOUT_NOW+1
    ldd  r26, Z+NEIGHBOUR_TIME
    ldd  r27, Z+NEIGHBOUR_TIME+1
    sub  r24, r26
    sbc  r25, r27
    brpl 1f
    ldi  r24, 0
    ldi  r25, 0
1:  ldi  r26, hi8(STATE_AGE_LIMIT + 1)
    cpi  r24, lo8(STATE_AGE_LIMIT + 1)
    cpc  r25, r26
    brlo 2f
    ldi  r24, lo8(STATE_AGE_LIMIT)
    ldi  r25, hi8(STATE_AGE_LIMIT)
2:  ldi  r26, 65                /* (65 age + age / 2) >> 8 */
    mul  r25, r26
    mov  r18, r0
    mul  r24, r26
    lsr  r25
    ror  r24
    add  r0, r24
    adc  r1, r25
    add  r18, r1
    ldi  r27, 0
    drifted r11, r10, NEIGHBOUR_DRIFT
    drifted r13, r12, NEIGHBOUR_DRIFT + 2
    offset_of r25, r24, r23, r22, NEIGHBOUR_AT, r11, r10, LOOKOUT_ORIGIN
    offset_of r21, r20, r19, r18, NEIGHBOUR_AT + 4, r13, r12, LOOKOUT_ORIGIN + 4

    movw r10, r22               /* street length within reach? */
    movw r12, r24
    size_of r13, r12, r11, r10, r25
    movw r26, r18
    movw r30, r20
    size_of r31, r30, r27, r26, r21
    add  r10, r26
    adc  r11, r27
    adc  r12, r30
    adc  r13, r31
    ldd  r0, Y+LOOKOUT_REACH
    cp   r0, r10
    ldd  r0, Y+LOOKOUT_REACH+1
    cpc  r0, r11
    ldd  r0, Y+LOOKOUT_REACH+2
    cpc  r0, r12
    ldd  r0, Y+LOOKOUT_REACH+3
    cpc  r0, r13
    brsh 3f
    ldi  r22, 0xFF
    ldi  r23, 0xFF
    movw r24, r22
    rjmp .Lleave

3:  movw r12, r16               /* place.y */
    ldi  r27, 0
    ldd  r26, Y+LOOKOUT_BYTE
    tst  r26
    breq 4f
    mov  r22, r23
    mov  r23, r24
    mov  r24, r25
    mov  r18, r19
    mov  r19, r20
    mov  r20, r21
4:  ldd  r26, Y+LOOKOUT_BY
    tst  r26
    breq 5f
    shrink r31, r30, r24, r23, r22, r26, r27
    movw r22, r30
    shrink r31, r30, r20, r19, r18, r26, r27
    movw r18, r30
5:  movw r24, r18               /* {x r23:r22, y r25:r24} in units of the scale, not yet turned */

    ldd  r18, Y+LOOKOUT_HEADING
    ldd  r19, Y+LOOKOUT_HEADING+1
    ldd  r20, Y+LOOKOUT_HEADING+2
    ldd  r21, Y+LOOKOUT_HEADING+3
    movw r10, r22
    movw r28, r24
    along
    subtract_limited r25, r24, r15, r14
    movw r14, r24
    movw r22, r10
    movw r24, r28
    movw r26, r18               /* a quarter turn on */
    movw r18, r20
    movw r20, r26
    negate r21, r20
    along
    subtract_limited r25, r24, r13, r12

    movw r20, r24               /* r25:r24:r23:r22 = x^2 + y^2 */
    movw r18, r14
    ldi  r17, 0
    square r25, r24, r23, r22, r19, r18, r17
    add_square r25, r24, r23, r22, r21, r20, r17

.Lleave:
    clr  r1
    restore r29, r28, r17, r16, r15, r14, r13, r12, r11, r10
    ret
