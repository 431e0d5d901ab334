/* main.c: the robot. Interrupts keep bytes and set flags; this loop acts on them. */
#include "battery.h"
#include "brain.h"
#include "eeprom.h"
#include "flash_map.h"
#include "leave.h"
#include "motors.h"
#include "pins.h"
#include "stack.h"
#include "tick.h"
#include "usart.h"
#include "watchdog.h"

#include <avr/cpufunc.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/pgmspace.h>
#include <avr/sleep.h>
#include <stddef.h>

#define BLINK_TICKS (TICKS_PER_S / 2)

static struct brain brain;
static struct brain_output output;

static void decode_until(uint8_t mark)
{
    const uint8_t *bytes;
    uint8_t count;

    while ((count = usart_peek(mark, &bytes)) > 0) {
        brain_bytes(&brain, bytes, bytes + count);
        usart_drop(count);
    }
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
        .stored = eeprom_byte(output.store.at),
        .resets = watchdog_resets(),
        .image = pgm_read_dword(SEAL_AT + offsetof(struct seal, crc)),
    };

    decode_until(tick_take());
    brain_step(&brain, &input, &output);
    motors_hand_over(output.left, output.right);
    tick_acted();
    if (output.store.wanted)
        eeprom_store(output.store.at, output.store.byte);
    /* Two frames a tick at most: there is room unless BAUD is far too low for the fleet. */
    usart_send(output.frames, output.length);
    tick_done();
    show(output.left != 0 || output.right != 0);
    watchdog_kick();
    if (output.leave)
        leave_for_loader();
}

/* A function of its own, for its stack is free again afterwards. */
__attribute__((noinline)) static void wake_brain(void)
{
    uint8_t eeprom[PARAMETERS_BYTES];

    eeprom_read(eeprom);
    brain_init(&brain, eeprom);
}

int main(void)
{
    /* First, so that ticks stand at a fixed time after a reset. */
    tick_start();
    watchdog_start();
    motors_init();
    PIN_DDR(PIN_LED) |= PIN_MASK(PIN_LED);
    wake_brain();
    usart_init();
    battery_init();
    set_sleep_mode(SLEEP_MODE_IDLE);
    sleep_enable();

    /* Bytes are decoded a frame at a time: what wakes the processor most often is a single one.
     * Noise without a frame's end waits for the tick; the ring holds more than comes until then. */
    for (;;) {
        cli();
        if (tick_pending) {
            sei();
            control_tick();
        } else if (usart_frame_waits) {
            /* With no tick pending, all that is in the ring came before the next one. */
            uint8_t mark = usart_mark();

            usart_frame_waits = false;
            sei();
            decode_until(mark);
        } else {
            /* The instruction after sei comes before any interrupt: none is slept through. */
            sei();
            sleep_cpu();
            _NOP(); /* simavr takes the interrupt that woke it one instruction later */
        }
    }
}
