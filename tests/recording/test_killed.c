/* test_killed.c: a run that is killed in its middle, in real time, while somebody looks on: what he
 * has seen is in the recording but for its last half second, once it has been recovered. */
#include "onlooker.h"
#include "tape.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

/* Just before something is handed over, when most is lost. */
#define KILL_MS 2480

/* Between one handing over and the next; a second is what is promised. */
#define LOST_MS 500

/* A second of the clock on the wall, in which a run that was held up may make up for that. */
#define TRACE_LOST_MS 1200

static struct onlooker onlooker;
static char out[64];
static char error[256];

void setUp(void)
{
    onlooker_open(&onlooker);
    snprintf(out, sizeof out, "%s/run", onlooker.dir);
}

void tearDown(void)
{
    onlooker_close(&onlooker);
}

static void look_and_kill(void)
{
    enum client_opcode opcode = CLIENT_TEXT;

    while (onlooker.seen_ms < KILL_MS && opcode != CLIENT_GONE)
        opcode = onlooker_look(&onlooker).opcode;
    process_signal(&onlooker.process, SIGKILL);
    while (opcode != CLIENT_GONE)
        opcode = onlooker_look(&onlooker).opcode;
    TEST_ASSERT_EQUAL_INT(-SIGKILL, onlooker_end(&onlooker));
}

static struct tape *open_tape(bool whole)
{
    struct tape *tape = tape_open(out, error, sizeof error);

    TEST_ASSERT_NOT_NULL_MESSAGE(tape, error);
    TEST_ASSERT_EQUAL_INT(whole, tape_about(tape)->whole);
    return tape;
}

static void assert_as_seen(const struct tape_message *message)
{
    TEST_ASSERT_TRUE(message->time_ms < TICKS * TICK_MS);
    const struct seen *scene = &onlooker.seen[message->time_ms / TICK_MS];

    if (scene->bytes == NULL)
        return;
    TEST_ASSERT_EQUAL_UINT(scene->count, message->count);
    TEST_ASSERT_EQUAL_INT(0, memcmp(scene->bytes, message->bytes, message->count));
}

/* There is every tick until then. */
static int32_t last_scene(void)
{
    struct tape *tape = open_tape(true);
    struct tape_message message;
    int32_t last_ms = -TICK_MS;

    while (tape_next(tape, &message)) {
        if (strcmp(message.topic, "/muster/fleet") != 0)
            continue;
        TEST_ASSERT_EQUAL_INT32(last_ms + TICK_MS, message.time_ms);
        last_ms = message.time_ms;
        assert_as_seen(&message);
    }
    tape_close(tape);
    return last_ms;
}

static int32_t last_row(void)
{
    char path[128], line[256];
    double t = -1;

    snprintf(path, sizeof path, "%s/trace.csv", out);
    FILE *trace = fopen(path, "r");
    TEST_ASSERT_NOT_NULL_MESSAGE(trace, path);
    while (fgets(line, sizeof line, trace) != NULL)
        if (strchr(line, '\n') != NULL)
            sscanf(line, "%lf,", &t);
    fclose(trace);
    return (int32_t)(t * 1000 + 0.5);
}

static void test_all_but_the_last_half_second_is_recovered(void)
{
    onlooker_start(&onlooker, (const char *const[]){"sim", RECORDING_SCENARIO, "--robots", "native",
                                                    "--quiet", "--view=0", "--out", out, NULL});
    onlooker_join(&onlooker, "muster.view.v1");
    look_and_kill();
    tape_close(open_tape(false));
    TEST_ASSERT_EQUAL_INT(0, onlooker_run(&onlooker, (const char *const[]){"recover", out, NULL}));
    TEST_ASSERT_GREATER_OR_EQUAL_INT32(onlooker.seen_ms - LOST_MS, last_scene());
    TEST_ASSERT_GREATER_OR_EQUAL_INT32(onlooker.seen_ms - TRACE_LOST_MS, last_row());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_but_the_last_half_second_is_recovered);
    return UNITY_END();
}
