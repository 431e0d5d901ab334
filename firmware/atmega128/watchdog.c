#include "watchdog.h"

#include <avr/io.h>
#include <avr/wdt.h>

#define RESET_FLAGS (_BV(PORF) | _BV(EXTRF) | _BV(BORF) | _BV(WDRF) | _BV(JTRF))

static uint8_t cause;
static uint16_t resets __attribute__((section(".noinit")));

void watchdog_start(void)
{
    /* The flags stay set until they are cleared: this tells the next reset from this one. */
    cause = MCUCSR & RESET_FLAGS;
    MCUCSR = 0;
    /* Without a cause it was the boot loader that started the program, whose RAM this was. */
    if (cause == 0 || cause & _BV(PORF))
        resets = 0;
    else
        resets++;
    wdt_enable(WDTO_250MS);
}

void watchdog_kick(void)
{
    wdt_reset();
}

void watchdog_stop(void)
{
    wdt_disable();
}

uint16_t watchdog_resets(void)
{
    return resets;
}

uint8_t watchdog_reset_cause(void)
{
    return cause;
}
