/* protocol.h: any bytes from a motion-capture system, to the protocol PROTOCOL: nothing is read or
 * written out of bounds, and a frame keeps capture.h's promises. A target defines PROTOCOL and
 * includes this. The first byte says how the rest is cut into pieces. */
#include "capture.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void look_at_body(const struct capture_body *body)
{
    double square = 0;

    assert(memchr(body->name, '\0', sizeof body->name) != NULL);
    if (!body->tracked)
        return;
    for (int i = 0; i < 3; i++)
        assert(isfinite(body->at[i]));
    for (int i = 0; i < 4; i++)
        square += body->turn[i] * body->turn[i];
    assert(fabs(square - 1) < 1e-5);
}

static void look_at(enum capture_news news, const struct capture_frame *frame, const char *words)
{
    if (news == CAPTURE_FRAME) {
        assert(frame->count <= CAPTURE_BODIES_MAX);
        for (size_t i = 0; i < frame->count; i++)
            look_at_body(&frame->body[i]);
    } else if (news != CAPTURE_NOTHING) {
        assert(words[0] != '\0' && memchr(words, '\0', CAPTURE_WORDS_MAX) != NULL);
    }
}

static void ask(void *session, int64_t *now_us)
{
    uint8_t bytes[CAPTURE_ASK_MAX];

    *now_us += 100000;
    if (PROTOCOL.ask == NULL)
        return;
    for (int i = 0; i < 10; i++)
        if (PROTOCOL.ask(session, *now_us, bytes, sizeof bytes) == 0)
            return;
    assert(!"it never has done with asking");
}

/* Gives the bytes once; true when there may be more news in them. */
static bool give(void *session, const uint8_t *data, size_t count, size_t *used)
{
    static struct capture_frame frame;
    char words[CAPTURE_WORDS_MAX];
    uint8_t *bytes = malloc(count > 0 ? count : 1);

    if (count > 0)
        memcpy(bytes, data, count);
    memset(words, 'x', sizeof words);
    enum capture_news news = PROTOCOL.take(session, bytes, count, used, &frame, words);
    look_at(news, &frame, words);
    assert(*used <= count);
    free(bytes);
    return *used > 0 && news != CAPTURE_BROKEN && news != CAPTURE_REFUSED;
}

/* As source.c does: a stream's rest waits for more, a datagram is gone. */
static void play(void *session, const uint8_t *data, size_t size, size_t piece)
{
    size_t done = 0, there = 0, used;
    int64_t now_us = 0;

    while (there < size) {
        there = size - there < piece ? size : there + piece;
        ask(session, &now_us);
        while (give(session, data + done, there - done, &used) && PROTOCOL.stream) {
            done += used;
            ask(session, &now_us);
        }
        if (!PROTOCOL.stream)
            done = there;
    }
    give(session, data, 0, &used);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct capture_options options = {0};

    if (size == 0)
        return 0;
    void *session = malloc(PROTOCOL.session_bytes);
    size_t piece = data[0] % 64 == 0 ? size : (size_t)(data[0] % 64) * 8;
    options.data_port = data[0] & 0x40;
    options.version[0] = data[0] & 0x80 ? 3 : 0;
    PROTOCOL.begin(session, &options);
    play(session, data + 1, size - 1, piece);
    free(session);
    return 0;
}
