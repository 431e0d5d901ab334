/* frame.h: from messages to bytes on a link and back.
 *
 * A frame is COBS(payload, CRC-16 little-endian) and one zero byte, the only zero on the link:
 * whatever noise comes, the next zero is a fresh start. The CRC is CRC-16/MCRF4XX: reflected
 * polynomial 0x8408, initial value 0xFFFF, no final XOR, check value 0x6F91 over "123456789". */
#ifndef FRAME_H
#define FRAME_H

#include "crc16.h"

#include <stdbool.h>
#include <stdint.h>

#define FRAME_PAYLOAD_MAX 56
#define FRAME_CRC_BYTES 2
/* COBS adds one byte below 255, the delimiter another. */
#define FRAME_BYTES(payload) ((payload) + FRAME_CRC_BYTES + 2)
#define FRAME_BYTES_MAX FRAME_BYTES(FRAME_PAYLOAD_MAX)

#define CRC16_INITIAL 0xFFFFu

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
    uint8_t run; /* bytes left before the next COBS code, which stands for a zero */
    bool begun;  /* a frame has */
    bool broken; /* it is too long */
    uint16_t crc;
};

void frame_decoder_init(struct frame_decoder *decoder);

/* Takes bytes from the link, from *next up to `end` or to the end of a frame, whichever comes
 * first. *next is then the first byte not taken. */
enum frame_event frame_scan(struct frame_decoder *decoder, const uint8_t **next,
                            const uint8_t *end);

/* A part of frame_scan(): takes `count` bytes of a frame that has begun, each of which gives one of
 * the payload and fits. True when the frame has ended, with the last byte taken. */
bool frame_scan_bytes(struct frame_decoder *decoder, const uint8_t **next, uint8_t count);

/* Takes one byte. */
static inline enum frame_event frame_decode(struct frame_decoder *decoder, uint8_t byte)
{
    const uint8_t *next = &byte;

    return frame_scan(decoder, &next, next + 1);
}

#endif
