/* rom.h (ATmega128): constant tables stay in flash and are read with LPM.
 * The twin of common/host/rom.h. LPM reaches the low 64 KiB, far above the size of the image. */
#ifndef ROM_H
#define ROM_H

#include <avr/pgmspace.h>
#include <stdint.h>

#define ROM PROGMEM

static inline uint16_t rom_u16(const uint16_t *entry)
{
    return pgm_read_word(entry);
}

static inline uint8_t rom_u8(const uint8_t *entry)
{
    return pgm_read_byte(entry);
}

#endif
