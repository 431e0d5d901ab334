/* source.h: the sockets of a motion-capture system.
 *
 * Opens what a protocol (capture.h) needs, speaks and listens, drains to the newest frame, opens
 * anew what breaks, and says in words how it stands. Never blocks; allocates only while opening. */
#ifndef SOURCE_H
#define SOURCE_H

#include "capture.h"
#include "loop.h"

struct source_settings {
    const struct capture_protocol *protocol;
    const char *server; /* host name or address of the system; NULL: only listen */
    uint16_t port;      /* 0: the protocol's */
    const char
        *interface;    /* address or name of ours to join the group on; NULL: the kernel's choice */
    const char *group; /* natnet: multicast group; NULL: what the system says, or its default */
    const char *file;  /* poses: the file; else NULL */
    bool repeat;       /* poses: begin again at the end */
    bool every;        /* every frame is told, in a recording; else those that are still news */
    struct capture_options options;
};

struct source_owner {
    void *context;

    /* The newest frame that has arrived, or every one, at `arrival_us` of loop_now()'s clock: the
     * kernel's time of arrival where it tells it. Gone after the call. */
    void (*frame)(void *context, const struct capture_frame *frame, int64_t arrival_us);

    /* For the log: connected, joined group G on interface I, first packet, lost, no frames
     * because... */
    void (*say)(void *context, bool problem, const char *words);
};

struct source;

/* NULL and words in `error` when the settings make no sense or memory is short; a system that does
 * not answer is no error. Settings and owner must outlive the source. */
struct source *source_open(struct loop *loop, const struct source_settings *settings,
                           const struct source_owner *owner, char *error, size_t room);

/* At least ten times a second: asks, opens anew, and judges silence. */
void source_tick(struct source *source, int64_t now_us);

/* How it stands, for people: "natnet 3.0 from 10.0.0.5, 120 Hz" or what is amiss. */
const char *source_words(const struct source *source);

/* Frames since it was opened, and those skipped because a newer one was there. */
struct source_count {
    uint64_t frames, skipped, broken;
};
struct source_count source_counts(const struct source *source);

void source_close(struct source *source);

#endif
