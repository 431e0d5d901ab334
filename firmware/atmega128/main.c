/* main.c: the robot. Interrupts keep bytes and set flags; this loop acts on them. */
#include "battery.h"
#include "brain.h"
#include "eeprom.h"
#include "motors.h"
#include "pins.h"
#include "stack.h"
#include "tick.h"
#include "usart.h"
#include "watchdog.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

#define BLINK_TICKS (TICKS_PER_S / 2)

static struct brain brain;
static struct brain_output output;

static void decode_until(uint8_t mark)
{
    int16_t byte;

    while ((byte = usart_take(mark)) >= 0)
        brain_byte(&brain, (uint8_t)byte);
}

/* Lit while the motors are driven, else blinking once a second. */
static void show(bool driving)
{
    static uint8_t ticks;

    if (driving) {
        PIN_PORT(PIN_LED) |= PIN_MASK(PIN_LED);
    } else if (++ticks == BLINK_TICKS) {
        PIN_PORT(PIN_LED) ^= PIN_MASK(PIN_LED);
        ticks = 0;
    }
}

static void control_tick(void)
{
    struct brain_input input = {
        .battery = battery_poll(),
        .overruns = usart_lost(),
        .tick_cycles = tick_cycles_max,
        .stack_free = stack_free(),
        .reset_cause = watchdog_reset_cause(),
    };

    decode_until(tick_take());
    brain_step(&brain, &input, &output);
    motors_hand_over(output.left, output.right);
    tick_acted();
    /* Two frames a tick at most: there is room unless BAUD is far too low for the fleet. */
    usart_send(output.frames, output.length);
    tick_done();
    show(output.left != 0 || output.right != 0);
    watchdog_kick();
}

/* Sleeps until the next interrupt, unless one came since `mark` was read. The instruction after
 * sei is executed before any interrupt, so none is slept through. */
static void wait(uint8_t mark)
{
    cli();
    if (!tick_pending() && usart_mark() == mark) {
        sleep_enable();
        sei();
        sleep_cpu();
        sleep_disable();
    }
    sei();
}

int main(void)
{
    struct parameters parameters;

    /* First, so that ticks stand at a fixed time after a reset. */
    tick_start();
    watchdog_start();
    motors_init();
    PIN_DDR(PIN_LED) |= PIN_MASK(PIN_LED);
    eeprom_read(&parameters);
    brain_init(&brain, parameters.id);
    usart_init();
    battery_init();
    set_sleep_mode(SLEEP_MODE_IDLE);
    sei();

    for (;;) {
        /* Before the look at the tick: what is in the ring now came before any tick that is not
         * pending yet. */
        uint8_t mark = usart_mark();

        if (tick_pending()) {
            control_tick();
        } else {
            decode_until(mark);
            wait(mark);
        }
    }
}
