/* frame.h: from messages to bytes on a link and back.
 *
 * A frame is COBS(payload, CRC-16 little-endian) and one zero byte, the only zero on the link:
 * whatever noise comes, the next zero is a fresh start. The CRC is CRC-16/MCRF4XX: reflected
 * polynomial 0x8408, initial value 0xFFFF, no final XOR, check value 0x6F91 over "123456789". */
#ifndef FRAME_H
#define FRAME_H

#include <stdbool.h>
#include <stdint.h>

#define FRAME_PAYLOAD_MAX 56
#define FRAME_CRC_BYTES 2
/* COBS adds one byte below 255, the delimiter another. */
#define FRAME_BYTES_MAX (FRAME_PAYLOAD_MAX + FRAME_CRC_BYTES + 2)

#define CRC16_INITIAL 0xFFFFu

__attribute__((always_inline)) static inline uint16_t crc16_update(uint16_t crc, uint8_t byte)
{
    byte ^= (uint8_t)crc;
    byte ^= (uint8_t)(byte << 4);
    /* Byte by byte: an 8-bit processor shifts 16 bits one at a time. */
    uint8_t low = (uint8_t)((crc >> 8) ^ (byte >> 4) ^ (uint8_t)(byte << 3));
    uint8_t high = byte ^ (byte >> 5);
    return (uint16_t)((uint16_t)high << 8 | low);
}

/* Writes the frame of `payload` (1..FRAME_PAYLOAD_MAX bytes) to `frame`, which has room for
 * FRAME_BYTES_MAX. Returns its length, 0 when `length` is out of range. */
uint8_t frame_encode(uint8_t *frame, const uint8_t *payload, uint8_t length);

enum frame_event {
    FRAME_PENDING, /* no frame ends here */
    FRAME_READY,   /* payload[0..length) is a whole message; valid until the next byte */
    FRAME_BAD,     /* a frame ended that was too long, cut short or failed its CRC */
};

struct frame_decoder {
    uint8_t payload[FRAME_PAYLOAD_MAX + FRAME_CRC_BYTES];
    uint8_t length;
    uint8_t run;   /* bytes left before the next COBS code */
    bool zero_due; /* that code stands for a zero */
    bool broken;
    uint16_t crc;
};

void frame_decoder_init(struct frame_decoder *decoder);

/* Takes bytes from the link, from *next up to `end` or to the end of a frame, whichever comes
 * first. *next is then the first byte not taken. */
enum frame_event frame_scan(struct frame_decoder *decoder, const uint8_t **next,
                            const uint8_t *end);

/* Takes one byte. */
static inline enum frame_event frame_decode(struct frame_decoder *decoder, uint8_t byte)
{
    const uint8_t *next = &byte;

    return frame_scan(decoder, &next, next + 1);
}

/* A bounds-checked cursor over a payload. Reading past the end gives zeros and clears `ok`. */
struct reader {
    const uint8_t *next;
    uint8_t left;
    bool ok;
};

uint8_t read_u8(struct reader *in);
uint16_t read_u16(struct reader *in);
int32_t read_i24(struct reader *in);
int32_t read_i32(struct reader *in);

/* The same for writing into FRAME_PAYLOAD_MAX bytes; writing past the end writes nothing and
 * clears `ok`. */
struct writer {
    uint8_t *next;
    uint8_t left;
    bool ok;
};

void write_u8(struct writer *out, uint8_t value);
void write_u16(struct writer *out, uint16_t value);
void write_i24(struct writer *out, int32_t value); /* saturates at +-8,388,607 */
void write_i32(struct writer *out, int32_t value);

#endif
