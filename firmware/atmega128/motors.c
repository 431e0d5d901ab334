#include "motors.h"

#include "limits.h"
#include "pins.h"

#include <avr/io.h>
#include <stdbool.h>
#include <util/atomic.h>

static struct {
    int16_t left, right;
} next;

#define OUTPUT(pin) (PIN_DDR(pin) |= PIN_MASK(pin))
#define SET(pin, high)                                                                             \
    ((high) ? (PIN_PORT(pin) |= PIN_MASK(pin)) : (PIN_PORT(pin) &= (uint8_t)~PIN_MASK(pin)))

void motors_init(void)
{
    OUTPUT(PIN_LEFT_FORWARD);
    OUTPUT(PIN_LEFT_REVERSE);
    OUTPUT(PIN_RIGHT_FORWARD);
    OUTPUT(PIN_RIGHT_REVERSE);
    OUTPUT(PIN_LEFT_PWM);
    OUTPUT(PIN_RIGHT_PWM);

    /* Fast PWM up to ICR3 (mode 14), which can be written once the mode is set; outputs high
     * from 0 to the match; no prescaler: F_CPU / (PWM_STEPS + 1). */
    TCCR3A = _BV(COM3A1) | _BV(COM3B1) | _BV(WGM31);
    TCCR3B = _BV(WGM33) | _BV(WGM32);
    ICR3 = PWM_STEPS;
    TCCR3B = _BV(WGM33) | _BV(WGM32) | _BV(CS30);
}

void motors_hand_over(int16_t left, int16_t right)
{
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        next.left = left;
        next.right = right;
    }
}

static uint16_t duty(int16_t steps)
{
    return steps < 0 ? (uint16_t)-steps : (uint16_t)steps;
}

void motors_latch(void)
{
    /* A compare value of 0 still gives a pulse of one clock: what turns a motor off are its
     * direction pins. */
    OCR3A = duty(next.left);
    SET(PIN_LEFT_FORWARD, next.left > 0);
    SET(PIN_LEFT_REVERSE, next.left < 0);
    OCR3B = duty(next.right);
    SET(PIN_RIGHT_FORWARD, next.right > 0);
    SET(PIN_RIGHT_REVERSE, next.right < 0);
}
