/* Goes wrong, in the way that byte 0 of the EEPROM asks for. */
#include "crashes.h"
#include "stack.h"

#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

extern uint8_t _end; /* of the variables, from the linker script */

static void recurse(void)
{
    volatile uint8_t frame[16];

    for (uint8_t i = 0; i < sizeof frame; i++)
        frame[i] = i;
    if (frame > &_end)
        recurse();
    frame[0] = 0; /* else the call above is no call */
}

static __attribute__((noinline)) void reserve(void)
{
    volatile uint8_t frame[RAMEND - RAMSTART + 1];

    frame[sizeof frame - 1] = 0;
}

int main(void)
{
    stack_free(); /* links the painting of the stack, which the simulator wants to see */
    switch (eeprom_read_byte((const uint8_t *)0)) {
    case SLEEP_FOR_EVER:
        cli();
        sleep_mode();
        break;
    case WRITE_BEYOND_RAM: *(volatile uint8_t *)(RAMEND + 1) = 1; break;
    case ILLEGAL_INSTRUCTION: __asm__ volatile(".word 0x0001"); break;
    case STACK_OVERFLOW: recurse(); break;
    case LARGE_FRAME: reserve(); break;
    }
    for (;;)
        ;
}
