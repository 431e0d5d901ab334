#include "natnet.h"

#include "capture.h"
#include "cursor.h"
#include "rotation.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define COMMAND_PORT 1510
#define HEADER_BYTES 4
#define SENDER_NAME 256
#define CONNECT_BYTES (HEADER_BYTES + SENDER_NAME + 4 + 4)

#define ASK_AGAIN_US 1000000
#define KEEPALIVE_US 1000000
#define LONG_AGO (INT64_MIN / 2)

/* A greater latency is that of a recording which is played again. */
#define LATENCY_MAX 1.0

enum message_id {
    CONNECT = 0,
    SERVERINFO = 1,
    REQUEST_MODELDEF = 4,
    MODELDEF = 5,
    FRAME = 7,
    KEEPALIVE = 10,
    LAST_ID = 14,
    UNRECOGNIZED = 100,
};

enum dataset { MARKER_SET, RIGID_BODY, SKELETON, FORCE_PLATE, DEVICE, CAMERA };

struct body_name {
    int32_t id;
    char name[CAPTURE_NAME_MAX];
};

struct body_names {
    size_t count;
    struct body_name body[CAPTURE_BODIES_MAX];
};

struct natnet {
    struct capture_options options;
    char words[CAPTURE_WORDS_MAX]; /* told last; what is told again is no news */
    uint8_t version[2];            /* 0: not known yet */
    double clock_hz;               /* of the time stamps; 0: not told */
    struct natnet_streaming streaming;
    struct body_names names, next_names;
    bool names_wanted;
    bool heard;                                           /* a frame since ask() was called last */
    int64_t heard_us, connect_us, names_us, keepalive_us; /* when it was, or was asked, last */
};

/* A message as it is walked through. */
struct walk {
    struct natnet *natnet;
    struct cursor cursor;
    struct capture_frame *frame;
};

static bool version_known(const uint8_t version[2])
{
    switch (version[0]) {
    case 2: return version[1] >= 5 && version[1] <= 11;
    case 3: return version[1] <= 1;
    case 4: return version[1] <= 2;
    default: return false;
    }
}

static bool since(const struct natnet *natnet, uint8_t major, uint8_t minor)
{
    const uint8_t *version = natnet->version;

    return version[0] > major || (version[0] == major && version[1] >= minor);
}

static void natnet_begin(void *session, const struct capture_options *options)
{
    struct natnet *natnet = session;

    memset(natnet, 0, sizeof *natnet);
    natnet->options = *options;
    natnet->streaming.port = NATNET_DATA_PORT;
    memcpy(natnet->streaming.group, (const uint8_t[]){239, 255, 42, 99}, 4);
    memcpy(natnet->version, options->version, sizeof natnet->version);
    natnet->names_wanted = true;
    natnet->heard_us = natnet->connect_us = natnet->names_us = natnet->keepalive_us = LONG_AGO;
}

struct natnet_streaming natnet_streaming(const void *session)
{
    return ((const struct natnet *)session)->streaming;
}

/* The things of a section one after the other, each of `least` bytes or more. From 4.1 on a section
 * tells its bytes as well as its things, and both have to fit. */
static void walk_section(struct walk *walk, size_t least, void (*thing)(struct walk *walk))
{
    struct cursor *cursor = &walk->cursor;
    uint32_t count = cursor_u32_le(cursor);
    bool sized = since(walk->natnet, 4, 1);
    uint32_t size = sized ? cursor_u32_le(cursor) : 0;
    size_t before = cursor->left;

    if (!cursor_holds(cursor, count, least))
        return;
    for (uint32_t i = 0; i < count && cursor_good(cursor); i++)
        thing(walk);
    if (sized && before - cursor->left != size)
        cursor_fail(cursor);
}

static void walk_marker(struct walk *walk)
{
    cursor_skip(&walk->cursor, 12);
}

static void walk_marker_set(struct walk *walk)
{
    cursor_string_cut(&walk->cursor, NULL, 0);
    cursor_skip_all(&walk->cursor, cursor_u32_le(&walk->cursor), 12);
}

static void walk_labelled_marker(struct walk *walk)
{
    size_t params = since(walk->natnet, 2, 6) ? 2 : 0;
    size_t residual = since(walk->natnet, 3, 0) ? 4 : 0;

    cursor_skip(&walk->cursor, 20 + params + residual);
}

