/* baud.h: how USART0 is set to BAUD, for the program and for the boot loader. */
#ifndef BAUD_H
#define BAUD_H

#include <avr/io.h>

/* The receiver takes 16 or 8 samples a bit (data sheet, "Asynchronous Data Reception"). 16 stand
 * more noise, so they are used unless 8 come closer to the baud rate. */
#define DIVIDER(samples) ((F_CPU + BAUD * (samples) / 2) / (BAUD * (samples)))
#define REAL_BAUD(samples) (F_CPU / (samples) / DIVIDER(samples))
#define DISTANCE(a, b) ((a) > (b) ? (a) - (b) : (b) - (a))
#define ERROR(samples) DISTANCE(REAL_BAUD(samples), BAUD)

#if ERROR(8) < ERROR(16)
#define SAMPLES 8
#else
#define SAMPLES 16
#endif

#if ERROR(SAMPLES) * 1000 > BAUD * 25
#error "BAUD is more than 2.5 % away from any rate that F_CPU can be divided to"
#endif

#if DIVIDER(SAMPLES) > 4096
#error "BAUD is too low for F_CPU"
#endif

/* What UCSR0A holds meanwhile. */
#define BAUD_UCSR0A (SAMPLES == 8 ? _BV(U2X0) : 0)

/* 8N1 at BAUD. */
static inline void baud_init(void)
{
    UCSR0A = BAUD_UCSR0A;
    UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
    UBRR0H = (DIVIDER(SAMPLES) - 1) >> 8;
    UBRR0L = (DIVIDER(SAMPLES) - 1) & 0xFF;
}

#endif
