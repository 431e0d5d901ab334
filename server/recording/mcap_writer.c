#include "mcap_writer.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

/* More makes files little smaller and takes much longer. */
#define LEVEL 1

struct channel {
    uint16_t id;
    uint64_t messages;
    struct mcap_bytes index; /* time and place of its messages in this chunk */
};

/* The records of one kind in the summary. */
struct group {
    struct mcap_bytes records;
    uint32_t count;
};

struct mcap_writer {
    int fd;
    int wrong;             /* errno of the first failure */
    uint64_t written;      /* bytes, so far */
    uint32_t crc;          /* of all of them */
    struct mcap_bytes out; /* to be written next */
    struct mcap_bytes chunk;
    uint64_t chunk_first_ns, chunk_last_ns;
    uint64_t first_ns, last_ns;
    uint64_t messages;
    struct channel *channel;
    size_t channel_count;
    struct group schemas, channels, chunks, metadata;
    ZSTD_CCtx *zstd;
};

struct mcap_writer *mcap_writer_open(int fd)
{
    struct mcap_writer *writer = calloc(1, sizeof *writer);

    if (writer == NULL)
        return NULL;
    writer->zstd = ZSTD_createCCtx();
    if (writer->zstd == NULL) {
        free(writer);
        return NULL;
    }
    writer->fd = fd;
    mcap_put(&writer->out, MCAP_MAGIC, MCAP_MAGIC_BYTES);
    return writer;
}

static void fail(struct mcap_writer *writer, int wrong)
{
    if (writer->wrong == 0)
        writer->wrong = wrong;
}

/* Where in the file the next byte comes. */
static uint64_t position(const struct mcap_writer *writer)
{
    return writer->written + writer->out.count;
}

static void write_all(struct mcap_writer *writer, const uint8_t *bytes, size_t count)
{
    while (count > 0) {
        ssize_t now = write(writer->fd, bytes, count);

        if (now < 0 && errno == EINTR)
            continue;
        if (now <= 0) {
            fail(writer, now < 0 ? errno : EIO);
            return;
        }
        bytes += now;
        count -= (size_t)now;
    }
}

static void hand_over(struct mcap_writer *writer)
{
    struct mcap_bytes *out = &writer->out;

    if (out->failed)
        fail(writer, ENOMEM);
    if (writer->wrong == 0)
        write_all(writer, out->at, out->count);
    writer->crc = (uint32_t)crc32_z(writer->crc, out->at, out->count);
    writer->written += out->count;
    out->count = 0;
}

/* ---- definitions ----------------------------------------------------------------------- */

static struct channel *find_channel(const struct mcap_writer *writer, uint16_t id)
{
    for (size_t i = 0; i < writer->channel_count; i++)
        if (writer->channel[i].id == id)
            return &writer->channel[i];
    return NULL;
}

static bool add_channel(struct mcap_writer *writer, uint16_t id)
{
    size_t count = writer->channel_count;

    if (find_channel(writer, id) != NULL)
        return false;
    struct channel *channel = realloc(writer->channel, (count + 1) * sizeof *channel);
    if (channel == NULL) {
        fail(writer, ENOMEM);
        return false;
    }
    channel[count] = (struct channel){.id = id};
    writer->channel = channel;
    writer->channel_count++;
    return true;
}

static bool is_new_schema(const struct mcap_writer *writer, const uint8_t *id)
{
    const struct mcap_bytes *records = &writer->schemas.records;
    uint64_t length;

    for (size_t at = 0; !records->failed && at < records->count; at += MCAP_HEAD_BYTES + length) {
        memcpy(&length, records->at + at + 1, sizeof length);
        if (memcmp(records->at + at + MCAP_HEAD_BYTES, id, 2) == 0)
            return false;
    }
    return true;
}

static void put_record(struct mcap_bytes *bytes, enum mcap_opcode opcode, const uint8_t *contents,
                       size_t count)
{
    size_t begun = mcap_begin(bytes, opcode);

    mcap_put(bytes, contents, count);
    mcap_end(bytes, begun);
}

static void add_to(struct group *group, enum mcap_opcode opcode, const uint8_t *contents,
                   size_t count)
{
    put_record(&group->records, opcode, contents, count);
    group->count++;
}

