#include "recovery.h"

#include "cassette.h"
#include "tape.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <unity.h>

static char dir[] = "/tmp/muster-recovery-XXXXXX";
static char file[64], beside[64], other[64];
static char error[256];
static struct cassette cassette;
static struct recovery recovery;

static int synced; /* times that the disk had to have it */

/* In place of the system's, which takes its time. */
int __wrap_fsync(int fd);

int __wrap_fsync(int fd)
{
    (void)fd;
    synced++;
    return 0;
}

void setUp(void)
{
    strcpy(dir + strlen(dir) - 6, "XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(dir));
    snprintf(file, sizeof file, "%s/run.mcap", dir);
    snprintf(beside, sizeof beside, "%s/run.mcap.part", dir);
    snprintf(other, sizeof other, "%s/other.mcap", dir);
    error[0] = '\0';
    cassette_make(&cassette);
}

void tearDown(void)
{
    unlink(file);
    unlink(other);
    unlink(beside);
    rmdir(dir);
}

static void recover(const char *path, const char *out)
{
    enum recovery_end end = recovery_run(path, out, &recovery, error, sizeof error);

    TEST_ASSERT_EQUAL_INT_MESSAGE(RECOVERY_DONE, end, error);
    TEST_ASSERT_TRUE(access(beside, F_OK) != 0);
}

static void assert_messages(const char *path, size_t from, size_t to)
{
    struct tape *tape = tape_open(path, error, sizeof error);
    struct tape_message message;

    TEST_ASSERT_NOT_NULL_MESSAGE(tape, error);
    TEST_ASSERT_TRUE(tape_about(tape)->whole);
    TEST_ASSERT_EQUAL_STRING(from + to > 0 ? "two candidates" : tape_about(tape)->scenario,
                             tape_about(tape)->scenario);
    for (size_t k = from; k < to; k++) {
        TEST_ASSERT_TRUE(tape_next(tape, &message));
        TEST_ASSERT_EQUAL_STRING(k % 2 == 0 ? "/even" : "/odd", message.topic);
        cassette_assert(k, message.bytes, message.count);
    }
    TEST_ASSERT_FALSE(tape_next(tape, &message));
    tape_close(tape);
}

static void assert_original(const char *path)
{
    static uint8_t bytes[CASSETTE_ROOM];
    FILE *in = fopen(path, "re");

    TEST_ASSERT_NOT_NULL(in);
    TEST_ASSERT_EQUAL_UINT(cassette.count, fread(bytes, 1, sizeof bytes, in));
    fclose(in);
    TEST_ASSERT_EQUAL_INT(0, memcmp(cassette.bytes, bytes, cassette.count));
}

/* What comes behind the last chunk can be made of it: the file is then as it would have been. */
static void test_torn_anywhere_it_is_made_whole(void)
{
    for (size_t count = 8 + 9 + 8 + 4 + 8; count < cassette.count; count++) {
        size_t chunks = cassette_chunks(&cassette, count);

        cassette_save(&cassette, file, count);
        recover(dir, NULL);
        TEST_ASSERT_FALSE(recovery.whole);
        TEST_ASSERT_EQUAL_UINT(0, recovery.damaged);
        TEST_ASSERT_EQUAL_UINT(chunks * CASSETTE_MESSAGES, recovery.messages);
        TEST_ASSERT_EQUAL_DOUBLE(chunks > 0 ? (chunks * CASSETTE_MESSAGES - 1) * 0.02 : 0,
                                 recovery.seconds);
        assert_messages(file, 0, chunks * CASSETTE_MESSAGES);
        if (chunks == CASSETTE_CHUNKS)
            assert_original(file);
        recover(file, NULL);
        TEST_ASSERT_TRUE(recovery.whole);
    }
}

static void test_a_whole_file_is_left_alone(void)
{
    struct stat before, after;

    cassette_save(&cassette, file, cassette.count);
    stat(file, &before);
    recover(dir, NULL);
    stat(file, &after);
    TEST_ASSERT_TRUE(recovery.whole);
    TEST_ASSERT_EQUAL_UINT(CASSETTE_CHUNKS * CASSETTE_MESSAGES, recovery.messages);
    TEST_ASSERT_EQUAL_DOUBLE(0.22, recovery.seconds);
    TEST_ASSERT_EQUAL_UINT64(before.st_ino, after.st_ino);
    TEST_ASSERT_EQUAL_INT64(before.st_mtim.tv_nsec, after.st_mtim.tv_nsec);
}

/* The file, before it takes the other's place, and then that it did. */
static void test_the_disk_has_it(void)
{
    cassette_save(&cassette, file, cassette.count - 1);
    synced = 0;
    recover(file, NULL);
    TEST_ASSERT_EQUAL_INT(2, synced);
}

static void test_another_file_leaves_this_one_alone(void)
{
    cassette_save(&cassette, file, cassette.chunk_end[1]);
    recover(file, other);
    assert_messages(other, 0, 2 * CASSETTE_MESSAGES);
    recover(file, NULL);
    TEST_ASSERT_FALSE(recovery.whole);
    recover(file, other);
    TEST_ASSERT_TRUE(recovery.whole);
    assert_messages(other, 0, 2 * CASSETTE_MESSAGES);
}

static void test_damaged_chunks_are_left_out_and_counted(void)
{
    cassette.bytes[cassette.chunk_end[1] - 3] ^= 0x10;
    cassette_save(&cassette, file, cassette.count);
    recover(file, NULL);
    TEST_ASSERT_FALSE(recovery.whole);
    TEST_ASSERT_EQUAL_UINT(1, recovery.damaged);
    TEST_ASSERT_EQUAL_UINT(2 * CASSETTE_MESSAGES, recovery.messages);
    recover(file, NULL);
    TEST_ASSERT_TRUE(recovery.whole);
}

/* Where the next record would begin is not known then. */
static void test_nothing_is_taken_from_behind_a_length_that_cannot_be(void)
{
    cassette.bytes[cassette.head + 8] = 0x40; /* the first chunk's, its highest byte */
    cassette_save(&cassette, file, cassette.count);
    recover(file, NULL);
    TEST_ASSERT_EQUAL_UINT(0, recovery.messages);
}

/* The summary alone is damaged. */
static void test_a_wrong_crc_is_made_good(void)
{
    size_t crc = cassette.count - 8 - 4;

    cassette.bytes[crc] ^= 1;
    cassette_save(&cassette, file, cassette.count);
    cassette.bytes[crc] ^= 1;
    recover(file, NULL);
    TEST_ASSERT_FALSE(recovery.whole);
    assert_original(file);
}

/* In an index, which is not read: the data's CRC is wrong. */
static void test_a_wrong_byte_between_chunks_is_noticed(void)
{
    size_t at = cassette.chunk_end[0] + 9 + 8;

    cassette.bytes[at] ^= 1;
    cassette_save(&cassette, file, cassette.count);
    cassette.bytes[at] ^= 1;
    recover(file, NULL);
    TEST_ASSERT_FALSE(recovery.whole);
    assert_original(file);
}

static void assert_not(enum recovery_end expected, const char *out, const char *words)
{
    enum recovery_end end = recovery_run(file, out, &recovery, error, sizeof error);

    TEST_ASSERT_EQUAL_INT(expected, end);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, words), error);
}

