/* capturing.h: a session of a motion-capture protocol, and what it made of the newest bytes. */
#ifndef CAPTURING_H
#define CAPTURING_H

#include "capture.h"
#include "packet.h"

struct capturing {
    const struct capture_protocol *protocol;
    void *session;
    size_t used;
    struct capture_frame frame;
    char words[CAPTURE_WORDS_MAX];
};

void capturing_begin(struct capturing *capturing, const struct capture_protocol *protocol,
                     const struct capture_options *options);
void capturing_end(struct capturing *capturing);

/* Bytes at a place where whatever lies beyond their end is noticed by AddressSanitizer. */
enum capture_news capturing_take(struct capturing *capturing, const void *bytes, size_t count);

/* As capturing_take(); the packet's used bytes are gone from it. */
enum capture_news capturing_take_packet(struct capturing *capturing, struct packet *packet);

/* Cut off at each of its bytes, the packet makes no frame; a datagram is broken then. */
void capturing_assert_cuts(struct capturing *capturing, const struct packet *packet);

#define ASSERT_BODY(name_, id_, tracked_, body)                                                    \
    do {                                                                                           \
        TEST_ASSERT_EQUAL_STRING(name_, (body).name);                                              \
        TEST_ASSERT_EQUAL_INT32(id_, (body).id);                                                   \
        TEST_ASSERT_EQUAL_INT(tracked_, (body).tracked);                                           \
    } while (0)

#define ASSERT_AT(x, y, z, body)                                                                   \
    do {                                                                                           \
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, x, (body).at[0]);                                          \
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, y, (body).at[1]);                                          \
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, z, (body).at[2]);                                          \
    } while (0)

#define ASSERT_TURN(x, y, z, w, body)                                                              \
    do {                                                                                           \
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, x, (body).turn[0]);                                        \
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, y, (body).turn[1]);                                        \
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, z, (body).turn[2]);                                        \
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, w, (body).turn[3]);                                        \
    } while (0)

#endif