/* Its name comes first in its contents, as it does in the index. */
static void index_metadata(struct mcap_writer *writer, const uint8_t *contents, size_t count)
{
    struct mcap_bytes *records = &writer->metadata.records;
    uint32_t length;

    memcpy(&length, contents, sizeof length);
    size_t begun = mcap_begin(records, MCAP_METADATA_INDEX);
    mcap_put_u64(records, position(writer));
    mcap_put_u64(records, MCAP_HEAD_BYTES + count);
    mcap_put(records, contents, sizeof length + length);
    mcap_end(records, begun);
    writer->metadata.count++;
}

void mcap_writer_record(struct mcap_writer *writer, enum mcap_opcode opcode,
                        const uint8_t *contents, size_t count)
{
    uint16_t id;

    memcpy(&id, contents, sizeof id);
    if (opcode == MCAP_SCHEMA) {
        if (!is_new_schema(writer, contents))
            return;
        add_to(&writer->schemas, opcode, contents, count);
    } else if (opcode == MCAP_CHANNEL) {
        if (!add_channel(writer, id))
            return;
        add_to(&writer->channels, opcode, contents, count);
    } else if (opcode == MCAP_METADATA) {
        index_metadata(writer, contents, count);
    }
    put_record(&writer->out, opcode, contents, count);
}

static void take(struct mcap_writer *writer, enum mcap_opcode opcode, struct mcap_bytes *contents)
{
    if (contents->failed)
        fail(writer, ENOMEM);
    else
        mcap_writer_record(writer, opcode, contents->at, contents->count);
    mcap_bytes_free(contents);
}

void mcap_writer_header(struct mcap_writer *writer, const char *profile, const char *library)
{
    struct mcap_bytes contents = {0};

    mcap_put_text(&contents, profile);
    mcap_put_text(&contents, library);
    take(writer, MCAP_HEADER, &contents);
}

void mcap_writer_schema(struct mcap_writer *writer, uint16_t id, const char *name,
                        const char *encoding, const char *definition)
{
    struct mcap_bytes contents = {0};

    mcap_put_u16(&contents, id);
    mcap_put_text(&contents, name);
    mcap_put_text(&contents, encoding);
    mcap_put_text(&contents, definition);
    take(writer, MCAP_SCHEMA, &contents);
}

void mcap_writer_channel(struct mcap_writer *writer, uint16_t id, uint16_t schema,
                         const char *topic, const char *encoding)
{
    struct mcap_bytes contents = {0};

    mcap_put_u16(&contents, id);
    mcap_put_u16(&contents, schema);
    mcap_put_text(&contents, topic);
    mcap_put_text(&contents, encoding);
    size_t map = mcap_begin_map(&contents);
    mcap_put_text(&contents, "offered_qos_profiles");
    mcap_put_text(&contents, "");
    mcap_end_map(&contents, map);
    take(writer, MCAP_CHANNEL, &contents);
}

void mcap_writer_metadata(struct mcap_writer *writer, const char *name, const char *const pairs[],
                          size_t count)
{
    struct mcap_bytes contents = {0};

    mcap_put_text(&contents, name);
    size_t map = mcap_begin_map(&contents);
    for (size_t i = 0; i < 2 * count; i++)
        mcap_put_text(&contents, pairs[i]);
    mcap_end_map(&contents, map);
    take(writer, MCAP_METADATA, &contents);
}

/* ---- messages and chunks --------------------------------------------------------------- */

static void note_time(struct mcap_writer *writer, uint64_t time_ns)
{
    bool first = writer->chunk.count == 0;

    if (first || time_ns < writer->chunk_first_ns)
        writer->chunk_first_ns = time_ns;
    if (first || time_ns > writer->chunk_last_ns)
        writer->chunk_last_ns = time_ns;
    if (writer->messages == 0 || time_ns < writer->first_ns)
        writer->first_ns = time_ns;
    if (time_ns > writer->last_ns)
        writer->last_ns = time_ns;
}

