/* capture.h: what a motion-capture system says, and how its protocol is read.
 *
 * A protocol is pure: bytes and time in, frames and bytes out; sockets are source.h's. Every count
 * and length in what is read is checked against what is there, and what does not add up is refused
 * whole: never a wrong pose. */
#ifndef CAPTURE_H
#define CAPTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define CAPTURE_BODIES_MAX 512
#define CAPTURE_NAME_MAX 64 /* with its NUL; longer names are cut */
#define CAPTURE_ID_NONE INT32_MIN

/* A rigid body. */
struct capture_body {
    char name[CAPTURE_NAME_MAX]; /* "" when the system has none or has not told it yet */
    int32_t id;                  /* the system's number for it, or CAPTURE_ID_NONE */
    bool tracked;                /* false: at and turn mean nothing */
    double at[3];                /* m, in the system's axes */
    double turn[4];              /* unit quaternion x, y, z, w in the system's axes */
};

/* One moment: every body the system spoke of in one packet. */
struct capture_frame {
    bool numbered;
    uint32_t number; /* counts up; a smaller one means that the system was started anew */
    double time;     /* s by the system's own clock; NAN: it tells none. Never compared with ours */
    double latency;  /* s from exposure to sending where the system tells it, else 0 */
    size_t count;
    struct capture_body body[CAPTURE_BODIES_MAX];
};

enum capture_news {
    CAPTURE_NOTHING, /* of no concern, or the rest of a message is still to come */
    CAPTURE_FRAME,   /* the frame is filled in */
    CAPTURE_TOLD,    /* the words tell something new of the system: its name and version, say */
    CAPTURE_BROKEN,  /* malformed, the words say how; a stream is to be opened anew */
    CAPTURE_REFUSED, /* never will work, the words say why: a version that is not known, say */
};

#define CAPTURE_WORDS_MAX 256

/* What a session starts from. All have defaults that a zeroed struct stands for. */
struct capture_options {
    uint8_t version[2]; /* natnet: of a system that is listened to and cannot be asked; else 0 */
    bool unicast;       /* natnet: ask for frames to be sent here, and keep asking */
    uint16_t data_port; /* natnet: of the frames, 0: as the system says or the usual one;
                           qtm: of ours to stream frames to by UDP, 0: in the connection */
};

struct capture_protocol {
    const char *name; /* in site files */
    bool stream;      /* TCP; else each take() gets one datagram */
    uint16_t port;    /* usual port: of the system where it is asked, else ours to listen on */
    double unit;      /* m in what position is told in, already applied: for the documentation */
    size_t session_bytes; /* of memory for a session, aligned as malloc aligns */

    /* A connection is new: forgets everything. */
    void (*begin)(void *session, const struct capture_options *options);

    /* Takes bytes that have come; `used` of them are done with (of a datagram: all). For streams to
     * be called until it uses none; what is not used is brought again with more behind it. */
    enum capture_news (*take)(void *session, const uint8_t *bytes, size_t count, size_t *used,
                              struct capture_frame *frame, char words[CAPTURE_WORDS_MAX]);

    /* What to send to the system at `now_us` (any monotonic clock): bytes, 0 when there is nothing
     * to say. To be called until 0 when the connection is new, after every take, and ten times a
     * second. NULL: the system is never spoken to. */
    size_t (*ask)(void *session, int64_t now_us, uint8_t *bytes, size_t room);
};

/* The most that ask() writes at once, and the most of a stream that may wait for its rest. */
#define CAPTURE_ASK_MAX 512
#define CAPTURE_MESSAGE_MAX 65536

extern const struct capture_protocol natnet_protocol; /* natnet.h */
extern const struct capture_protocol vrpn_protocol;   /* vrpn.h */
extern const struct capture_protocol vicon_protocol;  /* vicon.h */
extern const struct capture_protocol qtm_protocol;    /* qtm.h */
extern const struct capture_protocol dtrack_protocol; /* dtrack.h */
extern const struct capture_protocol poses_protocol;  /* poses.h: a recorded file */

#endif
