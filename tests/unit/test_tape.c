#define _GNU_SOURCE /* memmem() */
#include "tape.h"

#include "cassette.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

static char dir[] = "/tmp/muster-tape-XXXXXX";
static char file[64];
static char error[256];
static struct cassette cassette;

void setUp(void)
{
    strcpy(dir + strlen(dir) - 6, "XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(dir));
    snprintf(file, sizeof file, "%s/run.mcap", dir);
    error[0] = '\0';
    cassette_make(&cassette);
}

void tearDown(void)
{
    unlink(file);
    rmdir(dir);
}

static struct tape *open_tape(const char *path)
{
    struct tape *tape = tape_open(path, error, sizeof error);

    TEST_ASSERT_NOT_NULL_MESSAGE(tape, error);
    return tape;
}

/* What follows are messages `from` up to, but not with, `to`, and nothing else. */
static void assert_messages(struct tape *tape, size_t from, size_t to)
{
    struct tape_message message;

    for (size_t k = from; k < to; k++) {
        TEST_ASSERT_TRUE(tape_next(tape, &message));
        TEST_ASSERT_EQUAL_STRING(k % 2 == 0 ? "/even" : "/odd", message.topic);
        TEST_ASSERT_EQUAL_INT32(20 * k, message.time_ms);
        cassette_assert(k, message.bytes, message.count);
    }
    TEST_ASSERT_FALSE(tape_next(tape, &message));
    TEST_ASSERT_FALSE(tape_next(tape, &message));
}

static void test_a_runs_folder_or_its_file(void)
{
    const char *const paths[] = {dir, file};

    cassette_save(&cassette, file, cassette.count);
    for (size_t i = 0; i < 2; i++) {
        struct tape *tape = open_tape(paths[i]);
        const struct tape_about *about = tape_about(tape);

        TEST_ASSERT_EQUAL_STRING("two candidates", about->scenario);
        TEST_ASSERT_EQUAL_STRING("avr", about->robots);
        TEST_ASSERT_EQUAL_UINT64(12345678901234567890u, about->seed);
        TEST_ASSERT_EQUAL_DOUBLE(0.24, about->duration);
        TEST_ASSERT_TRUE(about->whole);
        assert_messages(tape, 0, CASSETTE_CHUNKS * CASSETTE_MESSAGES);
        tape_close(tape);
    }
}

/* Cut off at any of its bytes it has the messages of its whole chunks. */
static void test_torn_anywhere_it_gives_whole_chunks(void)
{
    size_t header = 8 + 9 + 8 + 4 + 8; /* magic, and the header: without them it is no recording */

    for (size_t count = 0; count < cassette.count; count++) {
        cassette_save(&cassette, file, count);
        if (count < header) {
            TEST_ASSERT_NULL(tape_open(file, error, sizeof error));
            TEST_ASSERT_NOT_NULL(strstr(error, "run.mcap is no MCAP file"));
            continue;
        }
        struct tape *tape = open_tape(file);
        TEST_ASSERT_FALSE(tape_about(tape)->whole);
        assert_messages(tape, 0, cassette_chunks(&cassette, count) * CASSETTE_MESSAGES);
        tape_close(tape);
    }
}

/* A chunk that is not what was written is left out; those behind it are there. */
static void test_a_damaged_chunk_is_left_out(void)
{
    cassette.bytes[cassette.chunk_end[0] - 3] ^= 0x10;
    cassette_save(&cassette, file, cassette.count);
    struct tape *tape = open_tape(file);

    assert_messages(tape, CASSETTE_MESSAGES, CASSETTE_CHUNKS * CASSETTE_MESSAGES);
    tape_close(tape);
}

/* By as many other bytes. */
static void replace(const char *words, const char *by)
{
    uint8_t *at = memmem(cassette.bytes, cassette.head, words, strlen(words));

    TEST_ASSERT_NOT_NULL(at);
    memcpy(at, by, strlen(words));
}

/* Words for people and for JSON, numbers that are some. */
static void test_what_it_says_of_itself_is_not_believed(void)
{
    replace("two candidates", "two\n\x1B[31m \xFF\xC3_e");
    replace("0.24", "-inf");
    cassette_save(&cassette, file, cassette.count);
    struct tape *tape = open_tape(file);

    TEST_ASSERT_EQUAL_STRING("two??[31m ??_e", tape_about(tape)->scenario);
    TEST_ASSERT_EQUAL_DOUBLE(0, tape_about(tape)->duration);
    tape_close(tape);
}

/* Any single byte that is another one: never a message that was not written. */
static void test_a_byte_that_is_wrong_never_becomes_a_message(void)
{
    struct tape_message message;

    for (size_t at = cassette.head; at < cassette.count; at++) {
        cassette.bytes[at] ^= 0x5A;
        cassette_save(&cassette, file, cassette.count);
        cassette.bytes[at] ^= 0x5A;
        struct tape *tape = tape_open(file, error, sizeof error);
        while (tape != NULL && tape_next(tape, &message))
            cassette_assert((size_t)message.time_ms / 20, message.bytes, message.count);
        tape_close(tape);
    }
}

static void test_what_is_no_recording_gives_words(void)
{
    TEST_ASSERT_NULL(tape_open(dir, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, "cannot read"));
    TEST_ASSERT_NOT_NULL(strstr(error, file));
    cassette.bytes[8 + 9 + 4] = 'R';
    cassette_save(&cassette, file, cassette.count);
    TEST_ASSERT_NULL(tape_open(file, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, "no recording of profile ros2"));
}

/* As other tools compress. */
static void test_a_compression_that_is_not_read_gives_words(void)
{
    memcpy(cassette.bytes + cassette.head + 9 + 28, "\4\0\0\0bzip", 8);
    cassette_save(&cassette, file, cassette.count);
    TEST_ASSERT_NULL(tape_open(file, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, "compressed by bzip: zstd is read"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_runs_folder_or_its_file);
    RUN_TEST(test_torn_anywhere_it_gives_whole_chunks);
    RUN_TEST(test_a_damaged_chunk_is_left_out);
    RUN_TEST(test_what_it_says_of_itself_is_not_believed);
    RUN_TEST(test_a_byte_that_is_wrong_never_becomes_a_message);
    RUN_TEST(test_what_is_no_recording_gives_words);
    RUN_TEST(test_a_compression_that_is_not_read_gives_words);
    return UNITY_END();
}
