/* Goes wrong, in the way that byte 0 of the EEPROM asks for. */
#include "crashes.h"

#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

int main(void)
{
    switch (eeprom_read_byte((const uint8_t *)0)) {
    case SLEEP_FOR_EVER:
        cli();
        sleep_mode();
        break;
    case WRITE_BEYOND_RAM:
        *(volatile uint8_t *)(RAMEND + 1) = 1;
        break;
    case ILLEGAL_INSTRUCTION:
        __asm__ volatile(".word 0x0001");
        break;
    }
    for (;;)
        ;
}