/* A force plate or another device. */
static void walk_device(struct walk *walk)
{
    struct cursor *cursor = &walk->cursor;

    cursor_skip(cursor, 4);
    uint32_t channels = cursor_u32_le(cursor);
    if (!cursor_holds(cursor, channels, 4))
        return;
    for (uint32_t i = 0; i < channels; i++)
        cursor_skip_all(cursor, cursor_u32_le(cursor), 4);
}

static const char *name_of(const struct natnet *natnet, int32_t id, size_t guess)
{
    const struct body_names *names = &natnet->names;

    if (guess < names->count && names->body[guess].id == id)
        return names->body[guess].name;
    for (size_t i = 0; i < names->count; i++)
        if (names->body[i].id == id)
            return names->body[i].name;
    return "";
}

static bool at_origin(const struct capture_body *body)
{
    return body->at[0] == 0 && body->at[1] == 0 && body->at[2] == 0;
}

static struct capture_body read_body(struct walk *walk)
{
    struct cursor *cursor = &walk->cursor;
    struct capture_body body = {.id = cursor_i32_le(cursor)};
    double turn[4];

    for (size_t i = 0; i < 3; i++)
        body.at[i] = cursor_f32_le(cursor);
    for (size_t i = 0; i < 4; i++)
        turn[i] = cursor_f32_le(cursor);
    if (!since(walk->natnet, 3, 0))
        cursor_skip_all(cursor, cursor_u32_le(cursor), 12 + 4 + 4);
    cursor_skip(cursor, 4); /* mean error of its markers */
    if (since(walk->natnet, 2, 6))
        body.tracked = cursor_i16_le(cursor) & 1;
    else
        body.tracked = !at_origin(&body); /* where nothing else tells that it is lost */
    body.tracked = rotation_of_quaternion(turn, body.turn) && body.tracked &&
                   isfinite(body.at[0] + body.at[1] + body.at[2]);
    return body;
}

static void walk_body(struct walk *walk)
{
    struct capture_frame *frame = walk->frame;
    struct capture_body body = read_body(walk);

    if (frame->count == CAPTURE_BODIES_MAX)
        cursor_fail(&walk->cursor);
    if (!cursor_good(&walk->cursor))
        return;
    snprintf(body.name, sizeof body.name, "%s", name_of(walk->natnet, body.id, frame->count));
    if (body.name[0] == '\0')
        walk->natnet->names_wanted = true;
    frame->body[frame->count++] = body;
}

static void walk_skeleton(struct walk *walk)
{
    struct cursor *cursor = &walk->cursor;

    cursor_skip(cursor, 4);
    uint32_t bones = cursor_u32_le(cursor);
    for (uint32_t i = 0; i < bones && cursor_good(cursor); i++)
        read_body(walk);
}

static void walk_asset(struct walk *walk)
{
    struct cursor *cursor = &walk->cursor;

    cursor_skip(cursor, 4);
    cursor_skip_all(cursor, cursor_u32_le(cursor), 38); /* bodies */
    cursor_skip_all(cursor, cursor_u32_le(cursor), 26); /* markers */
}

static void read_stamps(struct walk *walk)
{
    uint64_t exposed = cursor_u64_le(&walk->cursor);
    cursor_skip(&walk->cursor, 8); /* when the images had come */
    uint64_t sent = cursor_u64_le(&walk->cursor);

    if (walk->natnet->clock_hz == 0 || exposed == 0 || sent < exposed)
        return;
    double latency = (double)(sent - exposed) / walk->natnet->clock_hz;
    if (latency <= LATENCY_MAX)
        walk->frame->latency = latency;
}

/* What 2.5 ends with varies, and so does what 4.1 and later do: some send no time, and some no
 * precise one. How much is left tells. */
static void read_suffix(struct walk *walk)
{
    struct cursor *cursor = &walk->cursor;
    struct natnet *natnet = walk->natnet;

    if (!since(natnet, 3, 0))
        cursor_skip(cursor, 4); /* latency of the system's software */
    cursor_skip(cursor, 8);     /* time code */
    if (!since(natnet, 2, 6) && cursor->left == 4)
        return;
    double time = since(natnet, 2, 7) ? cursor_f64_le(cursor) : cursor_f32_le(cursor);
    walk->frame->time = isfinite(time) ? time : NAN;
    if (since(natnet, 3, 0))
        read_stamps(walk);
    if (since(natnet, 4, 1) && cursor->left == 8 + 2 + 4)
        cursor_skip(cursor, 8);
    if (cursor_i16_le(cursor) & 2) /* the bodies have changed */
        natnet->names_wanted = true;
}

