#define _GNU_SOURCE /* memfd_create() */
#include "mcap_writer.h"

#include "cassette.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <unity.h>
#include <zlib.h>
#include <zstd.h>

static struct cassette cassette, again;

void setUp(void)
{
    cassette_make(&cassette);
}

void tearDown(void)
{
}

static uint64_t number_at(size_t at, size_t width)
{
    uint64_t value = 0;

    TEST_ASSERT_TRUE(at + width <= cassette.count);
    memcpy(&value, cassette.bytes + at, width);
    return value;
}

static uint32_t u32_at(size_t at)
{
    return (uint32_t)number_at(at, 4);
}

static uint64_t u64_at(size_t at)
{
    return number_at(at, 8);
}

static size_t next(size_t at)
{
    return at + MCAP_HEAD_BYTES + u64_at(at + 1);
}

/* The first record of its kind from there on. */
static size_t find(size_t at, enum mcap_opcode opcode)
{
    while (cassette.bytes[at] != opcode) {
        at = next(at);
        TEST_ASSERT_TRUE(at < cassette.count);
    }
    return at;
}

static size_t footer(void)
{
    return cassette.count - MCAP_END_BYTES;
}

static void test_the_records_come_in_their_order(void)
{
    static const uint8_t order[] = {
        MCAP_HEADER,         MCAP_METADATA,       MCAP_SCHEMA,         MCAP_CHANNEL,
        MCAP_CHANNEL,        MCAP_CHUNK,          MCAP_MESSAGE_INDEX,  MCAP_MESSAGE_INDEX,
        MCAP_CHUNK,          MCAP_MESSAGE_INDEX,  MCAP_MESSAGE_INDEX,  MCAP_CHUNK,
        MCAP_MESSAGE_INDEX,  MCAP_MESSAGE_INDEX,  MCAP_DATA_END,       MCAP_SCHEMA,
        MCAP_CHANNEL,        MCAP_CHANNEL,        MCAP_STATISTICS,     MCAP_CHUNK_INDEX,
        MCAP_CHUNK_INDEX,    MCAP_CHUNK_INDEX,    MCAP_METADATA_INDEX, MCAP_SUMMARY_OFFSET,
        MCAP_SUMMARY_OFFSET, MCAP_SUMMARY_OFFSET, MCAP_SUMMARY_OFFSET, MCAP_SUMMARY_OFFSET,
        MCAP_FOOTER};
    size_t at = MCAP_MAGIC_BYTES;

    for (size_t i = 0; i < sizeof order; i++, at = next(at))
        TEST_ASSERT_EQUAL_HEX8(order[i], cassette.bytes[at]);
    TEST_ASSERT_EQUAL_UINT(cassette.count - MCAP_MAGIC_BYTES, at);
    TEST_ASSERT_EQUAL_INT(0, memcmp(cassette.bytes, MCAP_MAGIC, MCAP_MAGIC_BYTES));
    TEST_ASSERT_EQUAL_INT(0, memcmp(cassette.bytes + at, MCAP_MAGIC, MCAP_MAGIC_BYTES));
}