bool mcap_writer_message(struct mcap_writer *writer, uint16_t id, uint64_t time_ns,
                         const uint8_t *bytes, size_t count)
{
    struct channel *channel = find_channel(writer, id);
    struct mcap_bytes *chunk = &writer->chunk;

    if (channel == NULL)
        return false;
    note_time(writer, time_ns);
    mcap_put_u64(&channel->index, time_ns);
    mcap_put_u64(&channel->index, chunk->count);
    size_t begun = mcap_begin(chunk, MCAP_MESSAGE);
    mcap_put_u16(chunk, id);
    mcap_put_u32(chunk, (uint32_t)channel->messages++);
    mcap_put_u64(chunk, time_ns);
    mcap_put_u64(chunk, time_ns);
    mcap_put(chunk, bytes, count);
    mcap_end(chunk, begun);
    writer->messages++;
    if (chunk->count >= MCAP_CHUNK_BYTES)
        mcap_writer_cut(writer);
    return true;
}

/* Returns the compressed bytes, which come last in the record. */
static size_t put_chunk(struct mcap_writer *writer)
{
    const struct mcap_bytes *chunk = &writer->chunk;
    struct mcap_bytes *out = &writer->out;
    size_t bound = ZSTD_compressBound(chunk->count);
    size_t begun = mcap_begin(out, MCAP_CHUNK);

    mcap_put_u64(out, writer->chunk_first_ns);
    mcap_put_u64(out, writer->chunk_last_ns);
    mcap_put_u64(out, chunk->count);
    mcap_put_u32(out, (uint32_t)crc32_z(0, chunk->at, chunk->count));
    mcap_put_text(out, "zstd");
    mcap_put_u64(out, 0);
    size_t records = out->count;
    uint8_t *at = mcap_reserve(out, bound);
    if (at == NULL)
        return 0;
    size_t count = ZSTD_compressCCtx(writer->zstd, at, bound, chunk->at, chunk->count, LEVEL);
    if (ZSTD_isError(count)) {
        fail(writer, ENOMEM);
        return 0;
    }
    out->count += count;
    mcap_end(out, records);
    mcap_end(out, begun);
    return count;
}

/* Puts the messages' index behind their chunk, and where it is into the map of the chunk's own. */
static void put_message_indexes(struct mcap_writer *writer, struct mcap_bytes *chunk_index)
{
    struct mcap_bytes *out = &writer->out;

    for (size_t i = 0; i < writer->channel_count; i++) {
        struct channel *channel = &writer->channel[i];

        if (channel->index.failed)
            fail(writer, ENOMEM);
        if (channel->index.count == 0)
            continue;
        mcap_put_u16(chunk_index, channel->id);
        mcap_put_u64(chunk_index, position(writer));
        size_t begun = mcap_begin(out, MCAP_MESSAGE_INDEX);
        mcap_put_u16(out, channel->id);
        mcap_put_u32(out, (uint32_t)channel->index.count);
        mcap_put(out, channel->index.at, channel->index.count);
        mcap_end(out, begun);
        channel->index.count = 0;
    }
}

static void put_chunk_and_indexes(struct mcap_writer *writer)
{
    struct mcap_bytes *index = &writer->chunks.records;
    uint64_t start = position(writer);
    size_t compressed = put_chunk(writer);
    uint64_t end = position(writer);
    size_t begun = mcap_begin(index, MCAP_CHUNK_INDEX);

    mcap_put_u64(index, writer->chunk_first_ns);
    mcap_put_u64(index, writer->chunk_last_ns);
    mcap_put_u64(index, start);
    mcap_put_u64(index, end - start);
    size_t map = mcap_begin_map(index);
    put_message_indexes(writer, index);
    mcap_end_map(index, map);
    mcap_put_u64(index, position(writer) - end);
    mcap_put_text(index, "zstd");
    mcap_put_u64(index, compressed);
    mcap_put_u64(index, writer->chunk.count);
    mcap_end(index, begun);
    writer->chunks.count++;
}

void mcap_writer_cut(struct mcap_writer *writer)
{
    if (writer->chunk.failed)
        fail(writer, ENOMEM);
    else if (writer->chunk.count > 0)
        put_chunk_and_indexes(writer);
    writer->chunk.count = 0;
    hand_over(writer);
}

/* ---- summary --------------------------------------------------------------------------- */

