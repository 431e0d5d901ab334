#include "frame.h"

#include <stddef.h>

uint8_t frame_encode(uint8_t *frame, const uint8_t *payload, uint8_t length)
{
    if (length == 0 || length > FRAME_PAYLOAD_MAX)
        return 0;

    uint16_t crc = CRC16_INITIAL;
    uint8_t tail[FRAME_CRC_BYTES];
    uint8_t *code = frame; /* where the open run's length goes */
    uint8_t *at = frame + 1;
    uint8_t run = 1;

    for (uint8_t left = length + FRAME_CRC_BYTES; left > 0; left--) {
        if (left == FRAME_CRC_BYTES) {
            tail[0] = (uint8_t)crc;
            tail[1] = (uint8_t)(crc >> 8);
            payload = tail;
        }
        uint8_t byte = *payload++;

        crc = crc16_update(crc, byte);
        if (byte != 0) {
            *at++ = byte;
            run++;
        } else {
            *code = run;
            code = at++;
            run = 1;
        }
    }
    *code = run;
    *at++ = 0;
    return (uint8_t)(at - frame);
}

void frame_decoder_init(struct frame_decoder *decoder)
{
    decoder->length = 0;
    decoder->run = 0;
    decoder->begun = false;
    decoder->broken = false;
    decoder->crc = CRC16_INITIAL;
}

static enum frame_event finish(struct frame_decoder *decoder)
{
    uint8_t length = decoder->length;
    /* Nothing since the last zero: links may idle with zeros. */
    bool empty = !decoder->begun;
    /* The CRC of a payload followed by its own CRC is 0. */
    bool whole =
        !decoder->broken && decoder->run == 0 && length > FRAME_CRC_BYTES && decoder->crc == 0;

    frame_decoder_init(decoder);
    if (empty)
        return FRAME_PENDING;
    if (!whole)
        return FRAME_BAD;
    decoder->length = length - FRAME_CRC_BYTES;
    return FRAME_READY;
}

/* The first byte of a frame, unless it is a zero between frames: a COBS code for no zero. */
static void begin_frame(struct frame_decoder *decoder, uint8_t code)
{
    decoder->begun = true;
    decoder->run = code - 1;
    decoder->length = 0; /* drops the message handed out before */
}

/* Drops the bytes of a frame that is too long. True when it has ended. */
static bool skip_frame(const uint8_t **next, const uint8_t *end)
{
    while (*next != end)
        if (*(*next)++ == 0)
            return true;
    return false;
}

enum frame_event frame_scan(struct frame_decoder *decoder, const uint8_t **next, const uint8_t *end)
{
    while (*next != end) {
        bool ended = false;

        if (!decoder->begun) {
            uint8_t code = *(*next)++;

            if (code == 0)
                continue;
            begin_frame(decoder, code);
        }
        size_t left = (size_t)(end - *next);
        size_t room = sizeof decoder->payload - decoder->length;
        ended = frame_scan_bytes(decoder, next, (uint8_t)(left < room ? left : room));
        if (!ended && *next != end) {
            decoder->broken |= **next != 0;
            ended = skip_frame(next, end);
        }
        if (ended)
            return finish(decoder);
    }
    return FRAME_PENDING;
}
