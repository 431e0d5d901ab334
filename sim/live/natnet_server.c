#include "natnet_server.h"

#include "wire.h"

#include <math.h>

enum message {
    CONNECT = 0,
    SERVERINFO = 1,
    REQUEST = 2,
    REQUEST_MODELDEF = 4,
    MODELDEF = 5,
    FRAME = 7,
    KEEPALIVE = 10,
    ECHO_REQUEST = 12,
    ECHO_RESPONSE = 13,
    DISCOVERY = 14,
    UNRECOGNIZED = 100,
};

#define HEADER_BYTES 4
#define NAME_BYTES 256
#define TRACKED 1

/* Where the next value goes; what does not fit in is not written, and makes it full. */
struct writer {
    uint8_t *begin, *at, *end;
    bool full;
    int version; /* 100 * major + minor */
};

static void put(struct writer *writer, const void *value, size_t count)
{
    if (count > (size_t)(writer->end - writer->at)) {
        writer->full = true;
        return;
    }
    memcpy(writer->at, value, count);
    writer->at += count;
}

static void put_int(struct writer *writer, int32_t value)
{
    put(writer, &value, sizeof value);
}

static void put_short(struct writer *writer, uint16_t value)
{
    put(writer, &value, sizeof value);
}

static void put_long(struct writer *writer, uint64_t value)
{
    put(writer, &value, sizeof value);
}

static void put_float(struct writer *writer, double value)
{
    put(writer, &(float){(float)value}, sizeof(float));
}

static void put_name(struct writer *writer, const char *name)
{
    put(writer, name, strlen(name) + 1);
}

static struct writer begin(const struct natnet_server *server, enum message message, uint8_t *bytes,
                           size_t room)
{
    struct writer writer = {bytes, bytes, bytes + room, false,
                            100 * server->version[0] + server->version[1]};

    put_short(&writer, (uint16_t)message);
    put_short(&writer, 0); /* known in the end */
    return writer;
}

static size_t end(struct writer *writer)
{
    size_t count = (size_t)(writer->at - writer->begin);
    uint16_t payload = (uint16_t)(count - HEADER_BYTES);

    if (writer->full || count > NATNET_DATAGRAM_MAX)
        return 0;
    memcpy(writer->begin + 2, &payload, sizeof payload);
    return count;
}

/* Sections and models are preceded by their size since 4.1. */
static uint8_t *begin_sized(struct writer *writer)
{
    if (writer->version >= 401)
        put_int(writer, 0);
    return writer->at;
}

static void end_sized(struct writer *writer, uint8_t *begun)
{
    int32_t size = (int32_t)(writer->at - begun);

    if (writer->version >= 401 && !writer->full)
        memcpy(begun - sizeof size, &size, sizeof size);
}

static void put_empty_section(struct writer *writer, int since)
{
    if (writer->version < since)
        return;
    put_int(writer, 0);
    end_sized(writer, begin_sized(writer));
}

bool natnet_server_speaks(const uint8_t version[2])
{
    int number = 100 * version[0] + version[1];

    return number >= 205 && number <= 402;
}

/* ---- frames ---------------------------------------------------------------------------- */

static void put_body(struct writer *writer, const struct capture_body *body)
{
    put_int(writer, body->id);
    for (int i = 0; i < 3; i++)
        put_float(writer, body->at[i]);
    for (int i = 0; i < 4; i++)
        put_float(writer, body->turn[i]);
    if (writer->version < 300)
        put_int(writer, 0); /* markers */
    put_float(writer, 0);   /* mean marker error */
    if (writer->version >= 206)
        put_short(writer, body->tracked ? TRACKED : 0);
}

static void put_bodies(struct writer *writer, const struct capture_frame *frame)
{
    put_int(writer, (int32_t)frame->count);
    uint8_t *begun = begin_sized(writer);
    for (size_t i = 0; i < frame->count; i++)
        put_body(writer, &frame->body[i]);
    end_sized(writer, begun);
}

static uint64_t clock_of(double seconds)
{
    return (uint64_t)llround(seconds * NATNET_CLOCK_HZ);
}

static void put_suffix(struct writer *writer, const struct capture_frame *frame)
{
    if (writer->version < 300)
        put_float(writer, frame->latency); /* of the software */
    put_int(writer, 0);                    /* timecode */
    put_int(writer, 0);
    if (writer->version >= 207)
        put(writer, &frame->time, sizeof frame->time);
    else
        put_float(writer, frame->time);
    if (writer->version >= 300) {
        put_long(writer, clock_of(frame->time)); /* exposure, arrival of the images, sending */
        put_long(writer, clock_of(frame->time));
        put_long(writer, clock_of(frame->time + frame->latency));
    }
    if (writer->version >= 401) {
        put_int(writer, 0); /* the time of a precision clock */
        put_int(writer, 0);
    }
    put_short(writer, 0); /* recording, models changed */
    put_int(writer, 0);   /* the end */
}

