#include "tick.h"

#include "limits.h"
#include "motors.h"
#include "usart.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

#define TIMER_HZ (F_CPU / 8)
#define PERIOD (TIMER_HZ / TICKS_PER_S)
#define ACTUATION (TIMER_HZ / 1000 * ACTUATION_MS + TIMER_HZ % 1000 * ACTUATION_MS / 1000)

#if F_CPU % (8 * TICKS_PER_S) != 0 || PERIOD > 65536
#error "F_CPU cannot be divided to the control tick; 16000000 and 14745600 can"
#endif

volatile bool tick_pending;
static volatile bool actuated;
static volatile uint8_t mark_at_tick;
uint16_t tick_cycles_max;

void tick_start(void)
{
    /* Count up to OCR1A and start again (CTC, mode 4); the match is at the end of the count. */
    OCR1A = PERIOD - 1;
    OCR1B = ACTUATION - 1;
    TIMSK = _BV(OCIE1A) | _BV(OCIE1B);
    TCCR1B = _BV(WGM12) | _BV(CS11);
}

ISR(TIMER1_COMPA_vect)
{
    mark_at_tick = usart_mark();
    actuated = false;
    tick_pending = true;
}

ISR(TIMER1_COMPB_vect)
{
    motors_latch();
    actuated = true;
}

uint8_t tick_take(void)
{
    uint8_t mark;

    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        tick_pending = false;
        mark = mark_at_tick;
    }
    return mark;
}

void tick_acted(void)
{
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        if (actuated)
            motors_latch();
    }
}

void tick_done(void)
{
    uint16_t count;

    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        count = tick_pending ? UINT16_MAX : TCNT1; /* the next tick has come already */
    }
    if (count > tick_cycles_max)
        tick_cycles_max = count;
}
