/* motors.h: two DC motors behind an L298, driven by timer 3.
 *
 * A set-point is -PWM_STEPS..PWM_STEPS, positive for forward; 0 is off: both direction pins low.
 * Set-points are handed over when they are computed and take effect when they are latched, so
 * that the time of computing does not show in the motion. */
#ifndef MOTORS_H
#define MOTORS_H

#include <stdint.h>

/* The pins become outputs, the motors are off. */
void motors_init(void);

void motors_hand_over(int16_t left, int16_t right);

/* What was handed over last drives the motors from now on. Interrupts must be off. */
void motors_latch(void);

#endif
