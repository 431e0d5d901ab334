/* packet.h: messages of motion-capture systems, put together field by field. */
#ifndef PACKET_H
#define PACKET_H

#include <stddef.h>
#include <stdint.h>

#define PACKET_ROOM 65536

struct packet {
    size_t count;
    uint8_t bytes[PACKET_ROOM];
};

void put_bytes(struct packet *packet, const void *bytes, size_t count);
void put_zeros(struct packet *packet, size_t count);

/* The text without its NUL. */
void put_text(struct packet *packet, const char *text);

/* The text in a field of `width` bytes, filled up with NULs. */
void put_field(struct packet *packet, const char *text, size_t width);

void put_u8(struct packet *packet, uint8_t value);
void put_u16_le(struct packet *packet, uint16_t value);
void put_u32_le(struct packet *packet, uint32_t value);
void put_u64_le(struct packet *packet, uint64_t value);
void put_f32_le(struct packet *packet, float value);
void put_f64_le(struct packet *packet, double value);
void put_u32_be(struct packet *packet, uint32_t value);
void put_f64_be(struct packet *packet, double value);

#endif