/* The metadata's name is all that is in its index beside the place. */
static void test_definitions_are_laid_out_as_the_specification_says(void)
{
    static const char schema[] = "\x03\x34\0\0\0\0\0\0\0\x01\0\x13\0\0\0test_msgs/msg/Bytes"
                                 "\7\0\0\0ros2msg\x0c\0\0\0uint8[] data";
    static const char channel[] = "\x04\x34\0\0\0\0\0\0\0\7\0\1\0\5\0\0\0/even\3\0\0\0cdr"
                                  "\x1c\0\0\0\x14\0\0\0offered_qos_profiles\0\0\0\0";
    size_t metadata = find(MCAP_MAGIC_BYTES, MCAP_METADATA);
    size_t at = find(metadata, MCAP_SCHEMA);
    size_t indexed = find(metadata, MCAP_METADATA_INDEX);

    TEST_ASSERT_EQUAL_UINT(next(at) - at, sizeof schema - 1);
    TEST_ASSERT_EQUAL_MEMORY(schema, cassette.bytes + at, sizeof schema - 1);
    at = find(at, MCAP_CHANNEL);
    TEST_ASSERT_EQUAL_UINT(next(at) - at, sizeof channel - 1);
    TEST_ASSERT_EQUAL_MEMORY(channel, cassette.bytes + at, sizeof channel - 1);
    TEST_ASSERT_EQUAL_UINT(metadata, u64_at(indexed + 9));
    TEST_ASSERT_EQUAL_UINT(next(metadata) - metadata, u64_at(indexed + 17));
    TEST_ASSERT_EQUAL_UINT(6, u32_at(indexed + 25));
    TEST_ASSERT_EQUAL_MEMORY("muster", cassette.bytes + indexed + 29, 6);
    TEST_ASSERT_EQUAL_UINT(indexed + 35, next(indexed));
}

static void test_crcs_are_of_all_that_is_before_them(void)
{
    size_t end = find(MCAP_MAGIC_BYTES, MCAP_DATA_END), summary = next(end);
    uLong crc = crc32_z(0, cassette.bytes, end);

    TEST_ASSERT_EQUAL_HEX32(crc, u32_at(end + MCAP_HEAD_BYTES));
    crc = crc32_z(0, cassette.bytes + summary, footer() + MCAP_HEAD_BYTES + 16 - summary);
    TEST_ASSERT_EQUAL_HEX32(crc, u32_at(footer() + MCAP_HEAD_BYTES + 16));
    TEST_ASSERT_EQUAL_UINT(summary, u64_at(footer() + MCAP_HEAD_BYTES));
    TEST_ASSERT_EQUAL_UINT(find(summary, MCAP_SUMMARY_OFFSET),
                           u64_at(footer() + MCAP_HEAD_BYTES + 8));
}

/* Every group of the summary is where its offset says. */
static void test_the_summary_is_found_by_its_offsets(void)
{
    size_t at = u64_at(footer() + MCAP_HEAD_BYTES + 8);
    size_t expected = u64_at(footer() + MCAP_HEAD_BYTES);

    for (; at < footer(); at = next(at)) {
        TEST_ASSERT_EQUAL_HEX8(cassette.bytes[at + 9], cassette.bytes[expected]);
        TEST_ASSERT_EQUAL_UINT(expected, u64_at(at + 10));
        expected += u64_at(at + 18);
    }
    TEST_ASSERT_EQUAL_UINT(u64_at(footer() + MCAP_HEAD_BYTES + 8), expected);
}

static void test_the_statistics_count_everything(void)
{
    size_t at = find(find(MCAP_MAGIC_BYTES, MCAP_DATA_END), MCAP_STATISTICS) + MCAP_HEAD_BYTES;

    TEST_ASSERT_EQUAL_UINT(12, u64_at(at));
    TEST_ASSERT_EQUAL_UINT(1, number_at(at + 8, 2));
    TEST_ASSERT_EQUAL_UINT(2, u32_at(at + 10));
    TEST_ASSERT_EQUAL_UINT(0, u32_at(at + 14));
    TEST_ASSERT_EQUAL_UINT(1, u32_at(at + 18));
    TEST_ASSERT_EQUAL_UINT(CASSETTE_CHUNKS, u32_at(at + 22));
    TEST_ASSERT_EQUAL_UINT64(0, u64_at(at + 26));
    TEST_ASSERT_EQUAL_UINT64(220000000, u64_at(at + 34));
    TEST_ASSERT_EQUAL_UINT(20, u32_at(at + 42));
    TEST_ASSERT_EQUAL_UINT(7, number_at(at + 46, 2));
    TEST_ASSERT_EQUAL_UINT(6, u64_at(at + 48));
    TEST_ASSERT_EQUAL_UINT(9, number_at(at + 56, 2));
    TEST_ASSERT_EQUAL_UINT(6, u64_at(at + 58));
}

