/* ticks.h: what tick.avr.c and its verdict agree on. */
#ifndef TICKS_H
#define TICKS_H

#include <stdint.h>

#define TICKS_FULL 1000 /* with a full receive ring, in the middle of a fight for vertices */
#define TICKS_QUIET 40  /* with a pose and no more; the neighbours are still remembered */

/* What is told of each tick. */
struct tick_result {
    int16_t left, right; /* wheel set-points */
    uint16_t held;       /* vertex */
    uint8_t neighbours;
    uint8_t sent; /* bytes */
};

#endif
