/* Qualisys' QTM, its RT protocol over TCP, port 22223, little-endian (RTProtocol.cpp and
 * RTPacket.cpp of github.com/qualisys/qualisys_cpp_sdk).
 *
 * QTM greets; then it is asked for a version, the newest known one first; for the bodies' names,
 * which come in the order of the bodies in every frame; and for frames, in this connection or by
 * UDP. When QTM tells of an event after which the bodies may be others, names are asked for again,
 * and until they are there frames are empty: nobody's pose is taken for another's. Place in mm, the
 * matrix column by column, NaN for a body that is lost. */
#include "capture.h"
#include "cursor.h"
#include "qtm_names.h"
#include "rotation.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define UNIT 0.001
#define HEADER_SIZE 8
#define MESSAGE_LIMIT (64u << 20) /* a larger one is no message */
#define RETRY_US 1000000
#define SIX_D 5
#define SIX_D_SIZE 48
#define GREETING "QTM RT Interface connected"

enum kind { KIND_ERROR, KIND_COMMAND, KIND_XML, KIND_DATA, KIND_END, KIND_FILE, KIND_EVENT };

/* Bodies are told alike in all of them, since 1.8. */
static const char *const versions[] = {"1.28", "1.24", "1.21", "1.18", "1.14", "1.10", "1.8"};
#define VERSION_COUNT (sizeof versions / sizeof versions[0])

/* What is to be said next, or has been said and is to be answered. */
enum state { GREETED, VERSION, VERSION_ASKED, NAMES, NAMES_ASKED, FRAMES, STREAMING };

struct session {
    enum state state;
    size_t version;
    uint16_t data_port;
    bool again; /* the names that are being told are old already */
    bool pause; /* what failed is tried again, but not at once */
    bool heard; /* frames have come since ask() looked */
    int64_t due_us;
    bool named;
    uint32_t odd;  /* bodies in a frame, when that was complained of: not as many as names */
    bool reading;  /* what is left of the message is names */
    uint32_t left; /* of a message that is read piece by piece */
    struct qtm_names names;
};

static void begin(void *memory, const struct capture_options *options)
{
    struct session *session = memory;

    memset(session, 0, sizeof *session);
    session->data_port = options->data_port;
    session->due_us = INT64_MIN;
}

/* The words of an answer: text up to its NUL. */
static void text_of(const uint8_t *bytes, size_t count, char *text, size_t room)
{
    struct cursor cursor = cursor_over(bytes, count);

    cursor_text(&cursor, count, text, room);
    for (; *text != '\0'; text++)
        if ((unsigned char)*text < ' ')
            *text = ' ';
}

static enum capture_news next_version(struct session *session, const char *answer,
                                      char words[CAPTURE_WORDS_MAX])
{
    session->state = VERSION;
    if (++session->version < VERSION_COUNT)
        return CAPTURE_NOTHING;
    session->version = 0;
    snprintf(words, CAPTURE_WORDS_MAX, "QTM speaks none of the versions %s to %s: %.150s",
             versions[VERSION_COUNT - 1], versions[0], answer);
    return CAPTURE_REFUSED;
}

static enum capture_news take_command(struct session *session, const uint8_t *bytes, size_t count,
                                      char words[CAPTURE_WORDS_MAX])
{
    char text[160], agreed[32];

    text_of(bytes, count, text, sizeof text);
    if (session->state == GREETED) {
        if (strncmp(text, GREETING, strlen(GREETING)) != 0) {
            snprintf(words, CAPTURE_WORDS_MAX, "what answers is no QTM: %s", text);
            return CAPTURE_REFUSED;
        }
        session->state = VERSION;
        return CAPTURE_NOTHING;
    }
    if (session->state != VERSION_ASKED)
        return CAPTURE_NOTHING;
    snprintf(agreed, sizeof agreed, "Version set to %s", versions[session->version]);
    if (strcmp(text, agreed) != 0)
        return next_version(session, text, words);
    session->state = NAMES;
    snprintf(words, CAPTURE_WORDS_MAX, "QTM %s", versions[session->version]);
    return CAPTURE_TOLD;
}

static enum capture_news take_error(struct session *session, const uint8_t *bytes, size_t count,
                                    char words[CAPTURE_WORDS_MAX])
{
    static const char *const asked[] = {
        [NAMES_ASKED] = "its bodies' names",
        [STREAMING] = "frames",
    };
    char text[160];

    text_of(bytes, count, text, sizeof text);
    if (session->state == GREETED) {
        snprintf(words, CAPTURE_WORDS_MAX, "QTM refuses the connection: %s", text);
        return CAPTURE_BROKEN;
    }
    if (session->state == VERSION_ASKED)
        return next_version(session, text, words);
    if (session->state != NAMES_ASKED && session->state != STREAMING)
        return CAPTURE_NOTHING;
    snprintf(words, CAPTURE_WORDS_MAX, "QTM, asked for %s, answers: %s", asked[session->state],
             text);
    session->state--; /* to be asked again */
    session->pause = true;
    return CAPTURE_TOLD;
}