static void test_one_that_is_being_written_is_refused(void)
{
    cassette_save(&cassette, file, cassette.chunk_end[1]);
    int fd = open(file, O_WRONLY | O_CLOEXEC);

    TEST_ASSERT_EQUAL_INT(0, flock(fd, LOCK_EX));
    assert_not(RECOVERY_REFUSED, NULL, "run.mcap is being written");
    close(fd);
    recover(file, NULL);
}

static void test_what_cannot_be_done_gives_words(void)
{
    char nowhere[128];

    assert_not(RECOVERY_REFUSED, NULL, "cannot read");
    cassette_save(&cassette, file, 20);
    assert_not(RECOVERY_REFUSED, NULL, "run.mcap is no MCAP file");
    TEST_ASSERT_TRUE(access(beside, F_OK) != 0);
    cassette_save(&cassette, file, cassette.chunk_end[1]);
    snprintf(nowhere, sizeof nowhere, "%s/none/run.mcap", dir);
    assert_not(RECOVERY_FAILED, nowhere, "cannot write");
}

static void test_what_is_no_file_is_not_replaced(void)
{
    struct stat status;

    cassette_save(&cassette, file, cassette.chunk_end[1]);
    TEST_ASSERT_EQUAL_INT(0, mkfifo(other, 0600));
    assert_not(RECOVERY_FAILED, other, "other.mcap");
    TEST_ASSERT_EQUAL_INT(0, stat(other, &status));
    TEST_ASSERT_TRUE(S_ISFIFO(status.st_mode));
}

/* A disk that is full leaves the file as it was. */
static void test_a_full_disk_costs_nothing(void)
{
    cassette_save(&cassette, file, cassette.chunk_end[1]);
    TEST_ASSERT_EQUAL_INT(0, symlink("/dev/full", beside));
    assert_not(RECOVERY_FAILED, NULL, "run.mcap.part: No space left on device");
    recover(file, NULL);
    assert_messages(file, 0, 2 * CASSETTE_MESSAGES);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_torn_anywhere_it_is_made_whole);
    RUN_TEST(test_a_whole_file_is_left_alone);
    RUN_TEST(test_the_disk_has_it);
    RUN_TEST(test_another_file_leaves_this_one_alone);
    RUN_TEST(test_damaged_chunks_are_left_out_and_counted);
    RUN_TEST(test_nothing_is_taken_from_behind_a_length_that_cannot_be);
    RUN_TEST(test_a_wrong_crc_is_made_good);
    RUN_TEST(test_a_wrong_byte_between_chunks_is_noticed);
    RUN_TEST(test_one_that_is_being_written_is_refused);
    RUN_TEST(test_what_cannot_be_done_gives_words);
    RUN_TEST(test_what_is_no_file_is_not_replaced);
    RUN_TEST(test_a_full_disk_costs_nothing);
    return UNITY_END();
}
