/* The codec and its plain baseline, to the frame of a payload and back. */
#include "frame.h"

#include "frame_inputs.h"
#include "mark.h"
#include "plain_frame.h"

static uint8_t payload[FRAME_PAYLOAD_MAX];
static uint8_t frame[FRAME_BYTES_MAX];
static uint8_t length; /* of what came out */
static struct frame_decoder decoder;
static enum frame_event event;

static void encode(void)
{
    length = frame_encode(frame, payload, FRAME_PAYLOAD);
}

static void decode(void)
{
    const uint8_t *next = frame;

    event = frame_scan(&decoder, &next, frame + length);
}

static void encode_plainly(void)
{
    length = plain_frame_encode(frame, payload, FRAME_PAYLOAD);
}

static void decode_plainly(void)
{
    length = plain_frame_decode(payload, frame, length);
}

static void measure_codec(void)
{
    measure(encode);
    tell(frame, FRAME_CODED);
    measure(decode);
    tell(decoder.payload, FRAME_PAYLOAD);
    mark(event == FRAME_READY ? decoder.length : 0);
}

static void measure_plain_codec(void)
{
    measure(encode_plainly);
    tell(frame, FRAME_CODED);
    measure(decode_plainly);
    tell(payload, FRAME_PAYLOAD);
    mark(length);
}

int main(void)
{
    uint32_t state = FRAME_SEED;

    calibrate();
    frame_decoder_init(&decoder);
    for (uint16_t i = 0; i < FRAME_INPUTS; i++) {
        frame_payload(payload, i, &state);
        measure_codec();
        measure_plain_codec();
    }
    mark(MARK_DONE);
    for (;;)
        ;
}
