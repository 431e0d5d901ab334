/* turning.S: common/turning.c in the chip's own instructions, to the same bit; tests/avr holds the
 * two together. The comments give the C of what follows. Cycles are from the first instruction to
 * the end of the return, about, the compiler's from the C in brackets:
 *
 *     sincos_of 76 (130)          vec_along 65 (130)             vec_saturate 25 to 120 (180)
 *     course_of 320 to 440 (590)  vec_add_scaled 95 to 190 (160 to 290)
 *     vec_square_between 46 (110)
 *
 * Arguments come in r25 downwards and results leave there; r18 to r27, r30 and r31 are free to use,
 * r1 has to be 0 at the end. Numbers of two bytes are written high:low. */
#include "arithmetic.inc"

/* high:low += step * part / 64, rounded; zero is 0. */
.macro add_part high, low, step, part, zero
    mul  \step, \part
    lsl  r0
    rol  r1
    lsl  r0
    rol  r1
    lsl  r0
    adc  \low, r1
    adc  \high, \zero
.endm

/* struct sincos {sin r23:r22, cos r25:r24} sincos_of(angle_t r25:r24) */
function sincos_of
    mov  r20, r25               /* its two upper bits are the quadrant */
    mov  r21, r24
    andi r21, 63                /* part */
    lsl  r24
    rol  r25
    lsl  r24
    rol  r25
    mov  r26, r25
    ldi  r27, 0
    lsl  r26
    rol  r27                    /* r27:r26 = 2 i */
    ldi  r19, 0

    movw r30, r26               /* rising, from sine_table[i] on */
    subi r30, lo8(-(sine_table))
    sbci r31, hi8(-(sine_table))
    lpm  r22, Z+
    lpm  r23, Z+
    lpm  r18, Z
    sub  r18, r22
    add_part r23, r22, r18, r21, r19

    ldi  r30, lo8(sine_table + 510) /* falling, from sine_table[255 - i] on */
    ldi  r31, hi8(sine_table + 510)
    sub  r30, r26
    sbc  r31, r27
    lpm  r24, Z+
    lpm  r25, Z+
    lpm  r18, Z
    sub  r18, r24
    subi r21, 64
    neg  r21
    add_part r25, r24, r18, r21, r19
    clr  r1

    sbrs r20, 6                 /* the quadrants of odd number swap the two */
    rjmp 1f
    movw r18, r22
    movw r22, r24
    movw r24, r18
1:  sbrs r20, 7
    rjmp 2f
    negate r23, r22
2:  lsl  r20                    /* V = one of the two bits */
    brvc 3f
    negate r25, r24
3:  ret

/* int16_t r25:r24 vec_along(struct vec16 {x r23:r22, y r25:r24}, {sin r19:r18, cos r21:r20}) */
function vec_along
    push r17
    along
    pop  r17
    ret

/* struct vec16 {x r23:r22, y r25:r24} vec_saturate(int32_t x r25:r22, int32_t y r21:r18);
 * vec_shorten is the same where something is too wide. */
function vec_saturate
    unless_narrow vec_shorten, r25, r24, r23
    unless_narrow vec_shorten, r21, r20, r19
    no_minimum r23, r22
    no_minimum r19, r18
    movw r24, r18
    ret

.global vec_shorten
vec_shorten:
    movw r26, r24               /* sizes: what is negative, complemented */
    mov  r0, r23
    sbrs r25, 7
    rjmp 1f
    com  r26
    com  r27
    com  r0
1:  movw r30, r20
    mov  r1, r19
    sbrs r21, 7
    rjmp 2f
    com  r30
    com  r31
    com  r1
2:  or   r0, r1
    or   r26, r30
    or   r27, r31
    lsl  r0
    rol  r26
    rol  r27                    /* r27:r26 = above */

    tst  r27
    breq 3f
    mov  r22, r23               /* away with a byte */
    mov  r23, r24
    mov  r24, r25
    mov  r18, r19
    mov  r19, r20
    mov  r20, r21
    mov  r26, r27
3:  ldi  r21, 128               /* by */
    rjmp 5f