/* The bodies may be others from now on. */
static void doubt_names(struct session *session)
{
    session->named = false;
    if (session->state == NAMES_ASKED)
        session->again = true;
    else if (session->state > NAMES_ASKED)
        session->state = NAMES;
}

static enum capture_news take_event(struct session *session, const uint8_t *bytes, size_t count,
                                    char words[CAPTURE_WORDS_MAX])
{
    static const struct {
        uint8_t number;
        const char *words;
    } events[] = {
        {1, "QTM is connected to its cameras"},
        {2, "QTM has left its cameras"},
        {3, "QTM records"},
        {8, "QTM plays a file"},
        {9, "QTM's file is at its end"},
        {11, "QTM's settings have changed"},
        {12, "QTM shuts down"},
    };

    for (size_t i = 0; count > 0 && i < sizeof events / sizeof events[0]; i++) {
        if (bytes[0] != events[i].number)
            continue;
        doubt_names(session);
        snprintf(words, CAPTURE_WORDS_MAX, "%s", events[i].words);
        return CAPTURE_TOLD;
    }
    return CAPTURE_NOTHING;
}

static bool read_body(struct cursor *cursor, struct capture_body *body)
{
    double value[12];

    for (int i = 0; i < 12; i++)
        value[i] = (double)cursor_f32_le(cursor);
    for (int i = 0; i < 3; i++)
        body->at[i] = UNIT * value[i];
    body->tracked = rotation_of_columns(value + 3, body->turn) &&
                    isfinite(body->at[0] + body->at[1] + body->at[2]);
    return cursor_good(cursor);
}

/* The number of bodies. Without names for as many, none of them is taken. */
static uint32_t read_bodies(const struct session *session, struct cursor *component,
                            struct capture_frame *frame)
{
    uint32_t count = cursor_u32_le(component);

    cursor_skip(component, 4); /* how many frames of the cameras were dropped */
    if (count > CAPTURE_BODIES_MAX || !cursor_holds(component, count, SIX_D_SIZE)) {
        cursor_fail(component);
        return 0;
    }
    if (!session->named || session->names.count != count)
        return count;
    frame->count = count;
    for (uint32_t i = 0; i < count; i++) {
        struct capture_body *body = &frame->body[i];

        body->id = CAPTURE_ID_NONE;
        memcpy(body->name, session->names.name[i], sizeof body->name);
        read_body(component, body);
    }
    return count;
}

/* The frame is news, unless there is something to complain of, once: its number of bodies. */
static enum capture_news judge_count(struct session *session, uint32_t count,
                                     char words[CAPTURE_WORDS_MAX])
{
    if (!session->named || count == session->names.count)
        return CAPTURE_FRAME;
    doubt_names(session);
    session->pause = true;
    if (count == session->odd)
        return CAPTURE_FRAME;
    session->odd = count;
    snprintf(words, CAPTURE_WORDS_MAX,
             "QTM's frames have %" PRIu32 " bodies and its settings %zu names: which is whose?",
             count, session->names.count);
    return CAPTURE_TOLD;
}

static enum capture_news take_data(struct session *session, const uint8_t *bytes, size_t count,
                                   struct capture_frame *frame, char words[CAPTURE_WORDS_MAX])
{
    struct cursor cursor = cursor_over(bytes, count);
    bool told = false;
    uint32_t bodies = 0;

    frame->numbered = true;
    frame->time = (double)cursor_u64_le(&cursor) / 1e6;
    frame->number = cursor_u32_le(&cursor);
    frame->latency = 0;
    frame->count = 0;
    for (uint32_t left = cursor_u32_le(&cursor); left > 0 && cursor_good(&cursor); left--) {
        uint32_t size = cursor_u32_le(&cursor);
        uint32_t kind = cursor_u32_le(&cursor);
        struct cursor component = cursor_part(&cursor, size - HEADER_SIZE);

        if (kind != SIX_D || told)
            continue;
        told = true;
        bodies = read_bodies(session, &component, frame);
        if (!cursor_good(&component))
            cursor_fail(&cursor);
    }
    if (!cursor_good(&cursor)) {
        snprintf(words, CAPTURE_WORDS_MAX, "a malformed frame from QTM");
        return CAPTURE_BROKEN;
    }
    session->heard = true;
    return told ? judge_count(session, bodies, words) : CAPTURE_NOTHING;
}

static enum capture_news take_names(struct session *session, char words[CAPTURE_WORDS_MAX])
{
    bool again = session->again;

    session->reading = false;
    session->again = false;
    if (!qtm_names_done(&session->names)) {
        snprintf(words, CAPTURE_WORDS_MAX, "malformed XML from QTM");
        return CAPTURE_BROKEN;
    }
    session->named = !again;
    session->state = again ? NAMES : FRAMES;
    snprintf(words, CAPTURE_WORDS_MAX, "QTM %s with %zu bodies", versions[session->version],
             session->names.count);
    return CAPTURE_TOLD;
}

