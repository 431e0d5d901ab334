/* VRPN, version 07, over one TCP connection; vrpn_Connection.C and vrpn_Tracker.C of
 * github.com/vrpn/vrpn have the layout.
 *
 * A body's name is its tracker's, its id the sensor: a tracker with several sensors is several
 * bodies. The client says its cookie and nothing else; as it names no UDP port, the server
 * describes its trackers and sends their Pos_Quat by TCP, without being asked.
 *
 * A frame holds what came together with one time: consecutive messages with the same stamp. Another
 * stamp, or a body that the frame has already, begins the next frame. Nothing waits for a frame to
 * be full: what is there is told at once, with the time at which it was measured. A body that is
 * lost is not spoken of. */
#include "capture.h"
#include "cursor.h"
#include "rotation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define COOKIE "vrpn: ver. 07.35  0" /* the last digit: nothing is to be logged */
#define COOKIE_SIZE 24
#define COOKIE_ALIKE 14 /* bytes that have to be the same: any 07 will do */
#define HEADER_SIZE 24
#define MESSAGE_MAX 64000 /* the library's own buffer is no larger */
#define SENDERS_MAX 2000  /* nor has it more senders or types */

enum { SENDER_DESCRIPTION = -1, TYPE_DESCRIPTION = -2 };

struct session {
    bool asked;
    bool met;
    bool typed;
    int32_t pos_quat;                           /* that type's number, when `typed` */
    char sender[SENDERS_MAX][CAPTURE_NAME_MAX]; /* "": not described yet */
    int32_t from[CAPTURE_BODIES_MAX];           /* senders of the bodies in the frame */
};

struct message {
    uint32_t seconds, microseconds;
    int32_t sender, type;
    struct cursor body;
};

static void begin(void *memory, const struct capture_options *options)
{
    struct session *session = memory;

    (void)options;
    memset(session, 0, sizeof *session);
}

static enum capture_news meet(struct session *session, const uint8_t *bytes,
                              char words[CAPTURE_WORDS_MAX])
{
    if (memcmp(bytes, COOKIE, COOKIE_ALIKE) != 0) {
        snprintf(words, CAPTURE_WORDS_MAX,
                 memcmp(bytes, COOKIE, COOKIE_ALIKE - 3) == 0
                     ? "the server speaks another version of VRPN than 07"
                     : "what answers is no VRPN server");
        return CAPTURE_REFUSED;
    }
    session->met = true;
    snprintf(words, CAPTURE_WORDS_MAX, "VRPN 07.%.2s", bytes + COOKIE_ALIKE);
    return CAPTURE_TOLD;
}

/* Bytes of the message at the cursor with its padding, SIZE_MAX for none that can be, 0 when its
 * rest is still to come. */
static size_t next(const uint8_t *bytes, size_t count, struct message *message)
{
    struct cursor cursor = cursor_over(bytes, count);
    uint32_t length = cursor_u32_be(&cursor);

    if (!cursor_good(&cursor))
        return 0;
    if (length < HEADER_SIZE || length > MESSAGE_MAX)
        return SIZE_MAX;
    message->seconds = cursor_u32_be(&cursor);
    message->microseconds = cursor_u32_be(&cursor);
    message->sender = cursor_i32_be(&cursor);
    message->type = cursor_i32_be(&cursor);
    cursor_skip(&cursor, 4); /* the sequence number */
    message->body = cursor_part(&cursor, length - HEADER_SIZE);
    cursor_skip(&cursor, -length % 8);
    return cursor_good(&cursor) ? count - cursor.left : 0;
}

