#include "usart.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

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

/* Indices of 8 bits wrap with the ring, which holds more than arrives between two control ticks at
 * 115,200 baud. */
extern uint8_t usart_rx[256]; /* usart_rx.S has it, and fills it */
extern volatile uint8_t usart_rx_head, usart_rx_tail;
extern volatile uint8_t usart_rx_lost; /* modulo 256: usart_lost() sees to it in time */

#define TX_SIZE 64 /* a power of two above BRAIN_FRAMES_MAX */
static volatile uint8_t tx[TX_SIZE];
static volatile uint8_t tx_head, tx_tail;

void usart_init(void)
{
    UCSR0A = SAMPLES == 8 ? _BV(U2X0) : 0;
    UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
    UBRR0H = (DIVIDER(SAMPLES) - 1) >> 8;
    UBRR0L = (DIVIDER(SAMPLES) - 1) & 0xFF;
    UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
}

ISR(USART0_UDRE_vect)
{
    uint8_t tail = tx_tail;

    if (tail == tx_head) {
        UCSR0B &= (uint8_t)~_BV(UDRIE0);
        return;
    }
    UDR0 = tx[tail];
    tx_tail = (tail + 1) % TX_SIZE;
}

uint8_t usart_mark(void)
{
    return usart_rx_head;
}

uint8_t usart_peek(uint8_t mark, const uint8_t **bytes)
{
    uint8_t tail = usart_rx_tail;

    *bytes = &usart_rx[tail];
    return mark >= tail ? mark - tail : (uint8_t)-tail;
}

void usart_drop(uint8_t count)
{
    usart_rx_tail += count;
}

uint16_t usart_lost(void)
{
    static uint16_t lost;
    static uint8_t seen;
    uint8_t now = usart_rx_lost;
    uint8_t more = now - seen;

    seen = now;
    lost = more > UINT16_MAX - lost ? UINT16_MAX : lost + more;
    return lost;
}

bool usart_send(const uint8_t *bytes, uint8_t length)
{
    uint8_t head = tx_head;
    uint8_t queued = (uint8_t)(head - tx_tail) % TX_SIZE;

    if (length > TX_SIZE - 1 - queued)
        return false;
    for (uint8_t i = 0; i < length; i++) {
        tx[head] = bytes[i];
        head = (head + 1) % TX_SIZE;
    }
    tx_head = head;
    /* The interrupt for an empty data register clears this bit: not in two halves. */
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        UCSR0B |= _BV(UDRIE0);
    }
    return true;
}
