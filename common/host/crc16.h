/* crc16.h (host): one byte of the link's checksum (frame.h), in plain C.
 *
 * The twin of firmware/atmega128/crc16.h, where avr-libc does it. */
#ifndef CRC16_H
#define CRC16_H

#include <stdint.h>

static inline uint16_t crc16_update(uint16_t crc, uint8_t byte)
{
    byte ^= (uint8_t)crc;
    byte ^= (uint8_t)(byte << 4);
    return (uint16_t)((byte << 8 | crc >> 8) ^ (byte >> 4) ^ (byte << 3));
}

#endif
