/* Stands still twice while bytes come in: with interrupts off, then without taking any. Each time
 * it says how many bytes it still has, how many were lost, and which it has. */
#include "report.h"

#include <avr/interrupt.h>
#include <avr/sleep.h>
#include <string.h>
#include <util/delay.h>

/* As receiver.c. */
#define DEAF_MS 2
#define IDLE_MS 40

static void send_report(void)
{
    static uint8_t bytes[256];
    uint8_t mark = usart_mark();
    uint8_t count = 0;
    uint8_t part;
    const uint8_t *from;

    while ((part = usart_peek(mark, &from)) > 0) {
        memcpy(bytes + count, from, part);
        count += part;
        usart_drop(part);
    }
    report_byte(count);
    report_byte((uint8_t)usart_lost());
    for (uint8_t i = 0; i < count; i++)
        report_byte(bytes[i]);
    report_byte(REPORT_END);
}

int main(void)
{
    usart_init();
    light_led();
    _delay_ms(DEAF_MS);
    sei();
    _delay_ms(1);
    send_report();
    _delay_ms(IDLE_MS);
    send_report();
    for (;;)
        sleep_mode();
}
