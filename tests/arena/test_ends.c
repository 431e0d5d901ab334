/* How a run ends, or does not begin: the fence, the separation, signals, a server that dies, one
 * that nobody reads, robots that are not there. Robots stand each time. */
#define _GNU_SOURCE /* pipe2() */
#include "stage.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

#define SECOND 50

static struct stage stage;

void setUp(void)
{
}

void tearDown(void)
{
    stage_close(&stage);
}

static void begin(const struct stage_plan *plan)
{
    stage_open(&stage, plan);
    stage_begin(&stage);
    stage_ticks(&stage, SECOND);
    stage_mark(&stage);
}

static void all_stand(void)
{
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_stands(&stage, id);
}

static void the_fence_stops_the_fleet(void)
{
    static const struct stage_plan plan = {
        .duration = 60,
        .cable = CABLE_TCP,
        .site = "fence: [-3, -3, 1, 3]\n",
    };

    begin(&plan);
    stage_says(&stage, "stop: robot 1 is 0.0");
    stage_mark(&stage);
    all_stand();
    stage_server_ends(&stage, 1);
    TEST_ASSERT_TRUE(stage_logged(&stage, ",0,stop,robot 1 is 0.0"));
    stage_end(&stage);
}

static void the_separation_stops_the_fleet(void)
{
    static const struct stage_plan plan = {
        .duration = 60,
        .cable = CABLE_TCP,
        .site = "separation: 0.8\n",
    };

    begin(&plan);
    process_tell(&stage.arena, "jump 2 0.25");
    all_stand();
    stage_says(&stage, "stop: robots 1 and 2 are 0.7");
    stage_server_ends(&stage, 1);
    stage_end(&stage);
}

/* The last word that each has sent before the server was gone. */
static void sigterm_stops_the_robots_first(void)
{
    static const struct stage_plan plan = {.duration = 60, .cable = CABLE_TCP};

    begin(&plan);
    process_signal(&stage.server, SIGTERM);
    stage_server_ends(&stage, 0);
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++) {
        const struct stage_robot *robot = stage_robot(&stage, id);

        stage_expect(&stage, robot->moved < robot->ticks, "a robot still drives");
        TEST_ASSERT_TRUE(robot->moved > 0);
    }
    all_stand();
    TEST_ASSERT_TRUE(stage_logged(&stage, ",0,stop,ended by SIGTERM"));
    TEST_ASSERT_TRUE(stage_summary(&stage, "\"end\": \"ended by SIGTERM\"", "\"end\"") == 0);
    stage_end(&stage);
}

static void the_emergency_stop_lasts(void)
{
    static const struct stage_plan plan = {.duration = 60, .cable = CABLE_TCP};

    begin(&plan);
    process_signal(&stage.server, SIGUSR1);
    all_stand();
    stage_says(&stage, "emergency stop");
    process_signal(&stage.server, SIGTERM);
    stage_server_ends(&stage, 0);
    stage_ticks(&stage, SECOND);
    all_stand();
    TEST_ASSERT_TRUE(stage_logged(&stage, ",0,estop,"));
    stage_end(&stage);
}

static void robots_stop_by_themselves_when_the_server_dies(void)
{
    static const struct stage_plan plan = {.duration = 60, .cable = CABLE_PTY};

    begin(&plan);
    process_signal(&stage.server, SIGKILL);
    all_stand();
    stage_server_ends(&stage, -SIGKILL);
    stage_end(&stage);
}

/* A pipe that takes nothing more; for its reader, the other end. */
static int full_pipe(int *reader)
{
    static const char junk[4096];
    int ends[2];

    TEST_ASSERT_EQUAL_INT(0, pipe2(ends, O_CLOEXEC));
    fcntl(ends[1], F_SETFL, O_NONBLOCK);
    while (write(ends[1], junk, sizeof junk) > 0 || write(ends[1], junk, 1) > 0)
        ;
    fcntl(ends[1], F_SETFL, 0);
    *reader = ends[0];
    return ends[1];
}

static void nobody_has_to_read_what_the_server_says(void)
{
    int reader;
    const struct stage_plan plan = {
        .duration = 60,
        .cable = CABLE_TCP,
        .output = full_pipe(&reader),
    };

    stage_open(&stage, &plan);
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_drives(&stage, id);
    stage_mark(&stage);
    cable_pull(&stage_robot(&stage, 4)->cable); /* something to speak of */
    stage_ticks(&stage, 6 * SECOND);
    for (unsigned id = 1; id <= 3; id++)
        stage_drove_on(&stage, id);
    stage_mark(&stage);
    process_signal(&stage.server, SIGTERM);
    all_stand();
    stage_server_ends(&stage, 0);
    stage_end(&stage);
    close(plan.output);
    close(reader);
}

static void a_start_does_not_wait_for_ever(void)
{
    static const struct stage_plan plan = {
        .duration = 5,
        .cable = CABLE_TCP,
        .site = "patience: 2\n",
        .absent = {[3] = true},
        .answers = {[2] = 5},
    };

    stage_open(&stage, &plan);
    stage_begin(&stage);
    stage.server.heard = 0;
    stage_says(&stage, "robot 3: who answers there is robot 5");
    stage_says(&stage,
               "the mission begins without robot 3 (another robot answers), robot 4 (nothing");
    stage_server_ends(&stage, 0);
    TEST_ASSERT_TRUE(stage_robot(&stage, 1)->moved > 0);
    TEST_ASSERT_TRUE(stage_robot(&stage, 2)->moved > 0);
    TEST_ASSERT_TRUE(stage_robot(&stage, 3)->moved == 0);
    stage_end(&stage);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_fence_stops_the_fleet);
    RUN_TEST(the_separation_stops_the_fleet);
    RUN_TEST(sigterm_stops_the_robots_first);
    RUN_TEST(the_emergency_stop_lasts);
    RUN_TEST(robots_stop_by_themselves_when_the_server_dies);
    RUN_TEST(nobody_has_to_read_what_the_server_says);
    RUN_TEST(a_start_does_not_wait_for_ever);
    return stage_verdict();
}
