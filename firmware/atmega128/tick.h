/* tick.h: the control tick, TICKS_PER_S times a second, from timer 1.
 *
 * The timer counts in units of 8 CPU cycles and starts again at every tick. ACTUATION_MS after a
 * tick it latches the motors' set-points. */
#ifndef TICK_H
#define TICK_H

#include <stdbool.h>
#include <stdint.h>

/* Starts the timer; the first tick comes one period later. */
void tick_start(void);

/* A tick has come; tick_take() sets it to false. */
extern volatile bool tick_pending;

/* Takes the pending tick. Returns where the receive ring stood when it came. */
uint8_t tick_take(void);

/* Says that the set-points of the tick taken last have been handed over: latches them at once
 * when that was too late for the timer. */
void tick_acted(void);

/* Says that the tick taken last has been dealt with, for tick_cycles_max. */
void tick_done(void);

/* The longest from tick to tick_done() since start, in units of 8 cycles. The simulator finds it
 * by its name. */
extern uint16_t tick_cycles_max;

#endif