/* The chunk's records, of which `size` is their length. */
static void unpack(size_t chunk, uint8_t *records, size_t size)
{
    size_t at = chunk + MCAP_HEAD_BYTES;

    TEST_ASSERT_EQUAL_HEX8(MCAP_CHUNK, cassette.bytes[chunk]);
    TEST_ASSERT_EQUAL_UINT(size, u64_at(at + 16));
    TEST_ASSERT_EQUAL_MEMORY("\4\0\0\0zstd", cassette.bytes + at + 28, 8);
    size_t packed = u64_at(at + 36);
    TEST_ASSERT_EQUAL_UINT(next(chunk), at + 44 + packed);
    TEST_ASSERT_EQUAL_UINT(size, ZSTD_decompress(records, size, cassette.bytes + at + 44, packed));
    TEST_ASSERT_EQUAL_HEX32(crc32_z(0, records, size), u32_at(at + 24));
}

/* One channel's index in a chunk: two messages at the places where they are. */
static void look_at_messages(size_t at, unsigned channel, size_t first, const uint8_t *records)
{
    TEST_ASSERT_EQUAL_HEX8(MCAP_MESSAGE_INDEX, cassette.bytes[at]);
    TEST_ASSERT_EQUAL_UINT(channel, number_at(at + 9, 2));
    TEST_ASSERT_EQUAL_UINT(2 * 16, u32_at(at + 11));
    for (size_t i = 0; i < 2; i++) {
        size_t k = first + 2 * i;
        const uint8_t *message = records + u64_at(at + 15 + 16 * i + 8);
        uint64_t length, time_ns = u64_at(at + 15 + 16 * i);
        uint32_t sequence;

        TEST_ASSERT_EQUAL_UINT64(k * 20000000, time_ns);
        TEST_ASSERT_EQUAL_HEX8(MCAP_MESSAGE, message[0]);
        memcpy(&length, message + 1, sizeof length);
        memcpy(&sequence, message + 11, sizeof sequence);
        TEST_ASSERT_EQUAL_UINT(k / 2, sequence);
        TEST_ASSERT_EQUAL_UINT(channel, message[9]);
        TEST_ASSERT_EQUAL_INT(0, memcmp(message + 15, &time_ns, 8));
        TEST_ASSERT_EQUAL_INT(0, memcmp(message + 23, &time_ns, 8));
        cassette_assert(k, message + 31, length - 22);
    }
}

static void test_every_message_is_found_by_the_index(void)
{
    size_t at = find(find(MCAP_MAGIC_BYTES, MCAP_DATA_END), MCAP_CHUNK_INDEX);

    for (size_t i = 0; i < CASSETTE_CHUNKS; i++, at = next(at)) {
        uint8_t records[1024];
        size_t first = i * CASSETTE_MESSAGES, fields = at + MCAP_HEAD_BYTES;
        size_t chunk = u64_at(fields + 16), length = u64_at(fields + 24);

        TEST_ASSERT_EQUAL_UINT64(first * 20000000, u64_at(fields));
        TEST_ASSERT_EQUAL_UINT64((first + 3) * 20000000, u64_at(fields + 8));
        TEST_ASSERT_EQUAL_UINT(next(chunk), chunk + length);
        TEST_ASSERT_EQUAL_UINT(20, u32_at(fields + 32));
        TEST_ASSERT_EQUAL_UINT(7, number_at(fields + 36, 2));
        TEST_ASSERT_EQUAL_UINT(9, number_at(fields + 46, 2));
        TEST_ASSERT_EQUAL_UINT(2 * (MCAP_HEAD_BYTES + 6 + 32), u64_at(fields + 56));
        TEST_ASSERT_EQUAL_MEMORY("\4\0\0\0zstd", cassette.bytes + fields + 64, 8);
        TEST_ASSERT_EQUAL_UINT(length - MCAP_HEAD_BYTES - 44, u64_at(fields + 72));
        unpack(chunk, records, u64_at(fields + 80));
        look_at_messages(u64_at(fields + 38), 7, first, records);
        look_at_messages(u64_at(fields + 48), 9, first + 1, records);
    }
}

