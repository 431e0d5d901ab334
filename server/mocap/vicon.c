/* Vicon's UDP object stream, as Tracker and Nexus send it to port 51001, little-endian.
 *
 * A datagram is a frame number, a count, and as many objects; the rest of it, filled up to 256, 512
 * or 1024 bytes, means nothing. Where a moment's objects do not fit into one datagram there are
 * several with the same number, and each is a frame here: no body waits for another one.
 *
 * Angles are in rad about the object's own axes, first x, then y, then z, as other readers of the
 * stream have it from Vicon's help ("Access Vicon Tracker data from Simulink"); for a robot on a
 * floor, which turns about z alone, any order is the same. Objects that are not seen are left out;
 * six noughts, where nothing ever is exactly, are taken for one as well. */
#include "capture.h"
#include "cursor.h"
#include "rotation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define UNIT 0.001
#define OBJECT 0
#define OBJECT_SIZE 72
#define NAME_SIZE 24

/* Nothing has to be remembered; a session still has an address. */
struct session {
    char nothing;
};

static void begin(void *memory, const struct capture_options *options)
{
    (void)memory;
    (void)options;
}

static void read_object(struct cursor *cursor, struct capture_body *body)
{
    double value[6];
    bool seen = false;

    cursor_text(cursor, NAME_SIZE, body->name, sizeof body->name);
    for (int i = 0; i < 6; i++) {
        value[i] = cursor_f64_le(cursor);
        seen |= value[i] != 0;
    }
    body->id = CAPTURE_ID_NONE;
    for (int i = 0; i < 3; i++)
        body->at[i] = UNIT * value[i];
    body->tracked = rotation_of_angles(value + 3, body->turn) && seen &&
                    isfinite(value[0] + value[1] + value[2]);
}

/* Without an object nothing else tells a datagram of Vicon's from any other one. */
static bool is_empty(struct cursor *rest)
{
    while (rest->left > 0)
        if (cursor_u8(rest) != 0)
            return false;
    return true;
}

static enum capture_news take(void *memory, const uint8_t *bytes, size_t count, size_t *used,
                              struct capture_frame *frame, char words[CAPTURE_WORDS_MAX])
{
    struct cursor cursor = cursor_over(bytes, count);

    (void)memory;
    *used = count;
    frame->numbered = true;
    frame->number = cursor_u32_le(&cursor);
    frame->time = NAN;
    frame->latency = 0;
    frame->count = 0;
    for (uint8_t left = cursor_u8(&cursor); left > 0 && cursor_good(&cursor); left--) {
        uint8_t kind = cursor_u8(&cursor);
        uint16_t size = cursor_u16_le(&cursor);
        struct cursor item = cursor_part(&cursor, size);

        if (kind != OBJECT)
            continue;
        if (size < OBJECT_SIZE)
            cursor_fail(&cursor);
        else
            read_object(&item, &frame->body[frame->count++]);
    }
    if (!cursor_good(&cursor) || (frame->count == 0 && !is_empty(&cursor))) {
        snprintf(words, CAPTURE_WORDS_MAX, "%zu bytes that are no Vicon objects", count);
        return CAPTURE_BROKEN;
    }
    return CAPTURE_FRAME;
}

const struct capture_protocol vicon_protocol = {
    .name = "vicon",
    .stream = false,
    .port = 51001,
    .unit = UNIT,
    .session_bytes = sizeof(struct session),
    .begin = begin,
    .take = take,
    .ask = NULL,
};
