#define _GNU_SOURCE /* memfd_create() */
#include "cassette.h"

#include "mcap_writer.h"

#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <unity.h>

static void write_head(struct mcap_writer *writer)
{
    static const char *const pairs[] = {"scenario", "two candidates",       "robots",   "avr",
                                        "seed",     "12345678901234567890", "duration", "0.24"};

    mcap_writer_header(writer, "ros2", "cassette");
    mcap_writer_metadata(writer, "muster", pairs, 4);
    mcap_writer_schema(writer, 1, "test_msgs/msg/Bytes", "ros2msg", "uint8[] data");
    mcap_writer_channel(writer, 7, 1, "/even", "cdr");
    mcap_writer_channel(writer, 9, 1, "/odd", "cdr");
    mcap_writer_cut(writer);
}

static void write_message(struct mcap_writer *writer, size_t k)
{
    uint8_t bytes[64];

    memset(bytes, (int)k, sizeof bytes);
    TEST_ASSERT_TRUE(mcap_writer_message(writer, k % 2 == 0 ? 7 : 9, k * 20000000, bytes, k + 1));
}

/* Of the record that begins there. */
static size_t end_of_record(const struct cassette *cassette, size_t at)
{
    uint64_t length;

    memcpy(&length, cassette->bytes + at + 1, sizeof length);
    return at + MCAP_HEAD_BYTES + length;
}

void cassette_make(struct cassette *cassette)
{
    int fd = memfd_create("cassette", 0);
    struct mcap_writer *writer = mcap_writer_open(fd);

    TEST_ASSERT_NOT_NULL(writer);
    write_head(writer);
    cassette->head = (size_t)lseek(fd, 0, SEEK_CUR);
    size_t starts[CASSETTE_CHUNKS];
    for (size_t i = 0; i < CASSETTE_CHUNKS; i++) {
        starts[i] = (size_t)lseek(fd, 0, SEEK_CUR);
        for (size_t k = 0; k < CASSETTE_MESSAGES; k++)
            write_message(writer, i * CASSETTE_MESSAGES + k);
        mcap_writer_cut(writer);
    }
    TEST_ASSERT_EQUAL_INT(0, mcap_writer_close(writer));
    ssize_t count = pread(fd, cassette->bytes, sizeof cassette->bytes, 0);
    close(fd);
    TEST_ASSERT_TRUE(count > 0 && count < CASSETTE_ROOM);
    cassette->count = (size_t)count;
    for (size_t i = 0; i < CASSETTE_CHUNKS; i++)
        cassette->chunk_end[i] = end_of_record(cassette, starts[i]);
}

void cassette_save(const struct cassette *cassette, const char *path, size_t count)
{
    unlink(path); /* what is cut to nothing and written anew the system waits for the disk with */
    FILE *file = fopen(path, "we");

    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_EQUAL_UINT(count, fwrite(cassette->bytes, 1, count, file));
    TEST_ASSERT_EQUAL_INT(0, fclose(file));
}

size_t cassette_chunks(const struct cassette *cassette, size_t count)
{
    size_t chunks = 0;

    while (chunks < CASSETTE_CHUNKS && cassette->chunk_end[chunks] <= count)
        chunks++;
    return chunks;
}

void cassette_assert(size_t k, const uint8_t *bytes, size_t count)
{
    TEST_ASSERT_EQUAL_UINT(k + 1, count);
    for (size_t i = 0; i < count; i++)
        TEST_ASSERT_EQUAL_UINT(k, bytes[i]);
}
