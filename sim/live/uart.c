#include "uart.h"

void uart_put(struct uart *uart, const uint8_t *bytes, size_t count)
{
    size_t room = UART_ROOM - uart->count;
    size_t kept = count < room ? count : room;

    for (size_t i = 0; i < kept; i++)
        uart->byte[(uart->first + uart->count + i) % UART_ROOM] = bytes[i];
    uart->count += kept;
    uart->lost += count - kept;
}

size_t uart_take(struct uart *uart, uint8_t *bytes, size_t room)
{
    size_t taken = uart->count < room ? uart->count : room;

    for (size_t i = 0; i < taken; i++)
        bytes[i] = uart->byte[(uart->first + i) % UART_ROOM];
    uart->first = (uart->first + taken) % UART_ROOM;
    uart->count -= taken;
    return taken;
}
