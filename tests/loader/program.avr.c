/* Says its name and what its reset was, and then does as it is told: hangs, or calls the loader. */
#include "baud.h"
#include "flash_map.h"
#include "orders.h"
#include "watchdog.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/pgmspace.h>

static const uint8_t padding[PADDING] PROGMEM = {NAME};

static void say(uint8_t byte)
{
    loop_until_bit_is_set(UCSR0A, UDRE0);
    UDR0 = byte;
}

static void call_loader(void)
{
    UCSR0B = 0;
    __asm__ volatile("jmp %0" ::"i"(LOADER_ENTRY));
}

int main(void)
{
    uint8_t order = FIRST_ORDER;

    watchdog_start();
    baud_init();
    UCSR0B = _BV(RXEN0) | _BV(TXEN0);
    say(pgm_read_byte(padding));
    say(watchdog_reset_cause());
    for (;;) {
        watchdog_kick();
        if (order == ORDER_CALL)
            call_loader();
        while (order == ORDER_HANG)
            ;
        if (UCSR0A & _BV(RXC0))
            order = UDR0;
    }
}
