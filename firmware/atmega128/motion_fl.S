/* motion_fl.S: firmware/core/motion_fl.c in the chip's own instructions, to the same bit; tests/avr
 * holds the two together. The law is the headline of a control tick: here what it
 * works out stays in registers.
 *
 * struct motion_command {v r23:r22, omega r25:r24}
 * motion_fl(const struct message_mission *r25:r24, const struct motion_goal *r23:r22,
 *           const struct pose *r21:r20)
 */
#include "arithmetic.inc"
#include "layout.h"

/* In r2 to r17, and Y = goal: */
#define sine    r2
#define cosine  r4
#define u_x     r6
#define u_y     r8
#define speed   r10
#define mission r12

/* high:low -= v * part of the heading, which is in r21:r20, saturated. */
.macro subtract_own high, low
    movw r22, speed
    ldi  r25, 0
    mul_q15 r27, r26, r23, r22, r21, r20, r24, r25
    subtract_limited \high, \low, r27, r26
.endm

/* r3:r2:r1:r0 = four bytes of the goal less four of the pose. */
.macro difference r3, r2, r1, r0, goal, pose
    ldd  \r0, Y+\goal
    ldd  \r1, Y+\goal+1
    ldd  \r2, Y+\goal+2
    ldd  \r3, Y+\goal+3
    ldd  r26, Z+\pose
    sub  \r0, r26
    ldd  r26, Z+\pose+1
    sbc  \r1, r26
    ldd  r26, Z+\pose+2
    sbc  \r2, r26
    ldd  r26, Z+\pose+3
    sbc  \r3, r26
.endm

function motion_fl
    save r2, r3, r4, r5, r6, r7, r8, r9, r10, r11, r12, r13, r14, r15, r16, r17, r28, r29
    movw mission, r24
    movw r28, r22
    movw r30, r20

    difference r25, r24, r23, r22, GOAL_AT, POSE_AT /* error x r25:r22, y r21:r18 */
    difference r21, r20, r19, r18, GOAL_AT + 4, POSE_AT + 4
    ldd  r10, Z+POSE_THETA
    ldd  r11, Z+POSE_THETA+1
    unless_narrow .Lfar, r25, r24, r23
    unless_narrow .Lfar, r21, r20, r19
    no_minimum r23, r22
    no_minimum r19, r18
    movw r16, r22
    movw r14, r18
    rjmp .Lnear
.Lfar:
    call vec_shorten
    movw r16, r22
    movw r14, r24

.Lnear:
    movw r24, r10
    push r10                    /* theta */
    push r11
    call sincos_of
    movw sine, r22
    movw cosine, r24

    movw r18, r14               /* u = velocity + k error */
    movw r30, mission
    ldd  r20, Z+MISSION_K
    ldd  r21, Z+MISSION_K+1
    ldd  r22, Y+GOAL_VELOCITY
    ldd  r23, Y+GOAL_VELOCITY+1
    ldd  r24, Y+GOAL_VELOCITY+2
    ldd  r25, Y+GOAL_VELOCITY+3
    call add_scaled
    movw u_x, r22
    movw u_y, r24

    movw r18, sine              /* v = u . heading, limited */
    movw r20, cosine
    along
    movw r30, mission
    ldd  r18, Z+MISSION_V_MAX
    ldd  r19, Z+MISSION_V_MAX+1
    cp   r18, r24
    cpc  r19, r25
    brge 3f
    movw r24, r18
3:  negate r19, r18
    cp   r24, r18
    cpc  r25, r19
    brge 4f
    movw r24, r18
4:  movw speed, r24

    ldi  r20, MOTION_HOLD_UNITS - 1 /* |u| large enough? */
    ldi  r21, 2 * MOTION_HOLD_UNITS - 1
    movw r24, u_x
    add  r24, r20
    adc  r25, r1
    cp   r24, r21
    cpc  r25, r1
    brsh 5f
    movw r24, u_y
    add  r24, r20
    adc  r25, r1
    cp   r24, r21
    cpc  r25, r1
    brsh 5f
    pop  r21
    pop  r20
    ldi  r24, 0
    ldi  r25, 0
    rjmp .Lleave

5:  ldd  r16, Y+GOAL_VELOCITY   /* slip r17:r16, r19:r18 */
    ldd  r17, Y+GOAL_VELOCITY+1
    movw r20, cosine
    subtract_own r17, r16
    ldd  r18, Y+GOAL_VELOCITY+2
    ldd  r19, Y+GOAL_VELOCITY+3
    movw r20, sine
    subtract_own r19, r18

    movw r30, mission           /* u_dot = acceleration + k slip */
    ldd  r20, Z+MISSION_K
    ldd  r21, Z+MISSION_K+1
    ldd  r22, Y+GOAL_ACCELERATION
    ldd  r23, Y+GOAL_ACCELERATION+1
    ldd  r24, Y+GOAL_ACCELERATION+2
    ldd  r25, Y+GOAL_ACCELERATION+3
    call add_scaled

    movw r18, r22               /* its course r23:r22, turning at r25:r24 */
    movw r20, r24
    movw r22, u_x
    movw r24, u_y
    call course

    pop  r19                    /* off r23:r22 */
    pop  r18
    sub  r22, r18
    sbc  r23, r19
    movw r30, mission
    ldd  r20, Z+MISSION_K_THETA
    ldd  r21, Z+MISSION_K_THETA+1
    movw r16, r30
    scale r31, r30, r27, r23, r22, r21, r20, r26 /* k_theta off */

    mov  r23, r31               /* times 201 / 256, r19:r18:r26 */
    ldi  r22, 201
    mulsu r23, r22
    movw r18, r0
    mul  r27, r22
    mov  r26, r1
    ldi  r21, 0
    mul  r30, r22
    add  r26, r0
    adc  r18, r1
    adc  r19, r21
    clr  r1
.rept 3
    asr  r19
    ror  r18
    ror  r26
.endr

    mov  r20, r25               /* plus the turn */
    lsl  r20
    sbc  r20, r20
    add  r26, r24
    adc  r18, r25
    adc  r19, r20
    movw r30, r16               /* limited */
    ldd  r22, Z+MISSION_OMEGA_MAX
    ldd  r23, Z+MISSION_OMEGA_MAX+1
    mov  r24, r26
    mov  r25, r18
    cp   r22, r24
    cpc  r23, r25
    cpc  r21, r19
    brge 6f
    movw r24, r22
    mov  r19, r21
6:  negate r23, r22
    ldi  r21, 0xFF
    cp   r24, r22
    cpc  r25, r23
    cpc  r19, r21
    brge .Lleave
    movw r24, r22

.Lleave:
    movw r22, speed
    restore r29, r28, r17, r16, r15, r14, r13, r12, r11, r10, r9, r8, r7, r6, r5, r4, r3, r2
    ret
