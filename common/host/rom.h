/* rom.h (host): where constant tables live and how they are read.
 *
 * common/ asks its platform for this one header, found on the include path, so that the sources
 * stay the same on both sides. A host keeps constants in ordinary memory; the ATmega128's twin,
 * firmware/atmega128/rom.h, keeps them in flash, since RAM is 4 KiB. */
#ifndef ROM_H
#define ROM_H

#include <stdint.h>

#define ROM

static inline uint16_t rom_u16(const uint16_t *entry)
{
    return *entry;
}

static inline uint8_t rom_u8(const uint8_t *entry)
{
    return *entry;
}

#endif
