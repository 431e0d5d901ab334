/* Motion capture that freezes, begins anew, dies, loses a body or mistakes one for another. */
#include "stage.h"

#include <signal.h>
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

static void all_drive(void)
{
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_drives(&stage, id);
}

/* All but one, who is 0 when it is all. */
static void others_drove_on(unsigned except)
{
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        if (id != except)
            stage_drove_on(&stage, id);
}

static void without_motion_capture_everybody_stands(void)
{
    /* Bodies are where they began when motion capture has been killed and is back. */
    static const struct stage_plan plan = {
        .duration = 60,
        .cable = CABLE_TCP,
        .mocap = ", jump: 0",
    };

    begin(&plan);
    process_tell(&stage.arena, "freeze");
    all_stand();
    stage_says(&stage, "no frames for");
    stage_mark(&stage);
    process_tell(&stage.arena, "thaw");
    stage_says(&stage, "frames come again");
    all_drive();

    stage_ticks(&stage, SECOND);
    stage_mark(&stage);
    process_tell(&stage.arena, "restart");
    stage_says(&stage, "frames are numbered from");
    stage_ticks(&stage, SECOND);
    others_drove_on(0);

    stage_mark(&stage);
    process_signal(&stage.arena, SIGKILL);
    all_stand();
    stage_says(&stage, "no frames for");
    TEST_ASSERT_TRUE(process_ended(&stage.arena));
    stage_start_arena(&stage);
    stage_says(&stage, "frames come again");
    all_drive();

    process_signal(&stage.server, SIGTERM);
    stage_server_ends(&stage, 0);
    TEST_ASSERT_EQUAL_INT(0, (int)stage_summary(&stage, "\"links_lost\"", "\"links_lost\""));
    stage_end(&stage);
}

static void a_lost_body_and_one_that_jumps_stop_their_robots(void)
{
    static const struct stage_plan plan = {.duration = 10, .cable = CABLE_TCP};

    begin(&plan);
    process_tell(&stage.arena, "lose 3");
    stage_stands(&stage, 3);
    stage_says(&stage, "robot 3: motion capture has lost Robot3");
    others_drove_on(3);
    process_tell(&stage.arena, "find 3");
    stage_drives(&stage, 3);
    stage_says(&stage, "robot 3: Robot3 is seen again");

    stage_mark(&stage);
    process_tell(&stage.arena, "jump 4 0.8");
    stage_stands(&stage, 4);
    stage_says(&stage, "robot 4: Robot4 jumped by 0.8");
    others_drove_on(4);
    process_tell(&stage.arena, "jump 4 0");
    stage_drives(&stage, 4);

    stage_server_ends(&stage, 0);
    stage_is_complete(&stage, 0.05);
    TEST_ASSERT_TRUE(stage_logged(&stage, ",3,body,motion capture has lost Robot3"));
    TEST_ASSERT_TRUE(stage_logged(&stage, ",4,body,Robot4 jumped by 0.8"));
    stage_end(&stage);
}

/* The leader and the one a metre behind it: neither is where it is said to be. */
static void swapped_bodies_are_not_believed(void)
{
    static const struct stage_plan plan = {.duration = 60, .cable = CABLE_TCP};

    begin(&plan);
    process_tell(&stage.arena, "jump 1 -1");
    process_tell(&stage.arena, "jump 2 1");
    stage_stands(&stage, 1);
    stage_stands(&stage, 2);
    stage_says(&stage, "robot 1: Robot1 jumped by ");
    stage_says(&stage, "robot 2: Robot2 jumped by ");
    stage_mark(&stage);
    process_tell(&stage.arena, "jump 1 0");
    process_tell(&stage.arena, "jump 2 0");
    all_drive();
    process_signal(&stage.server, SIGTERM);
    stage_server_ends(&stage, 0);
    stage_end(&stage);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(without_motion_capture_everybody_stands);
    RUN_TEST(a_lost_body_and_one_that_jumps_stop_their_robots);
    RUN_TEST(swapped_bodies_are_not_believed);
    return stage_verdict();
}
