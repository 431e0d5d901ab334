/* slots.h: the program's slot and the stage (common/flash_map.h). The watchdog, where it runs, is
 * kicked by whatever takes long. */
#ifndef SLOTS_H
#define SLOTS_H

#include <stdbool.h>
#include <stdint.h>

/* Moves a whole stage to the slot unless it is there already. True when the slot then holds a
 * whole program. Power may be cut at any moment: the next call makes it good. */
bool slots_settle(void);

/* Starts what is in the slot. */
void slots_start(void) __attribute__((noreturn));

/* From now on the stage is not whole. */
void stage_break(void);

/* FLASH_PAGE_BYTES; `at` is the beginning of a page. */
void stage_write(uint16_t at, const uint8_t *page);

/* 1 byte or more. */
void stage_read(uint8_t *bytes, uint16_t at, uint16_t count);

#endif
