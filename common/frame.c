#include "frame.h"

uint8_t frame_encode(uint8_t *frame, const uint8_t *payload, uint8_t length)
{
    if (length == 0 || length > FRAME_PAYLOAD_MAX)
        return 0;

    uint16_t crc = CRC16_INITIAL;
    uint8_t code = 0; /* where the open run's length goes */
    uint8_t end = 1;

    for (uint8_t i = 0; i < length + FRAME_CRC_BYTES; i++) {
        uint8_t byte;
        if (i < length) {
            byte = payload[i];
            crc = crc16_update(crc, byte);
        } else {
            byte = i == length ? (uint8_t)crc : (uint8_t)(crc >> 8);
        }
        if (byte != 0) {
            frame[end++] = byte;
        } else {
            frame[code] = end - code;
            code = end++;
        }
    }
    frame[code] = end - code;
    frame[end++] = 0;
    return end;
}

void frame_decoder_init(struct frame_decoder *decoder)
{
    decoder->length = 0;
    decoder->run = 0;
    decoder->zero_due = false;
    decoder->broken = false;
    decoder->crc = CRC16_INITIAL;
}

static enum frame_event finish(struct frame_decoder *decoder)
{
    uint8_t length = decoder->length;
    /* Nothing since the last zero: links may idle with zeros. */
    bool empty = !decoder->broken && decoder->run == 0 && !decoder->zero_due;
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

enum frame_event frame_scan(struct frame_decoder *decoder, const uint8_t **next, const uint8_t *end)
{
    const uint8_t *at = *next;
    uint8_t run = decoder->run;
    uint8_t length = decoder->length;
    uint16_t crc = decoder->crc;
    bool ended = false;

    /* What changes with every byte stays in registers: this loop sees all of a robot's traffic. */
    while (at != end && !ended) {
        uint8_t byte = *at++;

        if (byte == 0) {
            ended = true;
            continue;
        }
        if (run > 0) {
            run--;
        } else {
            bool zero = decoder->zero_due;

            run = byte - 1;
            decoder->zero_due = byte != 0xFF;
            if (!zero) {
                length = 0; /* drops the message handed out before */
                continue;
            }
            byte = 0;
        }
        if (length == sizeof decoder->payload) {
            decoder->broken = true;
            continue;
        }
        decoder->payload[length++] = byte;
        crc = crc16_update(crc, byte);
    }
    *next = at;
    decoder->run = run;
    decoder->length = length;
    decoder->crc = crc;
    return ended ? finish(decoder) : FRAME_PENDING;
}

static const uint8_t *take(struct reader *in, uint8_t count)
{
    static const uint8_t nothing[4];

    if (in->left < count) {
        in->left = 0;
        in->ok = false;
        return nothing;
    }
    const uint8_t *at = in->next;
    in->next += count;
    in->left -= count;
    return at;
}

uint8_t read_u8(struct reader *in)
{
    return *take(in, 1);
}

uint16_t read_u16(struct reader *in)
{
    const uint8_t *b = take(in, 2);

    return (uint16_t)(b[0] | (uint16_t)b[1] << 8);
}

int32_t read_i24(struct reader *in)
{
    const uint8_t *b = take(in, 3);
    uint32_t bits = b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16;

    return (int32_t)(bits ^ 0x800000) - 0x800000;
}

int32_t read_i32(struct reader *in)
{
    const uint8_t *b = take(in, 4);

    return (int32_t)(b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24);
}

static void put(struct writer *out, uint32_t value, uint8_t count)
{
    if (out->left < count) {
        out->left = 0;
        out->ok = false;
        return;
    }
    out->left -= count;
    while (count-- > 0) {
        *out->next++ = (uint8_t)value;
        value >>= 8;
    }
}

void write_u8(struct writer *out, uint8_t value)
{
    put(out, value, 1);
}

void write_u16(struct writer *out, uint16_t value)
{
    put(out, value, 2);
}

void write_i24(struct writer *out, int32_t value)
{
    if (value > 8388607)
        value = 8388607;
    if (value < -8388607)
        value = -8388607;
    put(out, (uint32_t)value, 3);
}

void write_i32(struct writer *out, int32_t value)
{
    put(out, (uint32_t)value, 4);
}