4:  lsr  r21
5:  lsr  r26
    brne 4b

    shrink r31, r30, r20, r19, r18, r21, r26
    shrink r19, r18, r24, r23, r22, r21, r26
    clr  r1
    no_minimum r31, r30
    no_minimum r19, r18
    movw r22, r18
    movw r24, r30
    ret

/* r17:r16:v0 = v2:v1:v0 * by / 256, v2 signed, rounded down; v2 and by in r16 to r23. */
.macro times v2, v1, v0, by, zero
    mulsu \v2, \by
    movw r16, r0
    mul  \v0, \by
    mov  \v0, r1
    mul  \v1, \by
    add  \v0, r0
    adc  r16, r1
    adc  r17, \zero
.endm

#define MIRRORED_X 0            /* bits of how */
#define MIRRORED_Y 1
#define SWAPPED    2
#define BYTE       3

#define how   r26
#define power r27

/* struct course {angle r23:r22, turn r25:r24}
 * course_of(struct vec16 v {x r23:r22, y r25:r24}, struct vec16 w {x r19:r18, y r21:r20}) */
function course_of
    save r14, r15, r16, r17, r28, r29
    rcall course
    restore r29, r28, r17, r16, r15, r14
    ret

/* The same for motion_fl.S, which has saved all of these already. */
.global course
course:
    ldi  how, 0                 /* v into the first octant, w with it */
    tst  r23
    brpl 1f
    negate r23, r22
    negate r19, r18
    ori  how, 1 << MIRRORED_X
1:  tst  r25
    brpl 2f
    negate r25, r24
    negate r21, r20
    ori  how, 1 << MIRRORED_Y
2:  cp   r22, r24
    cpc  r23, r25
    brsh 3f
    movw r30, r22
    movw r22, r24
    movw r24, r30
    movw r30, r18
    movw r18, r20
    movw r20, r30
    ori  how, 1 << SWAPPED

3:  ldi  power, 1               /* large r23:r22, small r25:r24; large into [2^15, 2^16) */
    tst  r23
    brne 4f
    tst  r22
    brne 1f
    movw r24, r22               /* (0, 0) */
    ret
1:  mov  r23, r22
    clr  r22
    mov  r25, r24
    clr  r24
    ori  how, 1 << BYTE
    tst  r23
4:  brmi 6f
5:  lsl  r24
    rol  r25
    lsl  power
    lsl  r22
    rol  r23
    brpl 5b

6:  lsl  r22                    /* inverse r23:r22 */
    rol  r23
    in_falling r29, r28, reciprocal_table, r23, r22, r16
    movw r22, r28

    ldi  r16, 0                 /* ratio r25:r24 = small * inverse >> 14 */
    mul  r25, r23
    movw r30, r0
    mul  r24, r22
    movw r28, r0
    mul  r25, r22
    add  r29, r0
    adc  r30, r1
    adc  r31, r16
    mul  r24, r23
    add  r29, r0
    adc  r30, r1
    adc  r31, r16
    lsl  r29
    rol  r30
    rol  r31
    lsl  r29
    rol  r30
    rol  r31
    brcc 7f
    ldi  r30, 0xFF
    ldi  r31, 0xFF
7:  movw r24, r30

    in_rising r29, r28, arctangent_table, r25, r24, r17, r16
    adiw r28, 2
    lsr  r29
    ror  r28
    lsr  r29
    ror  r28
    ldi  r30, 0
    sbrs how, SWAPPED
    rjmp 8f
    ldi  r31, hi8(0x4000)
    sub  r30, r28
    sbc  r31, r29
    movw r28, r30
    ldi  r30, 0
8:  sbrs how, MIRRORED_X
    rjmp 9f
    ldi  r31, hi8(0x8000)
    sub  r30, r28
    sbc  r31, r29
    movw r28, r30
9:  sbrs how, MIRRORED_Y
    rjmp 1f
    negate r29, r28
