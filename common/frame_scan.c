/* frame_scan.c: the inner loop of frame_scan(). The ATmega128 has it in its own instructions,
 * firmware/atmega128/frame_scan.S. */
#include "frame.h"

bool frame_scan_bytes(struct frame_decoder *decoder, const uint8_t **next, uint8_t count)
{
    const uint8_t *at = *next;
    uint8_t *to = decoder->payload + decoder->length;
    uint16_t crc = decoder->crc;
    uint8_t run = decoder->run;
    bool ended = false;

    for (; count > 0; count--) {
        uint8_t byte = *at++;

        if (byte == 0) {
            ended = true;
            break;
        }
        if (run == 0) {
            run = byte;
            byte = 0;
        }
        run--;
        *to++ = byte;
        crc = crc16_update(crc, byte);
    }
    *next = at;
    decoder->length = (uint8_t)(to - decoder->payload);
    decoder->crc = crc;
    decoder->run = run;
    return ended;
}
