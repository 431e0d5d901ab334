/* flash.h: the flash as the loader's own instructions reach it. Addresses are in bytes. The
 * watchdog is kicked by whatever takes long. */
#ifndef FLASH_H
#define FLASH_H

#include <stdint.h>

/* 1 byte or more. */
void flash_read(void *into, uint32_t at, uint16_t count);

/* CRC-32 of 1 byte or more, by a table of what it is for each single byte. */
uint32_t flash_crc(uint32_t at, uint16_t count, const uint32_t *table);

/* These return when it is done, 4.5 ms later or 9. A write erases before. */
void flash_erase(uint32_t page);
void flash_write(uint32_t page, const uint8_t *bytes);

/* 0 the low fuses, 1 the lock bits, 2 the extended fuses, 3 the high ones. */
uint8_t flash_read_fuses(uint8_t which);

#endif
