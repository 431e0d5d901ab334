/* test_replay.c: a recording that is shown: to our page all of it, to Foxglove's viewers in time.
 */
#include "foxglove.h"
#include "onlooker.h"
#include "recording.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <unity.h>

#define END_MS 300
#define SCENES (END_MS / TICK_MS + 1)
#define TIMES_MAX 10 /* that it is played */

static struct onlooker onlooker;
static char error[256];
static struct scene_robot robots[2] = {{.id = 1}, {.id = 2}};
static struct {
    uint8_t bytes[512];
    size_t count;
} scenes[SCENES];

static void record(struct recording *recording, int32_t time_ms)
{
    struct scene scene = {.time_ms = time_ms, .robot_count = 2, .robots = robots};
    struct scene_event event = {time_ms, 1, "test", "an event"};
    uint8_t log[SCENE_EVENT_MAX];
    size_t i = (size_t)(time_ms / TICK_MS);

    robots[0].x = time_ms / 1000.0;
    scenes[i].count = scene_write(&scene, scenes[i].bytes, sizeof scenes[i].bytes);
    TEST_ASSERT_TRUE(scenes[i].count > 0);
    recording_event(recording, time_ms, log, scene_event_write(&event, log, sizeof log));
    recording_scene(recording, &scene, scenes[i].bytes, scenes[i].count);
}

void setUp(void)
{
    static const struct recording_about about = {"pair", "native", 1, 0.5};

    onlooker_open(&onlooker);
    struct recording *recording = recording_open(onlooker.dir, &about, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(recording, error);
    for (int32_t time_ms = 0; time_ms <= END_MS; time_ms += TICK_MS)
        record(recording, time_ms);
    TEST_ASSERT_TRUE_MESSAGE(recording_close(recording, error, sizeof error), error);
}

void tearDown(void)
{
    onlooker_close(&onlooker);
}

static void replay(const char *protocol)
{
    onlooker_start(&onlooker, (const char *const[]){"replay", "--view=0", onlooker.dir, NULL});
    onlooker_join(&onlooker, protocol);
}

static void stop(void)
{
    process_signal(&onlooker.process, SIGTERM);
    TEST_ASSERT_EQUAL_INT(0, onlooker_end(&onlooker));
}

/* In this text or one of the next ones. */
static void wait_for(const char *words)
{
    char text[1024] = "";

    while (strstr(text, words) == NULL) {
        struct client_message message = onlooker_look(&onlooker);

        TEST_ASSERT_NOT_EQUAL(CLIENT_GONE, message.opcode);
        if (message.opcode == CLIENT_TEXT)
            snprintf(text, sizeof text, "%.*s", (int)message.count, (const char *)message.bytes);
    }
}

static void assert_all_seen(void)
{
    while (onlooker.scenes < SCENES || onlooker.events < SCENES)
        TEST_ASSERT_NOT_EQUAL(CLIENT_GONE, onlooker_look(&onlooker).opcode);
    for (size_t i = 0; i < SCENES; i++) {
        TEST_ASSERT_EQUAL_UINT(scenes[i].count, onlooker.seen[i].count);
        TEST_ASSERT_EQUAL_MEMORY(scenes[i].bytes, onlooker.seen[i].bytes, scenes[i].count);
    }
}

static void test_the_page_gets_all_of_it(void)
{
    replay("muster.view.v1");
    wait_for("\"kind\":\"replay\",\"title\":\"pair\",\"duration\":0.5,\"acts\":[]");
    wait_for("\"phase\":\"recorded\",\"paused\":false,\"over\":true");
    assert_all_seen();
    stop();
}

/* Without its end it is shown as well, and that is said. */
static void test_one_that_was_cut_short(void)
{
    char path[64];
    struct stat status;

    snprintf(path, sizeof path, "%s/run.mcap", onlooker.dir);
    TEST_ASSERT_EQUAL_INT(0, stat(path, &status));
    TEST_ASSERT_EQUAL_INT(0, truncate(path, status.st_size - 1));
    replay("muster.view.v1");
    wait_for("\"over\":true");
    assert_all_seen();
    stop();
    TEST_ASSERT_NOT_NULL(process_said(&onlooker.process, "was cut short, at t = 0.30 s"));
}

/* The time, in ms, of the next scene that a subscriber gets. */
static int32_t next_ms(void)
{
    struct client_message message;
    uint64_t ns;

    do
        message = client_receive(&onlooker.client);
    while (message.opcode != CLIENT_BINARY || message.bytes[0] != 1);
    memcpy(&ns, message.bytes + 5, sizeof ns);
    int32_t ms = (int32_t)(ns / 1000000);
    TEST_ASSERT_TRUE(ms <= END_MS);
    TEST_ASSERT_EQUAL_UINT(scenes[ms / TICK_MS].count, message.count - FOXGLOVE_HEAD);
    TEST_ASSERT_EQUAL_MEMORY(scenes[ms / TICK_MS].bytes, message.bytes + FOXGLOVE_HEAD,
                             message.count - FOXGLOVE_HEAD);
    return ms;
}

/* Forward from the scene of `last_ms` to the last one, of which there is time for a look. Returns
 * the first one of the next time. */
static int32_t play_on(int32_t last_ms, bool seen[SCENES])
{
    int32_t ms;

    seen[last_ms / TICK_MS] = true;
    while ((ms = next_ms()) > last_ms) {
        seen[ms / TICK_MS] = true;
        last_ms = ms;
    }
    TEST_ASSERT_EQUAL_INT32(END_MS, last_ms);
    return ms;
}

/* 30 scenes a second, if the machine has nothing else to do: were it not played in time, two or
 * three would be seen of it, each time the same. */
static void test_foxglove_sees_it_in_time_again_and_again(void)
{
    bool seen[SCENES] = {false};
    size_t count = 0;

    replay("foxglove.sdk.v1");
    client_send_text(&onlooker.client, "{\"op\":\"subscribe\",\"subscriptions\":"
                                       "[{\"id\":7,\"channelId\":1}]}");
    int32_t ms = play_on(next_ms(), seen);
    for (int times = 1; times < TIMES_MAX && count < SCENES / 2; times++) {
        ms = play_on(ms, seen);
        count = 0;
        for (size_t i = 0; i < SCENES; i++)
            count += seen[i];
    }
    TEST_ASSERT_GREATER_OR_EQUAL_UINT(SCENES / 2, count);
    stop();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_page_gets_all_of_it);
    RUN_TEST(test_one_that_was_cut_short);
    RUN_TEST(test_foxglove_sees_it_in_time_again_and_again);
    return UNITY_END();
}
