#include "leave.h"

#include "flash_map.h"
#include "motors.h"
#include "watchdog.h"

#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/pgmspace.h>

#define BLANK 0xFFFF

void leave_for_loader(void)
{
    if (pgm_read_word_far(LOADER_START) == BLANK)
        return;
    cli();
    motors_hand_over(0, 0);
    motors_latch();
    watchdog_stop();
    TIMSK = 0;
    TCCR1B = 0;
    TCCR3A = TCCR3B = 0;
    UCSR0B = 0;
    ADCSRA = 0;
    MCUCR = 0;
    eeprom_busy_wait();
    __asm__ volatile("jmp %0" ::"i"(LOADER_ENTRY));
    __builtin_unreachable();
}
