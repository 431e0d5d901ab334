/* own_flash.h: the flash of one simulated ATmega128, which its boot loader can write to, and which
 * outlives power.
 *
 * Storing takes the time of the data sheet. A page whose erasing or writing is cut short, by power
 * or by a reset, holds rubbish. */
#ifndef SIM_OWN_FLASH_H
#define SIM_OWN_FLASH_H

#include "atmega128.h"
#include "avr_image.h"
#include "flash_map.h"

#include <sim_avr.h>
#include <stdbool.h>
#include <stdint.h>

#define FLASH_BUSY_US 4500 /* an erase or a write (data sheet, "SPM Programming Time", maximum) */

struct own_flash {
    uint8_t bytes[FLASH_BYTES + 4]; /* simavr wants more than there is */
    unsigned operations;            /* pages erased and written so far, those cut short with them */
    bool busy;                      /* with one now */

    /* What the program did that a chip does not allow, or answers with nonsense; NULL: nothing. */
    const char *fault;

    /* own_flash.c's */
    avr_t *avr;
    avr_io_t io;
    uint64_t armed; /* when SPMCSR was written */
    uint32_t page;  /* what it is busy with, and what is there when it is done */
    uint8_t coming[FLASH_PAGE_BYTES];
    uint8_t buffer[FLASH_PAGE_BYTES];
};

/* NULL when there is no memory. */
struct own_flash *own_flash_new(void);

/* Writes a program to the slot; a loader to its place. Without a core. */
void own_flash_put_program(struct own_flash *flash, const struct avr_image *program);
void own_flash_put_loader(struct own_flash *flash, const struct avr_image *loader);

/* Becomes the flash of a core that has just been made. */
void own_flash_attach(struct own_flash *flash, avr_t *avr);

/* While it watches, the core must go on by own_flash_step(), an instruction at a time. */
bool own_flash_watches(const struct own_flash *flash);
void own_flash_step(struct own_flash *flash);

#endif
