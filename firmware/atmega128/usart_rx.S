/* usart_rx.S: the receiver's interrupt. It runs for every byte of a fleet's traffic, 4,000 times a
 * second with a hundred robots, so it is written for the chip: 55 cycles from the interrupt to the
 * end of its return, where the compiler's takes 86. In C, with the names of usart.c:
 *
 *     status = UCSR0A;  byte = UDR0;            DOR is of the byte in UDR0, and goes with it
 *     rx[rx_head] = byte;
 *     if (byte == 0)               usart_frame_waits = true;
 *     if (rx_head + 1 != rx_tail)  rx_head++;   else  rx_lost++;
 *     if (status & DOR0)           rx_lost++;
 */
#include <avr/io.h>

#define status r25
#define byte   r24

.section .bss.usart_rx, "aw", @nobits
.global usart_rx, usart_rx_head, usart_rx_tail, usart_rx_lost, usart_frame_waits
usart_rx:          .skip 256
usart_rx_head:     .skip 1
usart_rx_tail:     .skip 1
usart_rx_lost:     .skip 1
usart_frame_waits: .skip 1

.section .text.usart_rx, "ax", @progbits
.global USART0_RX_vect
USART0_RX_vect:
    push byte
    in   byte, _SFR_IO_ADDR(SREG)
    push byte
    push status
    push r30
    push r31

    in   status, _SFR_IO_ADDR(UCSR0A)
    in   byte, _SFR_IO_ADDR(UDR0)
    lds  r30, usart_rx_head
    ldi  r31, 0
    subi r30, lo8(-(usart_rx))
    sbci r31, hi8(-(usart_rx))
    st   Z, byte
    tst  byte
    breq frame_ends

keep:
    lds  r30, usart_rx_head
    lds  r31, usart_rx_tail
    inc  r30
    cp   r30, r31
    breq full
    sts  usart_rx_head, r30
    sbrc status, DOR0
    rjmp lose

leave:
    pop  r31
    pop  r30
    pop  status
    pop  byte
    out  _SFR_IO_ADDR(SREG), byte
    pop  byte
    reti

frame_ends:
    ldi  r30, 1
    sts  usart_frame_waits, r30
    rjmp keep

full:
    lds  r30, usart_rx_lost
    inc  r30
    sts  usart_rx_lost, r30
    sbrs status, DOR0
    rjmp leave

lose:
    lds  r30, usart_rx_lost
    inc  r30
    sts  usart_rx_lost, r30
    rjmp leave
