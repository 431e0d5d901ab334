/* avr_core.h: an ATmega128 under libsimavr, with the robot's board around it.
 *
 * Time is the core's own cycle count since power-on. Cores share their image and nothing else:
 * each may run in a thread of its own. */
#ifndef SIM_AVR_CORE_H
#define SIM_AVR_CORE_H

#include "avr_image.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct avr_core;
struct own_flash;

/* A core that has just been powered and has executed nothing yet. Its RAM holds rubbish, its
 * EEPROM 0xFF. NULL when there is no memory. The image must outlive it. */
struct avr_core *avr_core_new(const struct avr_image *image);

/* The same with a flash that is its own: it begins at LOADER_START, as BOOTRST makes it, and what
 * is stored there stays. Of the image it takes the clock, the baud rate and where variables end. */
struct avr_core *avr_core_new_with_flash(const struct avr_image *image, struct own_flash *flash);

void avr_core_free(struct avr_core *core);

void avr_core_write_eeprom(struct avr_core *core, uint16_t address, const uint8_t *bytes,
                           uint16_t count);
void avr_core_read_eeprom(struct avr_core *core, uint16_t address, uint8_t *bytes, uint16_t count);

/* The battery from now on, BATTERY_FULL_MV before. */
void avr_core_set_battery(struct avr_core *core, uint16_t millivolts);

/* Pulls its RESET pin. */
void avr_core_reset(struct avr_core *core);

/* Runs until the cycle count has reached `until`; it ends at most one instruction beyond. False
 * when the core has crashed: an illegal instruction or address, or asleep with interrupts off,
 * or what a flash of its own holds against it. A crashed core stays as it is. */
bool avr_core_run(struct avr_core *core, uint64_t until);

uint64_t avr_core_cycle(const struct avr_core *core);

/* Cycles asleep so far. */
uint64_t avr_core_asleep(const struct avr_core *core);

/* Resets other than the power-on. */
unsigned avr_core_resets(const struct avr_core *core);

/* The cycle in which timer 1 was started last; 0 when it never was. */
uint64_t avr_core_timer_start(const struct avr_core *core);

/* Sends bytes back to back to USART0 at the image's baud rate, the first one's start bit at cycle
 * `start`: byte j has arrived at start + round((j + 1) * 10 * f_cpu / baud). They must stay where
 * they are until then; what had not arrived of the bytes before is forgotten. */
void avr_core_receive(struct avr_core *core, uint64_t start, const uint8_t *bytes, size_t count);

/* Takes what USART0 has sent since the last call, at most `room` bytes. */
size_t avr_core_take_sent(struct avr_core *core, uint8_t *bytes, size_t room);

/* What drives the motors now: PWM steps, signed by the direction pins; 0 unless the pins are
 * outputs and timer 3 makes the PWM. */
struct avr_motors {
    int16_t left, right;
};
struct avr_motors avr_core_motors(const struct avr_core *core);

/* Calls `heard` with every byte that the program writes to the on-chip debug register OCDR, and the
 * cycle in which it does: programs under measurement mark their progress there, by one `out`. */
void avr_core_on_debug(struct avr_core *core,
                       void (*heard)(void *listener, uint8_t byte, uint64_t cycle), void *listener);

/* Bytes of the painted stack that were never written; 0 when it has met the variables. */
uint16_t avr_core_stack_free(const struct avr_core *core);
bool avr_core_stack_overflown(const struct avr_core *core);

/* For a fresh core: from now on a byte that SP has passed counts as written, and SP among the
 * variables is a crash at once. Costs a twentieth of the core's speed. */
void avr_core_watch_stack(struct avr_core *core);

/* The data space: registers, I/O and RAM, as they stand. */
const uint8_t *avr_core_data(const struct avr_core *core);

#endif
