#include "packet.h"

#include <assert.h>
#include <string.h>

void put_bytes(struct packet *packet, const void *bytes, size_t count)
{
    assert(count <= PACKET_ROOM - packet->count);
    memcpy(packet->bytes + packet->count, bytes, count);
    packet->count += count;
}

void put_zeros(struct packet *packet, size_t count)
{
    assert(count <= PACKET_ROOM - packet->count);
    memset(packet->bytes + packet->count, 0, count);
    packet->count += count;
}

void put_text(struct packet *packet, const char *text)
{
    put_bytes(packet, text, strlen(text));
}

void put_field(struct packet *packet, const char *text, size_t width)
{
    put_text(packet, text);
    put_zeros(packet, width - strlen(text));
}

static void put_le(struct packet *packet, uint64_t value, int size)
{
    for (int i = 0; i < size; i++)
        put_u8(packet, (uint8_t)(value >> 8 * i));
}

static void put_be(struct packet *packet, uint64_t value, int size)
{
    for (int i = size - 1; i >= 0; i--)
        put_u8(packet, (uint8_t)(value >> 8 * i));
}

void put_u8(struct packet *packet, uint8_t value)
{
    put_bytes(packet, &value, 1);
}

void put_u16_le(struct packet *packet, uint16_t value)
{
    put_le(packet, value, 2);
}

void put_u32_le(struct packet *packet, uint32_t value)
{
    put_le(packet, value, 4);
}

void put_u64_le(struct packet *packet, uint64_t value)
{
    put_le(packet, value, 8);
}

void put_f32_le(struct packet *packet, float value)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    put_le(packet, bits, 4);
}

void put_f64_le(struct packet *packet, double value)
{
    uint64_t bits;

    memcpy(&bits, &value, sizeof bits);
    put_le(packet, bits, 8);
}

void put_u32_be(struct packet *packet, uint32_t value)
{
    put_be(packet, value, 4);
}

void put_f64_be(struct packet *packet, double value)
{
    uint64_t bits;

    memcpy(&bits, &value, sizeof bits);
    put_be(packet, bits, 8);
}
