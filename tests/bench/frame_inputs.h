/* frame_inputs.h: the payloads that the codec is measured with, the same on both sides. */
#ifndef FRAME_INPUTS_H
#define FRAME_INPUTS_H

#include "random.h"

#define FRAME_INPUTS 2000
#define FRAME_PAYLOAD 20
#define FRAME_CODED (FRAME_PAYLOAD + 4) /* with CRC, COBS and the zero */
#define FRAME_SEED 3

/* No zeros, zeros only, a zero every so often, random bytes, random bytes among zeros. */
static inline void frame_payload(uint8_t *payload, uint16_t index, uint32_t *state)
{
    for (uint8_t i = 0; i < FRAME_PAYLOAD; i++) {
        uint32_t drawn = random_next(state);

        payload[i] = (uint8_t)(drawn >> 8);
        switch (index % 5) {
        case 0: payload[i] |= 1; break;
        case 1: payload[i] = 0; break;
        case 2:
            payload[i] |= 1;
            if ((i + index) % (2 + index % 7) == 0)
                payload[i] = 0;
            break;
        case 3: break;
        default:
            if (drawn & 1)
                payload[i] = 0;
        }
    }
}

#endif
