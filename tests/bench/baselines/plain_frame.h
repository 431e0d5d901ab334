/* plain_frame.h: the codec of frame.h a byte and a bit at a time, as its description reads. */
#ifndef PLAIN_FRAME_H
#define PLAIN_FRAME_H

#include <stdint.h>

/* The room in `frame` and `payload` is that of frame.h. Both return the length of what they wrote;
 * 0 for a frame that is cut short or fails its CRC. */
uint8_t plain_frame_encode(uint8_t *frame, const uint8_t *payload, uint8_t length);
uint8_t plain_frame_decode(uint8_t *payload, const uint8_t *frame, uint8_t length);

#endif
