/* uart.h: what has come from the host and waits for the robot's UART, which takes it at its own
 * pace. Bytes that find no room are lost. Pure; a zeroed struct is empty. */
#ifndef LIVE_UART_H
#define LIVE_UART_H

#include <stddef.h>
#include <stdint.h>

#define UART_ROOM 1024

struct uart {
    size_t first, count;
    uint64_t lost; /* bytes, since the beginning */
    uint8_t byte[UART_ROOM];
};

void uart_put(struct uart *uart, const uint8_t *bytes, size_t count);

/* Takes at most `room` bytes, the oldest first. */
size_t uart_take(struct uart *uart, uint8_t *bytes, size_t room);

#endif
