/* marks.h: runs a benchmark's image in a simulated ATmega128 and reads what it says (mark.h).
 *
 * Whatever goes wrong ends the program, with words. */
#ifndef MARKS_H
#define MARKS_H

#include "avr_core.h"

struct mark {
    uint8_t byte;
    uint64_t cycle;
};

struct marks {
    const char *name;
    struct avr_image *image;
    struct avr_core *core;
    uint64_t empty; /* cycles between the marks of an empty function */
    size_t taken, heard;
    struct mark queue[1024];
};

/* Starts the image NAME.elf of the firmware preset. */
void marks_open(struct marks *marks, const char *name);

/* The next measured call: its cycles, and the `size` bytes of its result. */
uint32_t marks_measure(struct marks *marks, void *result, size_t size);

/* The image must have nothing more to say. */
void marks_close(struct marks *marks);

#endif
