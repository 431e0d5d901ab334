/* frame.c: frames of 20 bytes, the length of a small packet of a robot. */
#include "frame.h"

#include "benchmarks.h"
#include "frame_inputs.h"
#include "marks.h"
#include "results.h"

#include <err.h>
#include <stdlib.h>
#include <string.h>

struct round_trip {
    uint32_t encode, decode; /* cycles */
};

/* Of one codec; what it makes of the payload has to be right. */
static struct round_trip measure_round_trip(struct marks *marks, const uint8_t *payload,
                                            const char *codec)
{
    struct round_trip cycles;
    uint8_t exact[FRAME_BYTES_MAX], frame[FRAME_CODED], back[FRAME_PAYLOAD + 1];

    cycles.encode = marks_measure(marks, frame, sizeof frame);
    if (frame_encode(exact, payload, FRAME_PAYLOAD) != sizeof frame ||
        memcmp(exact, frame, sizeof frame) != 0)
        errx(EXIT_FAILURE, "%s encodes a payload otherwise than the host", codec);
    cycles.decode = marks_measure(marks, back, sizeof back);
    if (back[FRAME_PAYLOAD] != FRAME_PAYLOAD || memcmp(payload, back, FRAME_PAYLOAD) != 0)
        errx(EXIT_FAILURE, "%s does not give back the payload", codec);
    return cycles;
}

void measure_frame(void)
{
    static struct marks marks;
    uint32_t state = FRAME_SEED;

    marks_open(&marks, "frame");
    for (uint16_t i = 0; i < FRAME_INPUTS; i++) {
        uint8_t payload[FRAME_PAYLOAD];

        frame_payload(payload, i, &state);
        struct round_trip cycles = measure_round_trip(&marks, payload, "the codec");
        figure_worst("frame_encode_20_cycles_max", cycles.encode);
        figure_worst("frame_decode_20_cycles_max", cycles.decode);
        cycles = measure_round_trip(&marks, payload, "the plain codec");
        figure_worst_baseline("frame_encode_20_cycles_max", "plain", cycles.encode);
        figure_worst_baseline("frame_decode_20_cycles_max", "plain", cycles.decode);
    }
    marks_close(&marks);
}
