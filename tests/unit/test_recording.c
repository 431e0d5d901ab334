#include "recording.h"

#include "recovery.h"
#include "tape.h"
#include "topic.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include <unity.h>

static char dir[] = "/tmp/muster-recording-XXXXXX";
static char file[64];
static char error[256];
static struct recording *recording;
static struct timespec now;

static const struct recording_about about = {
    .scenario = "two", .robots = "native", .seed = UINT64_MAX, .duration = 0.1};
static struct scene_robot robots[2] = {{.id = 1, .alive = true}, {.id = 2, .alive = true}};
static const struct scene_point vertices[2] = {{0, 0}, {1, 0}};

/* In place of the clock. */
int __wrap_clock_gettime(clockid_t clock, struct timespec *time);

int __wrap_clock_gettime(clockid_t clock, struct timespec *time)
{
    TEST_ASSERT_EQUAL_INT(CLOCK_MONOTONIC, clock);
    *time = now;
    return 0;
}

void setUp(void)
{
    strcpy(dir + strlen(dir) - 6, "XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(dir));
    snprintf(file, sizeof file, "%s/run.mcap", dir);
    error[0] = '\0';
    now = (struct timespec){100, 0};
}

void tearDown(void)
{
    unlink(file);
    rmdir(dir);
}

static void open_recording(void)
{
    recording = recording_open(dir, &about, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(recording, error);
}

static void close_recording(void)
{
    TEST_ASSERT_TRUE_MESSAGE(recording_close(recording, error, sizeof error), error);
}

static void record_scene(int32_t time_ms)
{
    struct scene scene = {
        .time_ms = time_ms,
        .robot_count = 2,
        .robots = robots,
        .vertex_count = 2,
        .vertices = vertices,
        .formation = "pair",
    };
    uint8_t bytes[1024];

    robots[0].x = time_ms / 1000.0;
    size_t count = scene_write(&scene, bytes, sizeof bytes);
    TEST_ASSERT_TRUE(count > 0);
    recording_scene(recording, &scene, bytes, count);
}

static void record_scenes(int32_t from_ms, int32_t to_ms)
{
    for (int32_t time_ms = from_ms; time_ms <= to_ms; time_ms += 20)
        record_scene(time_ms);
}

/* What of a topic is in the file by now: how many, and the last one's time. */
static size_t recorded(enum topic topic, int32_t *last_ms)
{
    struct tape *tape = tape_open(dir, error, sizeof error);
    struct tape_message message;
    size_t count = 0;

    TEST_ASSERT_NOT_NULL_MESSAGE(tape, error);
    while (tape_next(tape, &message)) {
        if (strcmp(message.topic, topic_kinds[topic].name) != 0)
            continue;
        count++;
        *last_ms = message.time_ms;
    }
    tape_close(tape);
    return count;
}

static void assert_recorded(size_t scenes)
{
    int32_t last_ms = -20;

    TEST_ASSERT_EQUAL_UINT(scenes, recorded(TOPIC_FLEET, &last_ms));
    TEST_ASSERT_EQUAL_INT32(20 * (int32_t)scenes - 20, last_ms);
}

static void test_half_a_second_of_the_mission_is_handed_over_at_once(void)
{
    open_recording();
    record_scenes(0, 480);
    assert_recorded(0);
    record_scene(500);
    assert_recorded(25);
    record_scenes(520, 980);
    assert_recorded(25);
    record_scene(1000);
    assert_recorded(50);
    close_recording();
    assert_recorded(51);
}

/* A run that is slower than half of real time. */
static void test_nothing_waits_longer_than_a_second(void)
{
    open_recording();
    record_scenes(0, 20);
    now.tv_nsec = 999999999;
    record_scene(40);
    assert_recorded(0);
    now.tv_sec++;
    record_scene(60);
    assert_recorded(3);
    record_scenes(80, 480);
    assert_recorded(3);
    record_scene(500);
    assert_recorded(25);
    close_recording();
}

static void test_a_flush_hands_over_all(void)
{
    open_recording();
    record_scenes(0, 100);
    recording_flush(recording);
    assert_recorded(6);
    close_recording();
}

static void test_every_topic_has_its_period(void)
{
    open_recording();
    record_scenes(0, 2000);
    close_recording();
    for (enum topic topic = 0; topic < TOPIC_COUNT; topic++) {
        int32_t period_ms = topic_kinds[topic].period_ms, last_ms = -1;

        TEST_ASSERT_EQUAL_UINT(period_ms > 0 ? 2000 / period_ms + 1 : 0, recorded(topic, &last_ms));
        TEST_ASSERT_EQUAL_INT32(period_ms > 0 ? 2000 - 2000 % period_ms : -1, last_ms);
    }
}

/* There is no time before t = 0 in the file; an event says itself when it was. */
static void test_what_was_before_the_mission(void)
{
    static const struct scene_event event = {-480, 2, "role", "C"};
    uint8_t bytes[SCENE_EVENT_MAX];
    int32_t last_ms = -1;
    size_t count = scene_event_write(&event, bytes, sizeof bytes);

    open_recording();
    record_scene(-20);
    recording_event(recording, event.time_ms, bytes, count);
    record_scene(0);
    close_recording();
    TEST_ASSERT_EQUAL_UINT(1, recorded(TOPIC_EVENTS, &last_ms));
    TEST_ASSERT_EQUAL_INT32(0, last_ms);
    assert_recorded(1);

    struct tape *tape = tape_open(dir, error, sizeof error);
    struct tape_message message;
    struct scene_event read;
    char words[SCENE_EVENT_MAX];
    TEST_ASSERT_TRUE(tape_next(tape, &message));
    TEST_ASSERT_EQUAL_STRING("/muster/events", message.topic);
    TEST_ASSERT_TRUE(scene_event_read(&read, words, message.bytes, message.count));
    TEST_ASSERT_EQUAL_INT32(-480, read.time_ms);
    tape_close(tape);
}

static void test_it_says_what_it_is_of(void)
{
    open_recording();
    close_recording();
    struct tape *tape = tape_open(dir, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(tape, error);
    TEST_ASSERT_EQUAL_STRING("two", tape_about(tape)->scenario);
    TEST_ASSERT_EQUAL_STRING("native", tape_about(tape)->robots);
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, tape_about(tape)->seed);
    TEST_ASSERT_EQUAL_DOUBLE(0.1, tape_about(tape)->duration);
    TEST_ASSERT_TRUE(tape_about(tape)->whole);
    tape_close(tape);
}

static size_t read_file(uint8_t *bytes, size_t room)
{
    FILE *in = fopen(file, "re");

    TEST_ASSERT_NOT_NULL(in);
    size_t count = fread(bytes, 1, room, in);
    TEST_ASSERT_TRUE(feof(in));
    fclose(in);
    return count;
}

/* However fast it went, if it was not slow. */
static void test_the_same_run_is_the_same_file(void)
{
    static uint8_t first[1 << 20], second[1 << 20];
    size_t count[2];

    for (int i = 0; i < 2; i++) {
        open_recording();
        for (int32_t time_ms = 0; time_ms <= 1200; time_ms += 20) {
            record_scene(time_ms);
            now.tv_nsec += i * 30000000;
            now.tv_sec += now.tv_nsec / 1000000000;
            now.tv_nsec %= 1000000000;
        }
        close_recording();
        count[i] = read_file(i == 0 ? first : second, sizeof first);
    }
    TEST_ASSERT_EQUAL_UINT(count[0], count[1]);
    TEST_ASSERT_EQUAL_INT(0, memcmp(first, second, count[0]));
}

static void test_nobody_makes_it_whole_meanwhile(void)
{
    struct recovery recovery;

    open_recording();
    record_scenes(0, 1000);
    TEST_ASSERT_EQUAL_INT(RECOVERY_REFUSED,
                          recovery_run(dir, NULL, &recovery, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, "is being written"));
    close_recording();
    TEST_ASSERT_EQUAL_INT(RECOVERY_DONE, recovery_run(dir, NULL, &recovery, error, sizeof error));
    TEST_ASSERT_TRUE(recovery.whole);
}

static void test_what_cannot_be_written_gives_words(void)
{
    TEST_ASSERT_EQUAL_INT(0, symlink("/dev/full", file));
    open_recording();
    record_scenes(0, 2000);
    TEST_ASSERT_FALSE(recording_close(recording, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, file));
    TEST_ASSERT_NOT_NULL(strstr(error, "No space left"));
    unlink(file);
    rmdir(dir);
    TEST_ASSERT_NULL(recording_open(dir, &about, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, "cannot write"));
    TEST_ASSERT_NOT_NULL(strstr(error, file));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_half_a_second_of_the_mission_is_handed_over_at_once);
    RUN_TEST(test_nothing_waits_longer_than_a_second);
    RUN_TEST(test_a_flush_hands_over_all);
    RUN_TEST(test_every_topic_has_its_period);
    RUN_TEST(test_what_was_before_the_mission);
    RUN_TEST(test_it_says_what_it_is_of);
    RUN_TEST(test_the_same_run_is_the_same_file);
    RUN_TEST(test_nobody_makes_it_whole_meanwhile);
    RUN_TEST(test_what_cannot_be_written_gives_words);
    return UNITY_END();
}
