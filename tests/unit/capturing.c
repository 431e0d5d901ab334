#include "capturing.h"

#include <stdlib.h>
#include <string.h>
#include <unity.h>

void capturing_begin(struct capturing *capturing, const struct capture_protocol *protocol,
                     const struct capture_options *options)
{
    static const struct capture_options defaults;

    capturing->protocol = protocol;
    capturing->session = malloc(protocol->session_bytes);
    TEST_ASSERT_NOT_NULL(capturing->session);
    protocol->begin(capturing->session, options != NULL ? options : &defaults);
}

void capturing_end(struct capturing *capturing)
{
    free(capturing->session);
}

enum capture_news capturing_take(struct capturing *capturing, const void *bytes, size_t count)
{
    uint8_t *copy = malloc(count > 0 ? count : 1);

    TEST_ASSERT_NOT_NULL(copy);
    if (count > 0)
        memcpy(copy, bytes, count);
    capturing->words[0] = '\0';
    enum capture_news news = capturing->protocol->take(
        capturing->session, copy, count, &capturing->used, &capturing->frame, capturing->words);
    free(copy);
    TEST_ASSERT_TRUE(capturing->used <= count);
    return news;
}

enum capture_news capturing_take_packet(struct capturing *capturing, struct packet *packet)
{
    enum capture_news news = capturing_take(capturing, packet->bytes, packet->count);

    packet->count -= capturing->used;
    memmove(packet->bytes, packet->bytes + capturing->used, packet->count);
    return news;
}

void capturing_assert_cuts(struct capturing *capturing, const struct packet *packet)
{
    bool stream = capturing->protocol->stream;

    for (size_t count = 0; count < packet->count; count++)
        TEST_ASSERT_EQUAL_INT(stream ? CAPTURE_NOTHING : CAPTURE_BROKEN,
                              capturing_take(capturing, packet->bytes, count));
}