static void test_what_is_given_is_the_same_file(void)
{
    cassette_make(&again);
    TEST_ASSERT_EQUAL_UINT(cassette.count, again.count);
    TEST_ASSERT_EQUAL_INT(0, memcmp(cassette.bytes, again.bytes, cassette.count));
}

static void test_definitions_are_written_once(void)
{
    int fd = memfd_create("mcap", 0);
    struct mcap_writer *writer = mcap_writer_open(fd);

    mcap_writer_header(writer, "ros2", "");
    for (int i = 0; i < 2; i++) {
        mcap_writer_schema(writer, 1, "a", "b", "c");
        mcap_writer_channel(writer, 1, 1, "/a", "cdr");
    }
    mcap_writer_cut(writer);
    off_t once = lseek(fd, 0, SEEK_CUR);
    mcap_writer_schema(writer, 1, "a", "b", "c");
    mcap_writer_channel(writer, 1, 1, "/a", "cdr");
    mcap_writer_cut(writer);
    TEST_ASSERT_EQUAL_INT64(once, lseek(fd, 0, SEEK_CUR));
    TEST_ASSERT_FALSE(mcap_writer_message(writer, 2, 0, (const uint8_t *)"x", 1));
    TEST_ASSERT_TRUE(mcap_writer_message(writer, 1, 0, (const uint8_t *)"x", 1));
    TEST_ASSERT_EQUAL_INT(0, mcap_writer_close(writer));
    close(fd);
}

static void write_megabytes(struct mcap_writer *writer, uint64_t count)
{
    uint8_t *bytes = calloc(1, 1 << 20);

    for (uint64_t i = 0; i < count; i++)
        TEST_ASSERT_TRUE(mcap_writer_message(writer, 1, i, bytes, 1 << 20));
    free(bytes);
}

static void test_a_chunk_does_not_grow_beyond_its_size(void)
{
    int fd = memfd_create("mcap", 0);
    struct mcap_writer *writer = mcap_writer_open(fd);

    mcap_writer_header(writer, "ros2", "");
    mcap_writer_channel(writer, 1, 0, "/a", "cdr");
    write_megabytes(writer, 3);
    TEST_ASSERT_EQUAL_INT64(0, lseek(fd, 0, SEEK_CUR));
    write_megabytes(writer, 1);
    TEST_ASSERT_TRUE(lseek(fd, 0, SEEK_CUR) > 0);
    TEST_ASSERT_EQUAL_INT(0, mcap_writer_close(writer));
    close(fd);
}

static void test_a_full_disk_is_told_at_the_end(void)
{
    int fd = open("/dev/full", O_WRONLY | O_CLOEXEC);
    struct mcap_writer *writer = mcap_writer_open(fd);

    mcap_writer_header(writer, "ros2", "");
    mcap_writer_channel(writer, 1, 0, "/a", "cdr");
    write_megabytes(writer, 9);
    TEST_ASSERT_EQUAL_INT(ENOSPC, mcap_writer_close(writer));
    close(fd);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_records_come_in_their_order);
    RUN_TEST(test_definitions_are_laid_out_as_the_specification_says);
    RUN_TEST(test_crcs_are_of_all_that_is_before_them);
    RUN_TEST(test_the_summary_is_found_by_its_offsets);
    RUN_TEST(test_the_statistics_count_everything);
    RUN_TEST(test_every_message_is_found_by_the_index);
    RUN_TEST(test_what_is_given_is_the_same_file);
    RUN_TEST(test_definitions_are_written_once);
    RUN_TEST(test_a_chunk_does_not_grow_beyond_its_size);
    RUN_TEST(test_a_full_disk_is_told_at_the_end);
    return UNITY_END();
}
