#include "watchdog.h"

#include <avr/io.h>
#include <avr/wdt.h>

#define RESET_FLAGS (_BV(PORF) | _BV(EXTRF) | _BV(BORF) | _BV(WDRF) | _BV(JTRF))

static uint8_t cause;

void watchdog_start(void)
{
    /* The flags stay set until they are cleared: this tells the next reset from this one. */
    cause = MCUCSR & RESET_FLAGS;
    MCUCSR = 0;
    wdt_enable(WDTO_250MS);
}

void watchdog_kick(void)
{
    wdt_reset();
}

uint8_t watchdog_reset_cause(void)
{
    return cause;
}
