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
    MCUCSR = 0x54,
    RAMPZ = 0x5B,
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
    MCUCSR_EXTRF = 0x02,
    UCSRB_TXEN = 0x08,
    UCSRB_RXEN = 0x10,
    UCSRA_DOR = 0x08,
    TCCRB_CLOCK = 0x07, /* CSn2:0, 0 = stopped */
    TCCR3A_MODE = 0xA2, /* outputs A and B high until the match; mode 14, low bits */
    TCCR3B_MODE = 0x19, /* mode 14, high bits; clock not divided */
    SPM_ENABLE = 0x01,  /* SPMEN; alone it fills the page buffer */
    SPM_ERASE = 0x02,
    SPM_WRITE = 0x04,
    SPM_FUSES = 0x08,    /* BLBSET: the next LPM reads fuses and lock bits */
    SPM_READABLE = 0x10, /* RWWSRE */
    SPM_COMMAND = 0x1F,
    SPM_BLOCKED = 0x40, /* RWWSB */
};

#define FLASH_BYTES 0x20000u

/* What lies below cannot be read while a page of it is written; what lies above holds the
 * processor meanwhile (data sheet, "Read-While-Write and No Read-While-Write Flash Sections"). */
#define FLASH_RWW_BYTES 0x1E000u

#endif
