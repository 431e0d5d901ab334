#include "mcap_reader.h"

#include "cursor.h"
#include "mcap_bytes.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>
#include <zstd.h>

struct mcap_reader {
    FILE *file;
    uint64_t size, left;        /* of the file, and of that what has not been read */
    uint32_t crc;               /* of what has been read of this section */
    uint32_t crc_before;        /* the same without the last record */
    bool headed;                /* the header has been read */
    bool ended;                 /* so has the data's end: the summary follows */
    uint64_t summary;           /* where that begins */
    struct mcap_bytes contents; /* of the record */
    struct mcap_bytes records;  /* of the chunk */
    struct cursor chunk;        /* what is left of them */
    bool in_chunk;
    size_t damaged;
    ZSTD_DCtx *zstd;
    char words[128];
};

struct mcap_reader *mcap_reader_open(FILE *file)
{
    struct mcap_reader *reader = calloc(1, sizeof *reader);

    if (reader == NULL)
        return NULL;
    reader->zstd = ZSTD_createDCtx();
    off_t size = fseeko(file, 0, SEEK_END) == 0 ? ftello(file) : -1;
    if (reader->zstd == NULL || size < 0 || fseeko(file, 0, SEEK_SET) != 0) {
        mcap_reader_close(reader);
        return NULL;
    }
    reader->file = file;
    reader->size = reader->left = (uint64_t)size;
    return reader;
}

void mcap_reader_close(struct mcap_reader *reader)
{
    if (reader == NULL)
        return;
    mcap_bytes_free(&reader->contents);
    mcap_bytes_free(&reader->records);
    ZSTD_freeDCtx(reader->zstd);
    free(reader);
}

size_t mcap_reader_damaged(const struct mcap_reader *reader)
{
    return reader->damaged;
}

const char *mcap_reader_words(const struct mcap_reader *reader)
{
    return reader->words;
}

static enum mcap_news fail(struct mcap_reader *reader, enum mcap_news news, const char *words)
{
    snprintf(reader->words, sizeof reader->words, "%s", words);
    return news;
}

bool mcap_reader_has_end(const struct mcap_reader *reader)
{
    static const uint8_t head[MCAP_HEAD_BYTES] = {MCAP_FOOTER, MCAP_FOOTER_BYTES};
    uint8_t end[MCAP_END_BYTES];
    off_t back = ftello(reader->file);

    if (reader->size < sizeof end || back < 0)
        return false;
    bool read = fseeko(reader->file, -(off_t)sizeof end, SEEK_END) == 0 &&
                fread(end, sizeof end, 1, reader->file) == 1;
    return fseeko(reader->file, back, SEEK_SET) == 0 && read &&
           memcmp(end, head, sizeof head) == 0 &&
           memcmp(end + sizeof end - MCAP_MAGIC_BYTES, MCAP_MAGIC, MCAP_MAGIC_BYTES) == 0;
}

/* ---- what is in a record --------------------------------------------------------------- */

static struct mcap_text text(struct cursor *cursor)
{
    size_t length = cursor_u32_le(cursor);
    const uint8_t *at = cursor_bytes(cursor, length);

    return (struct mcap_text){(const char *)at, at != NULL ? length : 0};
}

bool mcap_pair(struct mcap_text *map, struct mcap_text *key, struct mcap_text *value)
{
    struct cursor cursor = cursor_over(map->at, map->length);

    *key = text(&cursor);
    *value = text(&cursor);
    *map = (struct mcap_text){(const char *)cursor.at, cursor.left};
    return cursor_good(&cursor);
}

static void read_message(struct cursor *cursor, struct mcap_record *record)
{
    record->id = cursor_u16_le(cursor);
    cursor_u32_le(cursor); /* its number */
    record->time_ns = cursor_u64_le(cursor);
    cursor_u64_le(cursor);
    record->data_count = cursor->left;
    record->data = cursor_bytes(cursor, cursor->left);
}

static bool is_told(enum mcap_opcode opcode, bool in_chunk)
{
    return opcode == MCAP_SCHEMA || opcode == MCAP_CHANNEL || opcode == MCAP_MESSAGE ||
           (opcode == MCAP_METADATA && !in_chunk);
}

/* False when it is none. */
static bool read_record(enum mcap_opcode opcode, struct cursor contents, struct mcap_record *record)
{
    struct cursor *cursor = &contents;

    *record = (struct mcap_record){opcode, .contents = contents.at, .count = contents.left};
    if (opcode == MCAP_MESSAGE) {
        read_message(cursor, record);
        return cursor_good(cursor);
    }
    if (opcode == MCAP_SCHEMA || opcode == MCAP_CHANNEL)
        record->id = cursor_u16_le(cursor);
    if (opcode == MCAP_CHANNEL)
        cursor_u16_le(cursor); /* its schema */
    record->name = text(cursor);
    record->value = text(cursor);
    if (opcode == MCAP_SCHEMA || opcode == MCAP_CHANNEL)
        text(cursor); /* the definition; the map */
    return cursor_good(cursor);
}

