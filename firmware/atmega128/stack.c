#include "stack.h"

#include <avr/io.h>

#define PAINT 0xC5
#define BYTES_PER_CALL 16

/* From the linker script: the end of the variables, and the address at which the stack begins. */
extern uint8_t _end;
extern uint8_t __stack;

/* Runs between the reset and main(), with the stack still empty. */
__asm__(".pushsection .init3, \"ax\", @progbits\n"
        "    ldi r30, lo8(_end)\n"
        "    ldi r31, hi8(_end)\n"
        "    ldi r24, 0xC5\n"
        "    ldi r25, hi8(__stack + 1)\n"
        "1:  st Z+, r24\n"
        "    cpi r30, lo8(__stack + 1)\n"
        "    cpc r31, r25\n"
        "    brne 1b\n"
        ".popsection");

uint16_t stack_free(void)
{
    static uint16_t unused = UINT16_MAX; /* as far as known */
    static uint16_t seen;                /* painted bytes met in this round */

    if (unused == UINT16_MAX)
        unused = (uint16_t)(&__stack - &_end + 1);
    for (uint8_t i = 0; i < BYTES_PER_CALL; i++) {
        if (seen == unused || (&_end)[seen] != PAINT) {
            unused = seen;
            seen = 0;
            break;
        }
        seen++;
    }
    return unused;
}