1:  movw r14, r28               /* angle */

    in_falling r29, r28, falloff_table, r25, r24, r17
    lsr  r25
    ror  r24
    movw r16, r24               /* ratio >> 1 */
    ldi  r25, 0
    mul_q15 r31, r30, r19, r18, r17, r16, r24, r25
    halve r31, r30
    halve r21, r20
    sub  r20, r30               /* cross r21:r20 */
    sbc  r21, r31
    movw r18, r28
    mul_q15 r31, r30, r21, r20, r19, r18, r24, r25
    movw r20, r30               /* reduced */
    product r31, r30, r29, r28, r21, r20, r23, r22, r25

    sbrc how, BYTE              /* turn = r31:r30:r29 * power >> 11, or >> 3 of a BYTE */
    rjmp 2f
    mov  r21, r31
    mov  r20, power
    cpi  power, 8
    brsh 1f
    swap r20                    /* (* 32 power) >> 16: it fits two bytes */
    lsl  r20
    times r21, r30, r29, r20, r25
    movw r24, r16
    rjmp 7f
1:  lsr  r20                    /* (* power / 8) >> 8 */
    lsr  r20
    lsr  r20
    times r21, r30, r29, r20, r25
    movw r30, r16
    mov  r24, r31
    lsl  r24
    sbc  r24, r24
    rjmp 5f
2:  mov  r24, r31
    lsl  r24
    sbc  r24, r24
    rjmp 4f
3:  lsl  r29
    rol  r30
    rol  r31
    rol  r24
4:  lsr  power
    brne 3b
.rept 3
    asr  r24
    ror  r31
    ror  r30
    ror  r29
.endr
5:  mov  r0, r30                /* r24:r31:r30:r29 saturated */
    lsl  r0
    sbc  r0, r0
    cp   r31, r0
    cpc  r24, r0
    breq 6f
    ldi  r29, lo8(32767)
    ldi  r30, hi8(32767)
    sbrc r24, 7
    ldi  r29, lo8(-32767)
    sbrc r24, 7
    ldi  r30, hi8(-32767)
6:  no_minimum r30, r29
    mov  r24, r29
    mov  r25, r30

7:mov  r20, how               /* mirrored an odd number of times */
    lsr  r20
    eor  how, r20
    lsr  r20
    eor  how, r20
    sbrs how, 0
    rjmp 8f
    negate r25, r24
8:  movw r22, r14
    clr  r1
    ret

/* v3:v2:high:low = the number in high:low plus gain * b / 256; as scale. v3 may be r1, v2 r31. */
.macro add_scaled_part v3, v2, high, low, bh, bl, gh, gl
    scale r31, r30, r27, \bh, \bl, \gh, \gl, r26
    mov  r26, \high
    lsl  r26
    sbc  r26, r26
    mov  r0, r31
    lsl  r0
    sbc  r0, r0
    add  \low, r27
    adc  \high, r30
    adc  r31, r26
    adc  r0, r26
    mov  \v2, r31
    mov  \v3, r0
.endm

/* struct vec16 {x r23:r22, y r25:r24}
 * vec_add_scaled(struct vec16 a {x r23:r22, y r25:r24}, gain r21:r20, struct vec16 b {x r17:r16,
 * y r19:r18}); add_scaled is the same, and r14 and r15 are not kept. */
function vec_add_scaled
    push r14
    push r15
    rcall add_scaled
    pop  r15
    pop  r14
    ret

.global add_scaled
add_scaled:
    add_scaled_part r15, r14, r23, r22, r17, r16, r21, r20
    add_scaled_part r1, r31, r25, r24, r19, r18, r21, r20
    unless_narrow 2f, r15, r14, r23
    unless_narrow 2f, r1, r31, r25
    clr  r1
    no_minimum r23, r22
    no_minimum r25, r24
    ret
2:  movw r18, r24
    mov  r20, r31
    mov  r21, r1
    movw r24, r14
    clr  r1
    jmp  vec_shorten

/* uint32_t r25:r22 vec_square_between(struct vec16 a {x r23:r22, y r25:r24},
 *                                     struct vec16 b {x r19:r18, y r21:r20}) */
function vec_square_between
    sub  r22, r18
    sbc  r23, r19
    sub  r24, r20
    sbc  r25, r21
    movw r20, r24
    ldi  r18, 0
    square r31, r30, r27, r26, r23, r22, r18
    add_square r31, r30, r27, r26, r21, r20, r18
    clr  r1
    movw r22, r26
    movw r24, r30
    ret
