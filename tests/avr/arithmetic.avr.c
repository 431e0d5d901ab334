/* Sends the hash of every function's results. */
#include "arithmetic.h"
#include "report.h"

#include <avr/interrupt.h>
#include <avr/sleep.h>

int main(void)
{
    usart_init();
    sei();
    for (uint8_t i = 0; i < ARITHMETIC_FUNCTIONS; i++) {
        uint32_t hash = arithmetic_hash(i);

        report((const uint8_t *)&hash, sizeof hash);
    }
    report_byte(REPORT_END);
    for (;;)
        sleep_mode();
}