static enum capture_news take_frame(struct walk *walk, char words[CAPTURE_WORDS_MAX])
{
    struct natnet *natnet = walk->natnet;
    struct cursor *cursor = &walk->cursor;
    struct capture_frame *frame = walk->frame;
    size_t bytes = cursor->left;

    if (!version_known(natnet->version))
        return CAPTURE_NOTHING;
    frame->numbered = true;
    frame->number = cursor_u32_le(cursor);
    frame->time = NAN;
    frame->latency = 0;
    frame->count = 0;
    walk_section(walk, 5, walk_marker_set);
    walk_section(walk, 12, walk_marker);
    walk_section(walk, 36, walk_body);
    walk_section(walk, 8, walk_skeleton);
    if (since(natnet, 4, 1))
        walk_section(walk, 12, walk_asset);
    walk_section(walk, 20, walk_labelled_marker);
    if (since(natnet, 2, 9))
        walk_section(walk, 8, walk_device);
    if (since(natnet, 2, 11))
        walk_section(walk, 8, walk_device);
    read_suffix(walk);
    if (cursor_u32_le(cursor) == 0 && cursor_good(cursor) && cursor->left == 0) {
        natnet->heard = true;
        return CAPTURE_FRAME;
    }
    snprintf(words, CAPTURE_WORDS_MAX,
             "frame %u of %zu bytes is none of NatNet %u.%u with at most %d bodies", frame->number,
             bytes, natnet->version[0], natnet->version[1], CAPTURE_BODIES_MAX);
    return CAPTURE_BROKEN;
}

static void skip_strings(struct cursor *cursor)
{
    uint32_t count = cursor_u32_le(cursor);

    for (uint32_t i = 0; i < count && cursor_good(cursor); i++)
        cursor_string_cut(cursor, NULL, 0);
}

static struct body_name read_description(struct walk *walk)
{
    struct cursor *cursor = &walk->cursor;
    struct body_name name;

    cursor_string_cut(cursor, name.name, sizeof name.name);
    name.id = cursor_i32_le(cursor);
    cursor_skip(cursor, 4 + 12); /* parent and offset from it */
    if (since(walk->natnet, 4, 2))
        cursor_skip(cursor, 16); /* turn from it */
    if (!since(walk->natnet, 3, 0))
        return name;
    uint32_t markers = cursor_u32_le(cursor);
    cursor_skip_all(cursor, markers, 12 + 4);
    for (uint32_t i = 0; since(walk->natnet, 4, 0) && i < markers && cursor_good(cursor); i++)
        cursor_string_cut(cursor, NULL, 0);
    return name;
}

static void walk_body_description(struct walk *walk)
{
    struct body_names *names = &walk->natnet->next_names;
    struct body_name name = read_description(walk);

    if (names->count == CAPTURE_BODIES_MAX)
        cursor_fail(&walk->cursor);
    if (cursor_good(&walk->cursor))
        names->body[names->count++] = name;
}

static void walk_skeleton_description(struct walk *walk)
{
    cursor_string_cut(&walk->cursor, NULL, 0);
    cursor_skip(&walk->cursor, 4);
    uint32_t bones = cursor_u32_le(&walk->cursor);
    for (uint32_t i = 0; i < bones && cursor_good(&walk->cursor); i++)
        read_description(walk);
}

static void walk_plate_description(struct cursor *cursor)
{
    cursor_skip(cursor, 4);
    cursor_string_cut(cursor, NULL, 0);
    cursor_skip(cursor,
                8 + 12 + 12 * 12 * 4 + 4 * 12 + 8); /* sizes, origin, matrix, corners, types */
    skip_strings(cursor);
}

static void walk_device_description(struct cursor *cursor)
{
    cursor_skip(cursor, 4);
    cursor_string_cut(cursor, NULL, 0);
    cursor_string_cut(cursor, NULL, 0);
    cursor_skip(cursor, 8);
    skip_strings(cursor);
}

