/* crashes.h: what crash.avr.c can be asked for. */
#ifndef CRASHES_H
#define CRASHES_H

enum crash {
    SLEEP_FOR_EVER,
    WRITE_BEYOND_RAM,
    ILLEGAL_INSTRUCTION,
    STACK_OVERFLOW,
    LARGE_FRAME, /* larger than the RAM, and hardly written to */
    NONE
};

#endif
