#include "natnet_writer.h"

#include <assert.h>
#include <string.h>

static bool since(const struct natnet_writer *writer, uint8_t major, uint8_t minor)
{
    return writer->major > major || (writer->major == major && writer->minor >= minor);
}

static void put_bytes(struct natnet_writer *writer, const void *bytes, size_t count)
{
    assert(writer->count + count <= sizeof writer->bytes);
    memcpy(writer->bytes + writer->count, bytes, count);
    writer->count += count;
}

static void put(struct natnet_writer *writer, uint64_t value, size_t width)
{
    for (size_t i = 0; i < width; i++) {
        uint8_t byte = (uint8_t)(value >> 8 * i);
        put_bytes(writer, &byte, 1);
    }
}

static void put_zeros(struct natnet_writer *writer, size_t count)
{
    for (size_t i = 0; i < count; i++)
        put(writer, 0, 1);
}

static void put_float(struct natnet_writer *writer, float value)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    put(writer, bits, 4);
}

static void put_floats(struct natnet_writer *writer, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        put_float(writer, values[i]);
}

static void put_double(struct natnet_writer *writer, double value)
{
    uint64_t bits;

    memcpy(&bits, &value, sizeof bits);
    put(writer, bits, 8);
}

static void put_string(struct natnet_writer *writer, const char *text)
{
    put_bytes(writer, text, strlen(text) + 1);
}

static void begin(struct natnet_writer *writer, uint16_t id)
{
    writer->count = 0;
    put(writer, id, 2);
    put(writer, 0, 2);
}

static void end(struct natnet_writer *writer)
{
    writer->bytes[2] = (uint8_t)(writer->count - 4);
    writer->bytes[3] = (uint8_t)((writer->count - 4) >> 8);
}

/* The place of a size that is not known yet; SIZE_MAX where the version has none. */
static size_t begin_size(struct natnet_writer *writer)
{
    if (!since(writer, 4, 1))
        return SIZE_MAX;
    put(writer, 0, 4);
    return writer->count;
}

static void end_size(struct natnet_writer *writer, size_t start)
{
    if (start == SIZE_MAX)
        return;
    for (size_t i = 0; i < 4; i++)
        writer->bytes[start - 4 + i] = (uint8_t)((writer->count - start) >> 8 * i);
}

static size_t begin_section(struct natnet_writer *writer, size_t count)
{
    put(writer, count, 4);
    return begin_size(writer);
}

void natnet_write_message(struct natnet_writer *writer, uint16_t id, size_t count)
{
    begin(writer, id);
    put_zeros(writer, count);
    end(writer);
}

void natnet_write_server(struct natnet_writer *writer, bool multicast, uint16_t data_port,
                         const uint8_t group[4])
{
    const uint8_t versions[] = {2, 1, 0, 0, writer->major, writer->minor, 0, 0};
    char name[256] = "Motive\0garbage";

    begin(writer, 1);
    put_bytes(writer, name, sizeof name);
    put_bytes(writer, versions, sizeof versions);
    if (since(writer, 3, 0)) {
        put(writer, 1000000, 8);
        put(writer, data_port, 2);
        put(writer, multicast, 1);
        put_bytes(writer, group, 4);
    }
    end(writer);
}

static void write_description(struct natnet_writer *writer, const char *name, int32_t id)
{
    put_string(writer, name);
    put(writer, (uint32_t)id, 4);
    put(writer, UINT32_MAX, 4); /* no parent */
    put_floats(writer, (const float[]){0, 0, 0}, 3);
    if (since(writer, 4, 2))
        put_floats(writer, (const float[]){0, 0, 0, 1}, 4);
    if (!since(writer, 3, 0))
        return;
    put(writer, 2, 4); /* markers */
    put_zeros(writer, 2 * 12 + 2 * 4);
    if (since(writer, 4, 0)) {
        put_string(writer, "Marker1");
        put_string(writer, "Marker2");
    }
}

static void write_other_models(struct natnet_writer *writer)
{
    put(writer, 0, 4); /* marker set */
    size_t start = begin_size(writer);
    put_string(writer, "all");
    put(writer, 1, 4);
    put_string(writer, "Marker1");
    end_size(writer, start);

    put(writer, 2, 4); /* skeleton */
    start = begin_size(writer);
    put_string(writer, "Somebody");
    put(writer, 77, 4);
    put(writer, 1, 4);
    write_description(writer, "Hip", 1);
    end_size(writer, start);
}