static void walk_dataset(struct walk *walk, uint32_t type)
{
    struct cursor *cursor = &walk->cursor;

    switch (type) {
    case MARKER_SET:
        cursor_string_cut(cursor, NULL, 0);
        skip_strings(cursor);
        break;
    case RIGID_BODY: walk_body_description(walk); break;
    case SKELETON: walk_skeleton_description(walk); break;
    case FORCE_PLATE: walk_plate_description(cursor); break;
    case DEVICE: walk_device_description(cursor); break;
    case CAMERA:
        cursor_string_cut(cursor, NULL, 0);
        cursor_skip(cursor, 12 + 16);
        break;
    default: cursor_fail(cursor); break;
    }
}

/* From 4.1 on a dataset tells its bytes: what is no rigid body is skipped, whatever it is. */
static void walk_sized_dataset(struct walk *walk)
{
    uint32_t type = cursor_u32_le(&walk->cursor);
    struct walk part = *walk;

    if (since(walk->natnet, 4, 1))
        part.cursor = cursor_part(&walk->cursor, cursor_u32_le(&walk->cursor));
    if (!since(walk->natnet, 4, 1)) {
        walk_dataset(walk, type);
    } else if (type == RIGID_BODY) {
        walk_dataset(&part, type);
        if (!cursor_good(&part.cursor) || part.cursor.left != 0)
            cursor_fail(&walk->cursor);
    }
}

static enum capture_news take_names(struct walk *walk, char words[CAPTURE_WORDS_MAX])
{
    struct natnet *natnet = walk->natnet;
    struct cursor *cursor = &walk->cursor;

    if (!version_known(natnet->version))
        return CAPTURE_NOTHING;
    natnet->next_names.count = 0;
    uint32_t count = cursor_u32_le(cursor);
    for (uint32_t i = 0; i < count && cursor_good(cursor); i++)
        walk_sized_dataset(walk);
    if (cursor_good(cursor)) {
        natnet->names = natnet->next_names;
        natnet->names_wanted = false;
        return CAPTURE_NOTHING;
    }
    snprintf(words, CAPTURE_WORDS_MAX, "the list of bodies is none of NatNet %u.%u",
             natnet->version[0], natnet->version[1]);
    return CAPTURE_BROKEN;
}

static bool news_of(struct natnet *natnet, const char *words)
{
    bool news = strcmp(natnet->words, words) != 0;

    snprintf(natnet->words, sizeof natnet->words, "%s", words);
    return news;
}

static enum capture_news refuse(struct natnet *natnet, const char *system, const uint8_t version[2],
                                char words[CAPTURE_WORDS_MAX])
{
    memset(natnet->version, 0, sizeof natnet->version);
    natnet->streaming.answered = false;
    snprintf(words, CAPTURE_WORDS_MAX,
             "%s speaks NatNet %u.%u; 2.5 to 2.11, 3.0, 3.1 and 4.0 to 4.2 are known", system,
             version[0], version[1]);
    return news_of(natnet, words) ? CAPTURE_REFUSED : CAPTURE_NOTHING;
}

static struct natnet_streaming read_streaming(struct natnet *natnet, struct cursor *cursor)
{
    struct natnet_streaming streaming = {.answered = true, .told = true};

    natnet->clock_hz = (double)cursor_u64_le(cursor);
    streaming.port = cursor_u16_le(cursor);
    streaming.multicast = cursor_u8(cursor) != 0;
    const uint8_t *group = cursor_bytes(cursor, sizeof streaming.group);
    if (group != NULL)
        memcpy(streaming.group, group, sizeof streaming.group);
    return streaming;
}

static enum capture_news take_server(struct walk *walk, char words[CAPTURE_WORDS_MAX])
{
    struct natnet *natnet = walk->natnet;
    struct cursor *cursor = &walk->cursor;
    char system[CAPTURE_NAME_MAX];

    cursor_text(cursor, SENDER_NAME, system, sizeof system);
    const uint8_t *software = cursor_bytes(cursor, 4);
    const uint8_t *version = cursor_bytes(cursor, 4);
    if (version != NULL && !version_known(version))
        return refuse(natnet, system, version, words);
    if (version != NULL && version[0] >= 3)
        natnet->streaming = read_streaming(natnet, cursor);
    if (!cursor_good(cursor)) {
        snprintf(words, CAPTURE_WORDS_MAX, "a SERVERINFO that ends early");
        return CAPTURE_BROKEN;
    }
    if (memcmp(natnet->version, version, 2) != 0)
        natnet->names.count = 0;
    memcpy(natnet->version, version, 2);
    natnet->streaming.answered = true;
    snprintf(words, CAPTURE_WORDS_MAX, "%s %u.%u, NatNet %u.%u", system, software[0], software[1],
             version[0], version[1]);
    return news_of(natnet, words) ? CAPTURE_TOLD : CAPTURE_NOTHING;
}