static void put_data_end(struct mcap_writer *writer)
{
    struct mcap_bytes *out = &writer->out;
    size_t begun = mcap_begin(out, MCAP_DATA_END);

    mcap_put_u32(out, writer->crc);
    mcap_end(out, begun);
}

static void put_statistics(const struct mcap_writer *writer, struct group *statistics)
{
    struct mcap_bytes *records = &statistics->records;
    size_t begun = mcap_begin(records, MCAP_STATISTICS);

    mcap_put_u64(records, writer->messages);
    mcap_put_u16(records, (uint16_t)writer->schemas.count);
    mcap_put_u32(records, writer->channels.count);
    mcap_put_u32(records, 0); /* attachments */
    mcap_put_u32(records, writer->metadata.count);
    mcap_put_u32(records, writer->chunks.count);
    mcap_put_u64(records, writer->first_ns);
    mcap_put_u64(records, writer->last_ns);
    size_t map = mcap_begin_map(records);
    for (size_t i = 0; i < writer->channel_count; i++) {
        mcap_put_u16(records, writer->channel[i].id);
        mcap_put_u64(records, writer->channel[i].messages);
    }
    mcap_end_map(records, map);
    mcap_end(records, begun);
    statistics->count = 1;
}

static void put_group(struct mcap_writer *writer, const struct group *group,
                      struct mcap_bytes *offsets)
{
    uint64_t start = position(writer);

    if (group->records.failed)
        fail(writer, ENOMEM);
    if (group->count == 0)
        return;
    mcap_put(&writer->out, group->records.at, group->records.count);
    size_t begun = mcap_begin(offsets, MCAP_SUMMARY_OFFSET);
    mcap_put(offsets, group->records.at, 1); /* their opcode */
    mcap_put_u64(offsets, start);
    mcap_put_u64(offsets, group->records.count);
    mcap_end(offsets, begun);
}

static void put_groups(struct mcap_writer *writer, struct mcap_bytes *offsets)
{
    struct group statistics = {0};

    put_statistics(writer, &statistics);
    put_group(writer, &writer->schemas, offsets);
    put_group(writer, &writer->channels, offsets);
    put_group(writer, &statistics, offsets);
    put_group(writer, &writer->chunks, offsets);
    put_group(writer, &writer->metadata, offsets);
    mcap_bytes_free(&statistics.records);
}

static void put_summary(struct mcap_writer *writer)
{
    struct mcap_bytes *out = &writer->out;
    struct mcap_bytes offsets = {0};
    size_t from = out->count;
    uint64_t start = position(writer);

    put_groups(writer, &offsets);
    uint64_t offset_start = position(writer);
    mcap_put(out, offsets.at, offsets.count);
    if (offsets.failed)
        fail(writer, ENOMEM);
    mcap_bytes_free(&offsets);
    size_t begun = mcap_begin(out, MCAP_FOOTER);
    mcap_put_u64(out, start);
    mcap_put_u64(out, offset_start);
    mcap_put_u32(out, 0);
    mcap_end(out, begun);
    if (out->failed)
        return;
    out->count -= sizeof(uint32_t); /* the CRC is of all that is before it */
    mcap_put_u32(out, (uint32_t)crc32_z(0, out->at + from, out->count - from));
    mcap_put(out, MCAP_MAGIC, MCAP_MAGIC_BYTES);
}

static void destroy(struct mcap_writer *writer)
{
    mcap_bytes_free(&writer->out);
    mcap_bytes_free(&writer->chunk);
    mcap_bytes_free(&writer->schemas.records);
    mcap_bytes_free(&writer->channels.records);
    mcap_bytes_free(&writer->chunks.records);
    mcap_bytes_free(&writer->metadata.records);
    for (size_t i = 0; i < writer->channel_count; i++)
        mcap_bytes_free(&writer->channel[i].index);
    free(writer->channel);
    ZSTD_freeCCtx(writer->zstd);
    free(writer);
}

int mcap_writer_close(struct mcap_writer *writer)
{
    mcap_writer_cut(writer);
    put_data_end(writer);
    put_summary(writer);
    hand_over(writer);
    int wrong = writer->wrong;
    destroy(writer);
    return wrong;
}
