/* Links that break, robots that vanish and robots that begin anew: the robot stands, the others
 * drive on, and it comes back. */
#include "stage.h"

#include <signal.h>
#include <unity.h>

/* A second of robots' ticks. */
#define SECOND 50

static struct stage stage;

void setUp(void)
{
}

void tearDown(void)
{
    stage_close(&stage);
}

static void finish(void)
{
    stage_server_ends(&stage, 0);
    stage_is_complete(&stage, 0.05);
    stage_end(&stage);
}

/* Down for a second and a half; the server dials again all the while. */
static void pull(unsigned id)
{
    struct stage_robot *robot = stage_robot(&stage, id);

    stage_mark(&stage);
    cable_pull(&robot->cable);
    stage_stands(&stage, id);
    cable_plug(&robot->cable);
    stage_drives(&stage, id);
}

static void kill_and_restart(unsigned id)
{
    struct stage_robot *robot = stage_robot(&stage, id);

    stage_mark(&stage);
    process_signal(&robot->process, SIGKILL);
    stage_ticks(&stage, SECOND);
    TEST_ASSERT_TRUE(process_ended(&robot->process));
    stage_start_robot(&stage, id);
    stage_drives(&stage, id);
}

static void reboot(unsigned id)
{
    stage_mark(&stage);
    process_signal(&stage_robot(&stage, id)->process, SIGUSR1);
    stage_says(&stage, "was reset and is given its mission again");
    stage_drives(&stage, id);
}

/* The link stands, and nothing comes of it. */
static void hold(unsigned id)
{
    struct stage_robot *robot = stage_robot(&stage, id);

    stage_mark(&stage);
    process_signal(&robot->process, SIGSTOP);
    stage_says(&stage, "nothing heard for 2 s");
    for (unsigned other = 1; other <= STAGE_ROBOTS; other++)
        if (other != id)
            stage_drove_on(&stage, other);
    robot->heard_us = 0;
    process_signal(&robot->process, SIGCONT);
    stage_drives(&stage, id);
}

static void tcp_links_that_break_come_back(void)
{
    static const struct stage_plan plan = {.duration = 18, .cable = CABLE_TCP};

    stage_open(&stage, &plan);
    stage_begin(&stage);
    stage_ticks(&stage, SECOND);

    pull(3);
    stage_says(&stage, "robot 3: tcp:127.0.0.1:");
    stage_drove_on(&stage, 1);
    stage_drove_on(&stage, 2);
    stage_drove_on(&stage, 4);

    kill_and_restart(4);
    stage_says(&stage, "robot 4: tcp:127.0.0.1:");
    stage_drove_on(&stage, 1);
    stage_drove_on(&stage, 2);
    stage_drove_on(&stage, 3);

    reboot(2);
    stage_drove_on(&stage, 1);
    stage_drove_on(&stage, 3);
    stage_drove_on(&stage, 4);

    hold(3);

    finish();
    TEST_ASSERT_TRUE(stage_summary(&stage, "\"links_lost\"", "\"links_lost\"") >= 3);
}

static void a_robot_that_is_held_behind_a_pty_comes_back(void)
{
    static const struct stage_plan plan = {.duration = 9, .cable = CABLE_NONE};

    stage_open(&stage, &plan);
    stage_begin(&stage);
    stage_ticks(&stage, SECOND);
    hold(3);
    finish();
}

/* The leader as well: another one leads on. */
static void ptys_of_chips_that_vanish_come_back(void)
{
    static const struct stage_plan plan = {.duration = 14, .cable = CABLE_PTY, .avr = true};

    stage_open(&stage, &plan);
    stage_begin(&stage);
    stage_ticks(&stage, SECOND);

    pull(1);
    stage_says(&stage, "robot 2 leads");
    stage_says(&stage, "robot 1: ");

    reboot(4);
    stage_drove_on(&stage, 2);
    stage_drove_on(&stage, 3);

    finish();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(tcp_links_that_break_come_back);
    RUN_TEST(a_robot_that_is_held_behind_a_pty_comes_back);
    RUN_TEST(ptys_of_chips_that_vanish_come_back);
    return stage_verdict();
}