void natnet_write_models(struct natnet_writer *writer, const struct written_body *bodies,
                         size_t count, bool crowded)
{
    begin(writer, 5);
    put(writer, count + (crowded ? 2 : 0), 4);
    if (crowded)
        write_other_models(writer);
    for (size_t i = 0; i < count; i++) {
        put(writer, 1, 4);
        size_t start = begin_size(writer);
        write_description(writer, bodies[i].name, bodies[i].id);
        end_size(writer, start);
    }
    end(writer);
}

static void write_body(struct natnet_writer *writer, const struct written_body *body)
{
    put(writer, (uint32_t)body->id, 4);
    put_floats(writer, body->at, 3);
    put_floats(writer, body->turn, 4);
    if (!since(writer, 3, 0)) {
        put(writer, 1, 4); /* markers */
        put_zeros(writer, 12 + 4 + 4);
    }
    put_float(writer, 0.0005f);
    if (since(writer, 2, 6))
        put(writer, body->tracked, 2);
}

static void write_marker_sets(struct natnet_writer *writer, bool crowded)
{
    size_t start = begin_section(writer, crowded);

    if (crowded) {
        put_string(writer, "all");
        put(writer, 2, 4);
        put_zeros(writer, 24);
    }
    end_size(writer, start);
    start = begin_section(writer, crowded); /* other markers */
    put_zeros(writer, crowded ? 12 : 0);
    end_size(writer, start);
}

static void write_skeletons(struct natnet_writer *writer, bool crowded)
{
    static const struct written_body bone = {1, "Hip", {1, 2, 3}, {0, 0, 0, 1}, true};
    size_t start = begin_section(writer, crowded);

    if (crowded) {
        put(writer, 77, 4);
        put(writer, 2, 4);
        write_body(writer, &bone);
        write_body(writer, &bone);
    }
    end_size(writer, start);
    if (!since(writer, 4, 1))
        return;
    start = begin_section(writer, crowded); /* assets */
    if (crowded) {
        put(writer, 5, 4);
        put(writer, 1, 4);
        put_zeros(writer, 38);
        put(writer, 2, 4);
        put_zeros(writer, 2 * 26);
    }
    end_size(writer, start);
}

static void write_labelled_markers(struct natnet_writer *writer, bool crowded)
{
    size_t each = 20 + (since(writer, 2, 6) ? 2 : 0) + (since(writer, 3, 0) ? 4 : 0);
    size_t start = begin_section(writer, crowded ? 2 : 0);

    put_zeros(writer, crowded ? 2 * each : 0);
    end_size(writer, start);
}

static void write_devices(struct natnet_writer *writer, bool crowded)
{
    size_t start = begin_section(writer, crowded);

    if (crowded) {
        put(writer, 9, 4);
        put(writer, 2, 4); /* channels, of 3 values and of none */
        put(writer, 3, 4);
        put_zeros(writer, 12);
        put(writer, 0, 4);
    }
    end_size(writer, start);
}

static void write_suffix(struct natnet_writer *writer, const struct written_frame *frame)
{
    if (!since(writer, 3, 0))
        put_float(writer, 0.003f); /* latency of the software */
    put_zeros(writer, 8);          /* time code */
    if (since(writer, 2, 7))
        put_double(writer, frame->time);
    else
        put_float(writer, (float)frame->time);
    if (since(writer, 3, 0)) {
        put(writer, frame->exposed, 8);
        put(writer, frame->exposed, 8);
        put(writer, frame->sent, 8);
    }
    if (since(writer, 4, 1) && frame->precise)
        put_zeros(writer, 8);
    put(writer, frame->models_changed ? 2 : 0, 2);
    put(writer, 0, 4);
}

void natnet_write_frame(struct natnet_writer *writer, const struct written_frame *frame)
{
    begin(writer, 7);
    put(writer, (uint32_t)frame->number, 4);
    write_marker_sets(writer, frame->crowded);
    size_t start = begin_section(writer, frame->count);
    for (size_t i = 0; i < frame->count; i++)
        write_body(writer, &frame->body[i]);
    end_size(writer, start);
    write_skeletons(writer, frame->crowded);
    write_labelled_markers(writer, frame->crowded);
    if (since(writer, 2, 9))
        write_devices(writer, frame->crowded); /* force plates */
    if (since(writer, 2, 11))
        write_devices(writer, frame->crowded);
    write_suffix(writer, frame);
    end(writer);
}
