/* `muster sim --view` as those who look on have it: it shows at once what they do while time stands
 * still, and when it is over it stays as long as they do. */
#define _GNU_SOURCE /* nftw() */
#include "process.h"
#include "scene.h"
#include "stage.h"
#include "viewed.h"

#include <ftw.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <unistd.h>
#include <unity.h>

#define RECORD_HEAD 12
#define ROBOTS 4

static struct loop loop;
static struct watch clock_watch;
static struct process sim;
static char directory[64], run[96], url[128];
static struct viewed viewed;
static struct client client;
static unsigned asked;

/* The newest scene that came. */
static struct scene scene;
static struct scene_robot robots[ROBOTS];
static struct scene_point vertices[ROBOTS];

static void on_clock(struct watch *watch, uint32_t events)
{
    (void)events;
    loop_periods(watch->fd);
}

/* Until it has said this. */
static void says(const char *words)
{
    int64_t deadline_us = loop_now() + INT64_C(60000000);

    while (process_said(&sim, words) == NULL) {
        TEST_ASSERT_TRUE_MESSAGE(loop_now() < deadline_us, words);
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
}

static void ends(int status)
{
    int64_t deadline_us = loop_now() + INT64_C(60000000);

    while (!process_ended(&sim)) {
        TEST_ASSERT_TRUE_MESSAGE(loop_now() < deadline_us, "it does not end");
        TEST_ASSERT_TRUE(loop_wait(&loop));
    }
    TEST_ASSERT_EQUAL_INT(status, sim.status);
}

void setUp(void)
{
    const char *argv[] = {STAGE_MUSTER, "sim",     "--robots",
                          "native",     "--quiet", "--view=0",
                          "--out",      run,       STAGE_SCENARIOS "/paper-sim-leader-fault.yaml",
                          NULL};

    asked = 0;
    scene = (struct scene){.time_ms = INT32_MIN};
    strcpy(directory, "/tmp/muster-looked-at-XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(directory));
    snprintf(run, sizeof run, "%s/run", directory);
    TEST_ASSERT_TRUE(loop_open(&loop));
    clock_watch = (struct watch){.fd = loop_timer(20000), .ready = on_clock};
    TEST_ASSERT_TRUE(loop_watch(&loop, &clock_watch, EPOLLIN));
    process_start(&sim, &loop, argv, NULL);
    says("\n"); /* the whole line */
    TEST_ASSERT_EQUAL_INT(1, sscanf(process_said(&sim, "view: "), "view: %127s", url));
    viewed = (struct viewed){.url = url, .token = strchr(url, '#') + 1};
    TEST_ASSERT_EQUAL_INT(1, sscanf(url, "http://%63[0-9.:]", viewed.host));
    viewed_join(&viewed, &client);
}

static int forget(const char *path, const struct stat *status, int kind, struct FTW *where)
{
    (void)status;
    (void)kind;
    (void)where;
    return remove(path);
}

void tearDown(void)
{
    client_close(&client);
    process_close(&sim);
    close(clock_watch.fd);
    loop_close(&loop);
    nftw(directory, forget, 8, FTW_DEPTH | FTW_PHYS);
}

/* ---- what is seen ---------------------------------------------------------------------- */

static uint32_t u32_at(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* The last scene of a binary message, if there is one. */
static void take_scenes(const struct client_message *message)
{
    size_t at = 0;

    while (message->opcode == CLIENT_BINARY && at + RECORD_HEAD <= message->count) {
        const uint8_t *record = message->bytes + at;
        size_t count = u32_at(record + 8);

        if (record[0] == 1) {
            TEST_ASSERT_TRUE(
                scene_read(&scene, robots, ROBOTS, vertices, ROBOTS, record + RECORD_HEAD, count));
        }
        at += (RECORD_HEAD + count + 7) / 8 * 8;
    }
}

static void see_until(bool (*seen)(void))
{
    while (!seen()) {
        struct client_message message = client_receive(&client);

        TEST_ASSERT_TRUE_MESSAGE(message.opcode != CLIENT_GONE, "the page has gone");
        take_scenes(&message);
    }
}

static bool time_goes_on(void)
{
    return scene.time_ms >= 100;
}

static bool robot_3_is_elsewhere(void)
{
    return robots[2].id == 3 && fabs(robots[2].x - 77) < 1e-9 && fabs(robots[2].y + 5) < 1e-9;
}

static bool robot_1_is_dead(void)
{
    return robots[0].id == 1 && !robots[0].alive;
}

static bool another_formation_is_there(void)
{
    return strcmp(scene.formation, "pair") == 0 && scene.vertex_count == 2;
}

/* Its answer, "null" or the words of a refusal, is `expected`. */
static void ask(const char *request, const char *expected)
{
    char begin[64], text[512];

    viewed_ask(&viewed, &client, ++asked, request);
    snprintf(begin, sizeof begin, "{\"answer\":{\"number\":%u,", asked);
    for (;;) {
        struct client_message message = client_receive(&client);

        take_scenes(&message);
        if (message.opcode != CLIENT_TEXT || message.count >= sizeof text)
            continue;
        snprintf(text, sizeof text, "%.*s", (int)message.count, (const char *)message.bytes);
        if (strncmp(text, begin, strlen(begin)) == 0)
            break;
    }
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, expected), text);
}

static void what_is_done_while_time_stands_still_is_seen(void)
{
    see_until(time_goes_on);
    ask("\"pause\"", "null");
    ask("\"move\",\"robot\":3,\"x\":77,\"y\":-5,\"theta\":0", "null");
    see_until(robot_3_is_elsewhere);
    int32_t stood = scene.time_ms;
    ask("\"kill\",\"robot\":1", "null");
    see_until(robot_1_is_dead);
    ask("\"draw\",\"name\":\"pair\",\"L\":[0,1],\"psi\":[0,0]", "null");
    see_until(another_formation_is_there);
    TEST_ASSERT_EQUAL_INT32(stood, scene.time_ms);
    client_close(&client);
    process_signal(&sim, SIGTERM);
    ends(1);
}

static void it_stays_as_long_as_somebody_looks_on(void)
{
    char summary[128];

    see_until(time_goes_on);
    ask("\"end\"", "null");
    says("the page stays");
    snprintf(summary, sizeof summary, "%s/summary.json", run);
    TEST_ASSERT_EQUAL_INT(0, access(summary, R_OK));
    ask("\"kill\",\"robot\":1", "the run is over");
    TEST_ASSERT_FALSE(process_ended(&sim));
    client_close(&client);
    ends(1); /* it was interrupted */
}

static void a_signal_ends_its_stay(void)
{
    see_until(time_goes_on);
    ask("\"end\"", "null");
    says("the page stays");
    process_signal(&sim, SIGINT);
    ends(1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(what_is_done_while_time_stands_still_is_seen);
    RUN_TEST(it_stays_as_long_as_somebody_looks_on);
    RUN_TEST(a_signal_ends_its_stay);
    return UNITY_END();
}