/* A number's name: of a tracker, or of the only type that matters. */
static bool describe(struct session *session, struct message *message)
{
    char name[CAPTURE_NAME_MAX];

    cursor_skip(&message->body, 4); /* the length of the name, which ends with a NUL anyway */
    cursor_string_cut(&message->body, name, sizeof name);
    if (!cursor_good(&message->body) || message->sender < 0 || message->sender >= SENDERS_MAX)
        return false;
    if (message->type == SENDER_DESCRIPTION) {
        memcpy(session->sender[message->sender], name, sizeof name);
    } else if (strcmp(name, "vrpn_Tracker Pos_Quat") == 0) {
        session->pos_quat = message->sender;
        session->typed = true;
    }
    return true;
}

static bool is_pose(const struct session *session, const struct message *message)
{
    return session->typed && message->type == session->pos_quat && message->sender >= 0 &&
           message->sender < SENDERS_MAX && session->sender[message->sender][0] != '\0';
}

static double time_of(const struct message *message)
{
    return message->seconds + message->microseconds / 1e6;
}

static bool fits(const struct session *session, const struct capture_frame *frame,
                 const struct message *message)
{
    struct cursor body = message->body;
    int32_t sensor = cursor_i32_be(&body);

    if (frame->count == 0)
        return true;
    if (frame->count == CAPTURE_BODIES_MAX || frame->time != time_of(message))
        return false;
    for (size_t i = 0; i < frame->count; i++)
        if (session->from[i] == message->sender && frame->body[i].id == sensor)
            return false;
    return true;
}

static bool add(struct session *session, struct capture_frame *frame, struct message *message)
{
    struct capture_body *body = &frame->body[frame->count];
    double quaternion[4];

    body->id = cursor_i32_be(&message->body);
    cursor_skip(&message->body, 4); /* padding */
    for (int i = 0; i < 3; i++)
        body->at[i] = cursor_f64_be(&message->body);
    for (int i = 0; i < 4; i++)
        quaternion[i] = cursor_f64_be(&message->body);
    if (!cursor_good(&message->body))
        return false;
    body->tracked = rotation_of_quaternion(quaternion, body->turn) &&
                    isfinite(body->at[0] + body->at[1] + body->at[2]);
    memcpy(body->name, session->sender[message->sender], sizeof body->name);
    session->from[frame->count++] = message->sender;
    frame->time = time_of(message);
    return true;
}

static enum capture_news take(void *memory, const uint8_t *bytes, size_t count, size_t *used,
                              struct capture_frame *frame, char words[CAPTURE_WORDS_MAX])
{
    struct session *session = memory;
    struct message message;
    size_t size;

    *used = 0;
    if (!session->met) {
        if (count < COOKIE_SIZE)
            return CAPTURE_NOTHING;
        *used = COOKIE_SIZE;
        return meet(session, bytes, words);
    }
    frame->numbered = false;
    frame->number = 0;
    frame->latency = 0;
    frame->count = 0;
    while ((size = next(bytes + *used, count - *used, &message)) != 0) {
        bool good = size != SIZE_MAX;
        if (good && message.type < 0 && message.type >= TYPE_DESCRIPTION) {
            good = describe(session, &message);
        } else if (good && is_pose(session, &message)) {
            if (!fits(session, frame, &message))
                break;
            good = add(session, frame, &message);
        }
        if (!good) {
            snprintf(words, CAPTURE_WORDS_MAX, "a malformed VRPN message");
            return CAPTURE_BROKEN;
        }
        *used += size;
    }
    return frame->count > 0 ? CAPTURE_FRAME : CAPTURE_NOTHING;
}

static size_t ask(void *memory, int64_t now_us, uint8_t *bytes, size_t room)
{
    static const char cookie[COOKIE_SIZE] = COOKIE;
    struct session *session = memory;

    (void)now_us;
    if (session->asked || room < sizeof cookie)
        return 0;
    session->asked = true;
    memcpy(bytes, cookie, sizeof cookie);
    return sizeof cookie;
}

const struct capture_protocol vrpn_protocol = {
    .name = "vrpn",
    .stream = true,
    .port = 3883,
    .unit = 1,
    .session_bytes = sizeof(struct session),
    .begin = begin,
    .take = take,
    .ask = ask,
};
