/* atmega128.h: addresses in the data space of the ATmega128 (data sheet, "Register Summary").
 * Named as in the data sheet, so that the macros of firmware/atmega128/pins.h fit. */
#ifndef SIM_ATMEGA128_H
#define SIM_ATMEGA128_H

enum {
    DDRE = 0x22,
    PORTE = 0x23,
    UBRR0L = 0x29,
    UCSR0B = 0x2A,
    UCSR0A = 0x2B,
    UDR0 = 0x2C,
    DDRD = 0x31,
    PORTD = 0x32,
    DDRC = 0x34,
    PORTC = 0x35,
    DDRB = 0x37,
    PORTB = 0x38,
    DDRA = 0x3A,
    PORTA = 0x3B,
    WDTCR = 0x41,
    OCDR = 0x42,
    TCCR1B = 0x4E,
    SPL = 0x5D,
    SPH = 0x5E,
    SPMCSR = 0x68,
    ICR3L = 0x80,
    OCR3BL = 0x84,
    OCR3AL = 0x86,
    TCCR3B = 0x8A,
    TCCR3A = 0x8B,
    SRAM_START = 0x100,
    SRAM_END = 0x10FF,
};

enum {
    UCSRB_TXEN = 0x08,
    UCSRB_RXEN = 0x10,
    UCSRA_DOR = 0x08,
    TCCRB_CLOCK = 0x07, /* CSn2:0, 0 = stopped */
    TCCR3A_MODE = 0xA2, /* outputs A and B high until the match; mode 14, low bits */
    TCCR3B_MODE = 0x19, /* mode 14, high bits; clock not divided */
};

#define FLASH_BYTES 0x20000u

#endif