/* A version from the options is refused as one from a system is, at the first thing that comes. */
static bool option_unknown(const struct natnet *natnet)
{
    return natnet->version[0] != 0 && !version_known(natnet->version);
}

static enum capture_news take_message(struct walk *walk, uint16_t id, char words[CAPTURE_WORDS_MAX])
{
    struct natnet *natnet = walk->natnet;

    if (id != SERVERINFO && option_unknown(natnet))
        return refuse(natnet, "the site file's system", natnet->options.version, words);
    switch (id) {
    case SERVERINFO: return take_server(walk, words);
    case MODELDEF: return take_names(walk, words);
    case FRAME: return take_frame(walk, words);
    case UNRECOGNIZED: /* nothing but the names is ever asked for that it could do without */
        natnet->names_wanted = false;
        return CAPTURE_NOTHING;
    default: break;
    }
    if (id <= LAST_ID)
        return CAPTURE_NOTHING;
    snprintf(words, CAPTURE_WORDS_MAX, "message %u is none of NatNet's", id);
    return CAPTURE_BROKEN;
}

static enum capture_news natnet_take(void *session, const uint8_t *bytes, size_t count,
                                     size_t *used, struct capture_frame *frame,
                                     char words[CAPTURE_WORDS_MAX])
{
    struct cursor header = cursor_over(bytes, count);
    uint16_t id = cursor_u16_le(&header);
    uint16_t size = cursor_u16_le(&header);

    *used = count;
    if (!cursor_good(&header) || header.left < size) {
        snprintf(words, CAPTURE_WORDS_MAX, "a datagram of %zu bytes that ends early", count);
        return CAPTURE_BROKEN;
    }
    struct walk walk = {session, cursor_part(&header, size), frame};
    return take_message(&walk, id, words);
}

static size_t write_message(uint8_t *bytes, enum message_id id, size_t total)
{
    memset(bytes, 0, total);
    bytes[0] = (uint8_t)id;
    bytes[2] = (uint8_t)(total - HEADER_BYTES);
    bytes[3] = (uint8_t)((total - HEADER_BYTES) >> 8);
    return total;
}

/* In full, for some servers fail on a shorter one: name, its version, the newest NatNet known. */
static size_t write_connect(uint8_t *bytes)
{
    static const uint8_t versions[] = {1, 0, 0, 0, 4, 2, 0, 0};

    write_message(bytes, CONNECT, CONNECT_BYTES);
    memcpy(bytes + HEADER_BYTES, "muster", 6);
    memcpy(bytes + HEADER_BYTES + SENDER_NAME, versions, sizeof versions);
    return CONNECT_BYTES;
}

/* It is time to say what was said at `last_us`, which becomes now. */
static bool due(int64_t *last_us, int64_t now_us, int64_t period_us)
{
    if (now_us - *last_us < period_us)
        return false;
    *last_us = now_us;
    return true;
}

/* A system that has been started anew knows nobody: while no frames come, it is asked again. */
static size_t natnet_ask(void *session, int64_t now_us, uint8_t *bytes, size_t room)
{
    struct natnet *natnet = session;

    assert(room >= CONNECT_BYTES);
    if (natnet->heard)
        natnet->heard_us = now_us;
    natnet->heard = false;
    bool hearing = natnet->streaming.answered && now_us - natnet->heard_us < ASK_AGAIN_US;
    if (!hearing && due(&natnet->connect_us, now_us, ASK_AGAIN_US))
        return write_connect(bytes);
    if (!natnet->streaming.answered)
        return 0;
    if (natnet->names_wanted && due(&natnet->names_us, now_us, ASK_AGAIN_US))
        return write_message(bytes, REQUEST_MODELDEF, HEADER_BYTES);
    if (natnet->options.unicast && due(&natnet->keepalive_us, now_us, KEEPALIVE_US))
        return write_message(bytes, KEEPALIVE, HEADER_BYTES);
    return 0;
}

const struct capture_protocol natnet_protocol = {
    .name = "natnet",
    .stream = false,
    .port = COMMAND_PORT,
    .unit = 1,
    .session_bytes = sizeof(struct natnet),
    .begin = natnet_begin,
    .take = natnet_take,
    .ask = natnet_ask,
};
