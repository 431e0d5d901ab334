/* wire.h: numbers on the link, little-endian as the processors at both ends are.
 *
 * Each function takes from, or puts at, *at and moves it on. None checks a length: whoever reads a
 * message has compared it with what its type requires, whoever writes one has room for the longest.
 */
#ifndef WIRE_H
#define WIRE_H

#include <stdint.h>
#include <string.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "numbers are copied as they are");

static inline uint8_t take_u8(const uint8_t **at)
{
    return *(*at)++;
}

static inline uint16_t take_u16(const uint8_t **at)
{
    uint16_t value;

    memcpy(&value, *at, sizeof value);
    *at += sizeof value;
    return value;
}

static inline int32_t take_i24(const uint8_t **at)
{
    uint16_t low = take_u16(at);

    return (int32_t)(int8_t)take_u8(at) * 65536 + low;
}

static inline int32_t take_i32(const uint8_t **at)
{
    int32_t value;

    memcpy(&value, *at, sizeof value);
    *at += sizeof value;
    return value;
}

static inline void put_u8(uint8_t **at, uint8_t value)
{
    *(*at)++ = value;
}

static inline void put_u16(uint8_t **at, uint16_t value)
{
    memcpy(*at, &value, sizeof value);
    *at += sizeof value;
}

/* Saturates at +-8,388,607. */
static inline void put_i24(uint8_t **at, int32_t value)
{
    if (value > 8388607)
        value = 8388607;
    if (value < -8388607)
        value = -8388607;
    memcpy(*at, &value, 3);
    *at += 3;
}

static inline void put_i32(uint8_t **at, int32_t value)
{
    memcpy(*at, &value, sizeof value);
    *at += sizeof value;
}

#endif
