#include "plain_frame.h"

#include "frame.h"

#include <string.h>

static uint16_t crc16(const uint8_t *bytes, uint8_t count)
{
    uint16_t crc = CRC16_INITIAL;

    for (uint8_t i = 0; i < count; i++) {
        crc ^= bytes[i];
        for (uint8_t bit = 0; bit < 8; bit++)
            crc = crc & 1 ? crc >> 1 ^ 0x8408 : crc >> 1;
    }
    return crc;
}

uint8_t plain_frame_encode(uint8_t *frame, const uint8_t *payload, uint8_t length)
{
    uint8_t plain[FRAME_PAYLOAD_MAX + FRAME_CRC_BYTES];
    uint16_t crc = crc16(payload, length);
    uint8_t code = 0, end = 1;

    memcpy(plain, payload, length);
    plain[length++] = (uint8_t)crc;
    plain[length++] = (uint8_t)(crc >> 8);
    for (uint8_t i = 0; i < length; i++) {
        if (plain[i] == 0) {
            frame[code] = end - code;
            code = end++;
        } else {
            frame[end++] = plain[i];
        }
    }
    frame[code] = end - code;
    frame[end++] = 0;
    return end;
}

uint8_t plain_frame_decode(uint8_t *payload, const uint8_t *frame, uint8_t length)
{
    uint8_t plain[FRAME_BYTES_MAX];
    uint8_t count = 0, at = 0;
    uint8_t end = length - 1; /* the zero */

    while (at < end) {
        uint8_t code = frame[at++];

        if (code - 1 > end - at)
            return 0;
        for (uint8_t i = 1; i < code; i++)
            plain[count++] = frame[at++];
        if (at < end)
            plain[count++] = 0;
    }
    if (count <= FRAME_CRC_BYTES || crc16(plain, count) != 0)
        return 0;
    memcpy(payload, plain, count - FRAME_CRC_BYTES);
    return count - FRAME_CRC_BYTES;
}
