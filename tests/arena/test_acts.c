/* What those who look on do to real robots, through the server's view and by its protocol. */
#include "stage.h"
#include "visitor.h"

#include <unity.h>

static struct stage stage;
static struct visitor visitor;

void setUp(void)
{
    visitor.client = (struct client){.fd = -1};
}

void tearDown(void)
{
    visitor_leave(&visitor);
    stage_close(&stage);
}

static void ask(const char *request, const char *expected)
{
    visitor_ask(&visitor, request, expected);
}

static void open_stage(bool without_robot_4)
{
    static struct stage_plan plan;

    plan = (struct stage_plan){
        .duration = 60,
        .cable = CABLE_TCP,
        .site = "patience: 600\n",
        .absent = {[3] = without_robot_4},
        .looked_at = true,
    };
    stage_open(&stage, &plan);
    stage_says(&stage, "view: ");
    visitor_join(&visitor, &stage.server);
}

static bool three_are_there(const struct scene *scene)
{
    return scene->time_ms == -1000 && scene->robots[0].linked && scene->robots[1].linked &&
           scene->robots[2].linked && !scene->robots[3].linked && scene->robots[2].pose_age < 0.2f;
}

static void the_gathering_is_seen_and_can_be_ended(void)
{
    open_stage(true);
    visitor_see(&visitor, three_are_there);
    stage_says(&stage, "3 of 4 robots ready");
    ask("\"begin\"", "null");
    stage_begin(&stage);
    stage_drives(&stage, 3);
    ask("\"end\"", "null");
    stage_server_ends(&stage, 0);
    stage_end(&stage);
}

static void robots_are_halted_and_go_on(void)
{
    open_stage(false);
    stage_begin(&stage);
    ask("\"begin\"", "it has begun");
    ask("\"kill\",\"robot\":9", "robot 9 is not in this scenario: it has 1 to 4");
    ask("\"move\",\"robot\":3,\"x\":0,\"y\":0,\"theta\":0", "is nothing that");
    stage_drives(&stage, 3);
    stage_mark(&stage);
    ask("\"kill\",\"robot\":3", "null");
    stage_stands(&stage, 3);
    stage_drove_on(&stage, 4);
    ask("\"revive\",\"robot\":3", "null");
    stage_drives(&stage, 3);
    stage_mark(&stage);
    ask("\"stall\",\"robot\":4", "null");
    stage_stands(&stage, 4);
    ask("\"draw\",\"name\":\"pair\",\"L\":[0,0.4],\"psi\":[0,3.1]", "null");
    ask("\"formation\",\"name\":\"pair\"", "null");
    ask("\"end\"", "null");
    stage_server_ends(&stage, 0);
    TEST_ASSERT_TRUE(stage_logged(&stage, ",3,kill,"));
    TEST_ASSERT_TRUE(stage_logged(&stage, ",3,revive,"));
    TEST_ASSERT_TRUE(stage_logged(&stage, ",4,stall,"));
    TEST_ASSERT_TRUE(stage_logged(&stage, ",0,draw,pair"));
    TEST_ASSERT_TRUE(stage_logged(&stage, ",0,stop,ended by one who looks on"));
    stage_end(&stage);
}

static void the_emergency_stop_is_everybodys(void)
{
    open_stage(false);
    stage_begin(&stage);
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_drives(&stage, id);
    stage_mark(&stage);
    ask("\"estop\"", "null");
    for (unsigned id = 1; id <= STAGE_ROBOTS; id++)
        stage_stands(&stage, id);
    ask("\"end\"", "null");
    stage_server_ends(&stage, 0);
    TEST_ASSERT_TRUE(stage_logged(&stage, ",0,estop,"));
    stage_end(&stage);
}

static void nobody_sets_off_who_has_been_stopped(void)
{
    open_stage(false);
    stage_begin(&stage);
    stage_drives(&stage, 3);
    ask("\"end\"", NULL);
    ask("\"revive\",\"robot\":3", "the run is over");
    stage_server_ends(&stage, 0);
    TEST_ASSERT_FALSE(stage_logged(&stage, ",3,revive,"));
    stage_end(&stage);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_gathering_is_seen_and_can_be_ended);
    RUN_TEST(robots_are_halted_and_go_on);
    RUN_TEST(the_emergency_stop_is_everybodys);
    RUN_TEST(nobody_sets_off_who_has_been_stopped);
    return stage_verdict();
}