/* Goes on with a message of any length. */
static enum capture_news take_piece(struct session *session, const uint8_t *bytes, size_t count,
                                    size_t *used, char words[CAPTURE_WORDS_MAX])
{
    *used = count < session->left ? count : session->left;
    session->left -= (uint32_t)*used;
    if (!session->reading)
        return CAPTURE_NOTHING;
    qtm_names_take(&session->names, bytes, *used);
    return session->left > 0 ? CAPTURE_NOTHING : take_names(session, words);
}

static enum capture_news take_message(struct session *session, uint32_t kind, const uint8_t *bytes,
                                      size_t count, struct capture_frame *frame,
                                      char words[CAPTURE_WORDS_MAX])
{
    switch (kind) {
    case KIND_ERROR: return take_error(session, bytes, count, words);
    case KIND_COMMAND: return take_command(session, bytes, count, words);
    case KIND_DATA: return take_data(session, bytes, count, frame, words);
    case KIND_EVENT: return take_event(session, bytes, count, words);
    default: return CAPTURE_NOTHING;
    }
}

static enum capture_news begin_pieces(struct session *session, uint32_t kind, uint32_t size,
                                      char words[CAPTURE_WORDS_MAX])
{
    session->left = size - HEADER_SIZE;
    session->reading = kind == KIND_XML && session->state == NAMES_ASKED;
    if (!session->reading)
        return CAPTURE_NOTHING;
    session->named = false;
    qtm_names_begin(&session->names);
    return session->left > 0 ? CAPTURE_NOTHING : take_names(session, words);
}

static enum capture_news take(void *memory, const uint8_t *bytes, size_t count, size_t *used,
                              struct capture_frame *frame, char words[CAPTURE_WORDS_MAX])
{
    struct session *session = memory;
    struct cursor cursor = cursor_over(bytes, count);
    uint32_t size = cursor_u32_le(&cursor);
    uint32_t kind = cursor_u32_le(&cursor);
    bool pieces = kind == KIND_XML || kind == KIND_FILE || kind > KIND_EVENT;

    /* A frame that came by UDP may come amid a message, which, as text, cannot look like it. */
    bool datagram = session->data_port != 0 && kind == KIND_DATA && size == count;
    *used = 0;
    if (session->left > 0 && !datagram)
        return take_piece(session, bytes, count, used, words);
    if (!cursor_good(&cursor))
        return CAPTURE_NOTHING;
    if (size < HEADER_SIZE || size > MESSAGE_LIMIT || (!pieces && size > CAPTURE_MESSAGE_MAX)) {
        snprintf(words, CAPTURE_WORDS_MAX, "a message of %" PRIu32 " bytes, which is none of QTM's",
                 size);
        return CAPTURE_BROKEN;
    }
    if (pieces) {
        *used = HEADER_SIZE;
        return begin_pieces(session, kind, size, words);
    }
    if (size > count)
        return CAPTURE_NOTHING;
    *used = size;
    return take_message(session, kind, bytes + HEADER_SIZE, size - HEADER_SIZE, frame, words);
}

/* The command for the state, which is then to be answered. */
static int command_for(struct session *session, char *text, size_t room)
{
    int length;

    if (session->state == VERSION) {
        length = snprintf(text, room, "Version %s", versions[session->version]);
    } else if (session->state == NAMES) {
        length = snprintf(text, room, "GetParameters 6d");
    } else if (session->data_port != 0) {
        length = snprintf(text, room, "StreamFrames AllFrames UDP:%u 6d", session->data_port);
    } else {
        length = snprintf(text, room, "StreamFrames AllFrames 6d");
    }
    session->state++;
    return length;
}

/* Frames that have stopped are asked for again. */
static void watch_frames(struct session *session, int64_t now_us)
{
    if (session->state != STREAMING)
        return;
    if (session->heard)
        session->due_us = now_us + RETRY_US;
    else if (now_us >= session->due_us)
        session->state = FRAMES;
    session->heard = false;
}

static size_t ask(void *memory, int64_t now_us, uint8_t *bytes, size_t room)
{
    struct session *session = memory;
    char command[64];

    watch_frames(session, now_us);
    if (session->pause)
        session->due_us = now_us + RETRY_US;
    session->pause = false;
    bool waiting = session->state != VERSION && session->state != NAMES && session->state != FRAMES;
    if (waiting || now_us < session->due_us || room < sizeof command + HEADER_SIZE)
        return 0;

    bool frames = session->state == FRAMES;
    uint32_t length = (uint32_t)command_for(session, command, sizeof command);
    uint32_t header[2] = {HEADER_SIZE + length + 1, KIND_COMMAND};
    for (size_t i = 0; i < HEADER_SIZE; i++)
        bytes[i] = (uint8_t)(header[i / 4] >> 8 * (i % 4));
    memcpy(bytes + HEADER_SIZE, command, length + 1);
    session->due_us = frames ? now_us + RETRY_US : INT64_MIN;
    return header[0];
}

const struct capture_protocol qtm_protocol = {
    .name = "qtm",
    .stream = true,
    .port = 22223,
    .unit = UNIT,
    .session_bytes = sizeof(struct session),
    .begin = begin,
    .take = take,
    .ask = ask,
};
