/* program.h: a program for robots as an update sends it: sealed, and judged by its seal
 * (flash_map.h). */
#ifndef PROGRAM_H
#define PROGRAM_H

#include "flash_map.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define PROGRAM_PAGES_MAX (SLOT_BYTES / FLASH_PAGE_BYTES)

struct program {
    uint8_t slot[SLOT_BYTES]; /* what a robot's is to hold; 0xFF where there is nothing */
    uint16_t length;          /* bytes */
    uint32_t crc;             /* by which it is told from others */
    uint32_t baud;            /* that it speaks */
};

/* Takes it from `flash`, the FLASH_BYTES of an image (0xFF where that has nothing). False, and what
 * is wrong with it in `words`, when it is not sealed, damaged, or not for a slot alone. */
bool program_take(struct program *program, const uint8_t *flash, uint32_t baud, char *words,
                  size_t room);

/* The pages that an update sends, in this order: those of the program, and the seal's. */
uint16_t program_pages(const struct program *program);

/* Where in the slot one of them begins. */
uint16_t program_page_at(const struct program *program, uint16_t page);

#endif
