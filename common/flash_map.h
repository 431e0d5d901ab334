/* flash_map.h: what lies where in the ATmega128's 128 KiB of flash, in bytes.
 *
 *   0x00000  the program's slot     what runs
 *   0x0FC00  the stage              where an update is gathered; the loader copies it to the slot
 *                                   once it is whole
 *   0x1F800  the boot loader        1,024 words: fuses BOOTSZ 10, BOOTRST 0 (data sheet, "Boot Size
 *                                   Configuration")
 *
 * A program is whole when the seal at the end of its slot agrees with it. */
#ifndef FLASH_MAP_H
#define FLASH_MAP_H

#include <stdint.h>

#define FLASH_PAGE_BYTES 256
#define SLOT_BYTES 0xFC00u
#define STAGE_START 0xFC00ul
#define LOADER_START 0x1F800ul

/* Where a running program enters the loader to be given another one: the loader then waits for
 * it, and what the program used is switched off by it before. The word before is the reset's. */
#define LOADER_ENTRY (LOADER_START + 2)

/* The last bytes of a slot, alone in their page. */
#define SEAL_AT (SLOT_BYTES - 8)
#define PROGRAM_BYTES_MAX (SLOT_BYTES - FLASH_PAGE_BYTES)

struct seal {
    uint16_t length;     /* bytes of the program, 1 to PROGRAM_BYTES_MAX, from 0 on */
    uint16_t complement; /* ~length */
    uint32_t crc;        /* CRC-32 of them as in zlib: polynomial 0x04C11DB7 reflected, initial and
                            final 0xFFFFFFFF; of "123456789" it is 0xCBF43926 */
};

#endif
