/* report.h: how a test image speaks to its verdict. */
#ifndef REPORT_H
#define REPORT_H

/* The last byte of every image that ran to its end. */
#define REPORT_END 0xED

#ifdef __AVR__
#include "pins.h"
#include "usart.h"

#include <avr/io.h>

/* Sends through the board's own transmitter; interrupts must be on. */
static inline void report(const uint8_t *bytes, uint8_t length)
{
    while (!usart_send(bytes, length))
        ;
}

static inline void report_byte(uint8_t byte)
{
    report(&byte, 1);
}

static inline void light_led(void)
{
    PIN_DDR(PIN_LED) |= PIN_MASK(PIN_LED);
    PIN_PORT(PIN_LED) |= PIN_MASK(PIN_LED);
}
#endif

#endif