/* ---- chunks ---------------------------------------------------------------------------- */

static enum mcap_opcode next_in_chunk(struct cursor *chunk, struct cursor *contents)
{
    enum mcap_opcode opcode = cursor_u8(chunk);
    uint64_t length = cursor_u64_le(chunk);

    *contents = cursor_part(chunk, length);
    return opcode;
}

static bool is_good(struct cursor chunk)
{
    struct cursor contents;
    struct mcap_record record;

    while (chunk.left > 0) {
        enum mcap_opcode opcode = next_in_chunk(&chunk, &contents);
        if (!cursor_good(&chunk) ||
            (is_told(opcode, true) && !read_record(opcode, contents, &record)))
            return false;
    }
    return true;
}

struct chunk {
    uint64_t size;
    uint32_t crc;
    struct mcap_text compression;
    const uint8_t *bytes;
    size_t count;
};

static bool read_chunk(struct cursor cursor, struct chunk *chunk)
{
    cursor_u64_le(&cursor); /* first and last time */
    cursor_u64_le(&cursor);
    chunk->size = cursor_u64_le(&cursor);
    chunk->crc = cursor_u32_le(&cursor);
    chunk->compression = text(&cursor);
    chunk->count = cursor_u64_le(&cursor);
    chunk->bytes = cursor_bytes(&cursor, chunk->count);
    return cursor_good(&cursor) && chunk->size <= MCAP_CHUNK_MAX;
}

static bool is_text(const struct mcap_text *text, const char *word)
{
    return text->length == strlen(word) && memcmp(text->at, word, text->length) == 0;
}

static bool unpack(struct mcap_reader *reader, const struct chunk *chunk, uint8_t *records)
{
    if (chunk->compression.length > 0)
        return ZSTD_decompressDCtx(reader->zstd, records, chunk->size, chunk->bytes,
                                   chunk->count) == chunk->size;
    if (chunk->count != chunk->size)
        return false;
    memcpy(records, chunk->bytes, chunk->count);
    return true;
}

static bool is_whole(struct mcap_reader *reader, const struct chunk *chunk, uint8_t *records)
{
    return unpack(reader, chunk, records) &&
           (chunk->crc == 0 || chunk->crc == crc32_z(0, records, chunk->size)) &&
           is_good(cursor_over(records, chunk->size));
}

/* Begins a chunk, if it is good. */
static enum mcap_news open_chunk(struct mcap_reader *reader, struct cursor contents)
{
    struct chunk chunk;

    if (!read_chunk(contents, &chunk)) {
        reader->damaged++;
        return MCAP_RECORD;
    }
    if (chunk.compression.length > 0 && !is_text(&chunk.compression, "zstd")) {
        snprintf(reader->words, sizeof reader->words,
                 "has chunks compressed by %.*s: zstd is read, and what is not compressed",
                 (int)(chunk.compression.length < 16 ? chunk.compression.length : 16),
                 chunk.compression.at);
        return MCAP_REFUSED;
    }
    uint8_t *records = mcap_reserve(&reader->records, chunk.size > 0 ? chunk.size : 1);
    if (records == NULL)
        return fail(reader, MCAP_FAILED, "is more than there is memory for");
    reader->chunk = cursor_over(records, chunk.size);
    reader->in_chunk = is_whole(reader, &chunk, records);
    reader->damaged += !reader->in_chunk;
    return MCAP_RECORD;
}

/* ---- the file -------------------------------------------------------------------------- */

static bool get(struct mcap_reader *reader, uint8_t *bytes, size_t count)
{
    if (count > reader->left || fread(bytes, 1, count, reader->file) != count)
        return false;
    reader->left -= count;
    reader->crc = (uint32_t)crc32_z(reader->crc, bytes, count);
    return true;
}

static enum mcap_news torn(struct mcap_reader *reader)
{
    return ferror(reader->file) ? fail(reader, MCAP_FAILED, "cannot be read") : MCAP_TORN;
}

/* The next record of the file, into `contents`. */
static enum mcap_news get_record(struct mcap_reader *reader, enum mcap_opcode *opcode)
{
    uint8_t head[MCAP_HEAD_BYTES];

