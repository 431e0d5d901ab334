/* pins.h: every pin of the robot; the firmware and its simulation both read it here.
 *
 * A pin is the letter of its port and a bit. Wiring: an L298 for two motors, a radio module on
 * USART0, the battery through a divider of two equal resistors. The inputs of the L298 want
 * pull-downs: the chip's pins float from reset until main(). */
#ifndef PINS_H
#define PINS_H

/* L298: IN1 and IN2 give the left motor's direction, IN3 and IN4 the right one's. */
#define PIN_LEFT_FORWARD C, 0
#define PIN_LEFT_REVERSE C, 1
#define PIN_RIGHT_FORWARD C, 2
#define PIN_RIGHT_REVERSE C, 3

/* L298: ENA and ENB take the PWM of timer 3, which comes out here and nowhere else. */
#define PIN_LEFT_PWM E, 3  /* OC3A */
#define PIN_RIGHT_PWM E, 4 /* OC3B */

/* USART0 is on E, 0 (RXD0) and E, 1 (TXD0), which are PDI and PDO while the chip is being
 * programmed: the radio must not drive RXD0 then. */

#define PIN_LED B, 0

/* ADC0 is F, 0; F, 4 to F, 7 are left to JTAG. */
#define BATTERY_CHANNEL 0
#define BATTERY_DIVIDER 2
#define ADC_REFERENCE_MV 5000 /* AVCC */

/* A pin's registers and its place in them; variadic, for a pin is two arguments. */
#define PIN_PORT(...) PIN_PORT_(__VA_ARGS__)
#define PIN_PORT_(letter, bit) PORT##letter
#define PIN_DDR(...) PIN_DDR_(__VA_ARGS__)
#define PIN_DDR_(letter, bit) DDR##letter
#define PIN_MASK(...) PIN_MASK_(__VA_ARGS__)
#define PIN_MASK_(letter, bit) (1u << (bit))

#endif
