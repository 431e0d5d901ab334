/* loader.c: what comes first after a reset. It makes good an update that power cut short, listens
 * for a programmer where there may be one, and starts the program. Polls; interrupts stay off. */
#include "slots.h"
#include "stk500.h"

#include <avr/io.h>
#include <avr/wdt.h>
#include <stdbool.h>

#define WINDOW_MS 1000
#define SILENCE_MS 10000

/* Left in the last two bytes of RAM for the reset that the loader makes itself. A running program
 * has the return address of its main() there, in words and the high byte first: an address in the
 * slot begins with less than 0x7E. */
#define RESTART_MARK (*(volatile uint16_t *)(RAMEND - 1))
#define RESTARTED 0xC3A5

/* Called by start.S. */
void loader(bool by_program) __attribute__((noreturn));

static void restart(void) __attribute__((noreturn));
static void restart(void)
{
    MCUCSR = 0;
    RESTART_MARK = RESTARTED;
    wdt_enable(WDTO_15MS);
    wdt_reset(); /* simavr's watchdog goes on with the program's 250 ms until then */
    for (;;)
        ;
}

/* The program takes its reset's cause from MCUCSR: to it a restart is none. */
static uint8_t reset_cause(void)
{
    uint8_t cause = MCUCSR;

    if (cause == _BV(WDRF) && RESTART_MARK == RESTARTED)
        MCUCSR = cause = 0;
    RESTART_MARK = 0;
    return cause;
}

void loader(bool by_program)
{
    uint16_t window = SILENCE_MS;

    if (!by_program) {
        uint8_t cause = reset_cause();
        bool whole = slots_settle();

        window = !whole ? STK500_FOR_EVER : cause & (_BV(PORF) | _BV(EXTRF)) ? WINDOW_MS : 0;
    }
    if (window == 0 || (!stk500_serve(window, SILENCE_MS) && !by_program))
        slots_start();
    restart();
}