    reader->crc_before = reader->crc;
    if (!get(reader, head, sizeof head))
        return torn(reader);
    struct cursor cursor = cursor_over(head, sizeof head);
    *opcode = cursor_u8(&cursor);
    uint64_t length = cursor_u64_le(&cursor);
    if (*opcode == 0 || length > reader->left)
        return MCAP_TORN;
    reader->contents.count = 0;
    uint8_t *at = mcap_reserve(&reader->contents, length > 0 ? length : 1);
    if (at == NULL)
        return fail(reader, MCAP_FAILED, "is more than there is memory for");
    if (!get(reader, at, length))
        return torn(reader);
    reader->contents.count = length;
    return MCAP_RECORD;
}

/* The magic and the header. */
static enum mcap_news begin(struct mcap_reader *reader, struct mcap_record *record)
{
    uint8_t magic[MCAP_MAGIC_BYTES];
    enum mcap_opcode opcode;

    if (!get(reader, magic, sizeof magic) || memcmp(magic, MCAP_MAGIC, sizeof magic) != 0 ||
        get_record(reader, &opcode) != MCAP_RECORD || opcode != MCAP_HEADER ||
        !read_record(opcode, cursor_over(reader->contents.at, reader->contents.count), record))
        return fail(reader, MCAP_REFUSED, "is no MCAP file");
    reader->headed = true;
    return MCAP_RECORD;
}

/* The data's end: its CRC is of everything before it. */
static enum mcap_news end_data(struct mcap_reader *reader, struct cursor contents)
{
    uint32_t crc = cursor_u32_le(&contents);

    if (!cursor_good(&contents) || (crc != 0 && crc != reader->crc_before))
        return MCAP_TORN;
    reader->ended = true;
    reader->summary = reader->size - reader->left;
    reader->crc = 0;
    return MCAP_RECORD;
}

/* The footer's CRC is of the summary and of itself up to there. */
static enum mcap_news end_file(struct mcap_reader *reader, struct cursor contents)
{
    uint8_t magic[MCAP_MAGIC_BYTES];
    uint32_t now = (uint32_t)crc32_z(
        reader->crc_before, (const uint8_t[MCAP_HEAD_BYTES]){MCAP_FOOTER, MCAP_FOOTER_BYTES},
        MCAP_HEAD_BYTES);

    if (!reader->ended || contents.left != MCAP_FOOTER_BYTES)
        return MCAP_TORN;
    now = (uint32_t)crc32_z(now, contents.at, MCAP_FOOTER_BYTES - sizeof now);
    uint64_t summary = cursor_u64_le(&contents);
    cursor_u64_le(&contents);
    uint32_t crc = cursor_u32_le(&contents);
    if ((summary != 0 && summary != reader->summary) || (crc != 0 && crc != now) ||
        !get(reader, magic, sizeof magic) || memcmp(magic, MCAP_MAGIC, sizeof magic) != 0 ||
        reader->left != 0)
        return MCAP_TORN;
    return MCAP_WHOLE;
}

/* MCAP_RECORD without an opcode: nothing that is told of. */
static enum mcap_news look_at(struct mcap_reader *reader, enum mcap_opcode opcode,
                              struct mcap_record *record)
{
    struct cursor contents = cursor_over(reader->contents.at, reader->contents.count);

    *record = (struct mcap_record){0};
    if (opcode == MCAP_FOOTER)
        return end_file(reader, contents);
    if (reader->ended)
        return MCAP_RECORD;
    if (opcode == MCAP_DATA_END)
        return end_data(reader, contents);
    if (opcode == MCAP_CHUNK)
        return open_chunk(reader, contents);
    if (opcode == MCAP_HEADER || (is_told(opcode, false) && !read_record(opcode, contents, record)))
        return MCAP_TORN;
    return MCAP_RECORD;
}

static enum mcap_news next_of_chunk(struct mcap_reader *reader, struct mcap_record *record)
{
    struct cursor contents;

    while (reader->chunk.left > 0) {
        enum mcap_opcode opcode = next_in_chunk(&reader->chunk, &contents);
        if (is_told(opcode, true) && read_record(opcode, contents, record))
            return MCAP_RECORD;
    }
    reader->in_chunk = false;
    return MCAP_CUT;
}

enum mcap_news mcap_reader_next(struct mcap_reader *reader, struct mcap_record *record)
{
    enum mcap_opcode opcode;
    enum mcap_news news;

    if (reader->in_chunk)
        return next_of_chunk(reader, record);
    if (!reader->headed)
        return begin(reader, record);
    do {
        news = get_record(reader, &opcode);
        if (news == MCAP_RECORD)
            news = look_at(reader, opcode, record);
        if (reader->in_chunk)
            return next_of_chunk(reader, record);
    } while (news == MCAP_RECORD && record->opcode == 0);
    return news;
}
