/* Any bytes on a link, and any payload: nothing is read or written out of bounds, what a frame
 * carries comes out of it, and a message that is understood is understood again when repeated. */
#include "frame.h"
#include "message.h"

#include <assert.h>
#include <stddef.h>
#include <string.h>

static void repeat(const uint8_t *payload, uint8_t length)
{
    uint8_t first[FRAME_PAYLOAD_MAX], second[FRAME_PAYLOAD_MAX];
    struct message message;

    memset(&message, 0, sizeof message);
    if (!message_read(&message, payload, length))
        return;
    uint8_t count = message_write(first, &message);
    assert(count > 0 && count <= FRAME_PAYLOAD_MAX);

    memset(&message, 0, sizeof message);
    bool understood = message_read(&message, first, count);
    assert(understood);
    assert(message_write(second, &message) == count);
    assert(memcmp(first, second, count) == 0);
}

static void receive(const uint8_t *bytes, size_t size)
{
    struct frame_decoder decoder;

    frame_decoder_init(&decoder);
    for (size_t i = 0; i < size; i++) {
        if (frame_decode(&decoder, bytes[i]) == FRAME_READY)
            repeat(decoder.payload, decoder.length);
    }
}

static void send_and_receive(const uint8_t *payload, uint8_t length)
{
    uint8_t frame[FRAME_BYTES_MAX];
    struct frame_decoder decoder;
    enum frame_event event = FRAME_PENDING;
    uint8_t count = frame_encode(frame, payload, length);

    assert((count == 0) == (length == 0 || length > FRAME_PAYLOAD_MAX));
    if (count == 0)
        return;
    frame_decoder_init(&decoder);
    for (uint8_t i = 0; i < count; i++) {
        assert(event == FRAME_PENDING);
        assert((frame[i] == 0) == (i == count - 1));
        event = frame_decode(&decoder, frame[i]);
    }
    assert(event == FRAME_READY && decoder.length == length);
    assert(memcmp(decoder.payload, payload, length) == 0);
    repeat(payload, length);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    receive(data, size);
    send_and_receive(data, size < UINT8_MAX ? (uint8_t)size : UINT8_MAX);
    return 0;
}
