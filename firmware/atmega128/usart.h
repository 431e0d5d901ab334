/* usart.h: the radio link on USART0, 8N1 at BAUD, through two rings. */
#ifndef USART_H
#define USART_H

#include <stdbool.h>
#include <stdint.h>

void usart_init(void);

/* A frame's end has come; whoever goes to take it sets this to false first. */
extern volatile bool usart_frame_waits;

/* Where the receive ring stands now: a place to stop taking bytes at. */
uint8_t usart_mark(void);

/* The oldest bytes that came before `mark` and lie in one piece: their number, 0 when there are
 * none. They stay in the ring until usart_drop(). */
uint8_t usart_peek(uint8_t mark, const uint8_t **bytes);

/* Gives back the room of the `count` oldest bytes. */
void usart_drop(uint8_t count);

/* Losses since start: overruns of the hardware, of one or more bytes each, and bytes that found the
 * ring full. Stops at 65,535. To be called before there are 256 new ones: every tick. */
uint16_t usart_lost(void);

/* Queues all the bytes, or none when there is no room for all of them. */
bool usart_send(const uint8_t *bytes, uint8_t length);

#endif
