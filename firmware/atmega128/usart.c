#include "usart.h"

#include "baud.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <util/atomic.h>

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
    baud_init();
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