size_t natnet_server_frame(const struct natnet_server *server, const struct capture_frame *frame,
                           uint8_t *bytes, size_t room)
{
    struct writer writer = begin(server, FRAME, bytes, room);

    put_int(&writer, (int32_t)frame->number);
    put_empty_section(&writer, 0); /* marker sets */
    put_empty_section(&writer, 0); /* other markers */
    put_bodies(&writer, frame);
    put_empty_section(&writer, 201); /* skeletons */
    put_empty_section(&writer, 401); /* assets */
    put_empty_section(&writer, 203); /* labelled markers */
    put_empty_section(&writer, 209); /* force plates */
    put_empty_section(&writer, 211); /* devices */
    put_suffix(&writer, frame);
    return end(&writer);
}

/* ---- answers --------------------------------------------------------------------------- */

static size_t write_info(const struct natnet_server *server, uint8_t *bytes, size_t room)
{
    struct writer writer = begin(server, SERVERINFO, bytes, room);
    const char name[NAME_BYTES] = "Muster arena";
    const uint8_t version[4] = {server->version[0], server->version[1]};

    put(&writer, name, sizeof name);
    put(&writer, version, sizeof version); /* of the program, then of the protocol */
    put(&writer, version, sizeof version);
    if (writer.version >= 300) {
        put_long(&writer, NATNET_CLOCK_HZ);
        put_short(&writer, server->data_port);
        put(&writer, &(uint8_t){server->multicast}, 1);
        put(&writer, server->group, sizeof server->group);
    }
    return end(&writer);
}

#define MODEL_RIGID_BODY 1

static void put_model(struct writer *writer, const struct capture_body *body)
{
    put_int(writer, MODEL_RIGID_BODY);
    uint8_t *begun = begin_sized(writer);
    put_name(writer, body->name);
    put_int(writer, body->id);
    put_int(writer, -1); /* no parent */
    for (int i = 0; i < 3; i++)
        put_float(writer, 0); /* offset to it */
    if (writer->version >= 402)
        for (int i = 0; i < 4; i++)
            put_float(writer, i == 3); /* not turned */
    if (writer->version >= 300)
        put_int(writer, 0); /* markers */
    end_sized(writer, begun);
}

static size_t write_models(const struct natnet_server *server, const struct capture_frame *frame,
                           uint8_t *bytes, size_t room)
{
    struct writer writer = begin(server, MODELDEF, bytes, room);

    put_int(&writer, (int32_t)frame->count);
    for (size_t i = 0; i < frame->count; i++)
        put_model(&writer, &frame->body[i]);
    return end(&writer);
}

/* The client's stamp as it came, and ours. */
static size_t write_echo(const struct natnet_server *server, double time, const uint8_t *stamp,
                         uint8_t *bytes, size_t room)
{
    struct writer writer = begin(server, ECHO_RESPONSE, bytes, room);

    put(&writer, stamp, sizeof(uint64_t));
    put_long(&writer, clock_of(time));
    return end(&writer);
}

static size_t write_unrecognized(const struct natnet_server *server, uint8_t *bytes, size_t room)
{
    struct writer writer = begin(server, UNRECOGNIZED, bytes, room);

    return end(&writer);
}

size_t natnet_server_answer(const struct natnet_server *server, const struct capture_frame *frame,
                            double time, const uint8_t *request, size_t count, uint8_t *bytes,
                            size_t room, bool *client)
{
    const uint8_t *at = request;

    *client = false;
    if (count < HEADER_BYTES)
        return 0;
    uint16_t message = take_u16(&at), payload = take_u16(&at);
    if (payload > count - HEADER_BYTES)
        return 0;
    *client = message == CONNECT || message == KEEPALIVE;
    switch (message) {
    case CONNECT:
    case DISCOVERY: return write_info(server, bytes, room);
    case REQUEST_MODELDEF: return write_models(server, frame, bytes, room);
    case ECHO_REQUEST:
        return payload < sizeof(uint64_t) ? 0 : write_echo(server, time, at, bytes, room);
    case REQUEST: return write_unrecognized(server, bytes, room);
    default: return 0;
    }
}
