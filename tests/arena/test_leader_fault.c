/* The shipped leader-fault scenario as it is to be in an arena: simulated chips behind ptys, poses
 * by NatNet, real time. */
#include "stage.h"

#include <signal.h>
#include <unity.h>

static struct stage stage;

void setUp(void)
{
}

void tearDown(void)
{
    stage_close(&stage);
}

static void the_second_candidate_leads_on(void)
{
    static const struct stage_plan plan = {
        .scenario = STAGE_SCENARIOS "/paper-sim-leader-fault.yaml",
        .avr = true,
        .cable = CABLE_NONE,
    };

    stage_open(&stage, &plan);
    stage_server_ends(&stage, 0);
    stage_is_complete(&stage, 0.05);
    stage_expect(&stage, stage_summary(&stage, "\"final_leader\"", "\"final_leader\"") == 2,
                 "it is not robot 2 that leads");
    stage_expect(&stage, stage_summary(&stage, "\"elections\"", "\"elections\"") == 2,
                 "there were not two elections");
    stage_end(&stage);
}

/* No scenario empties a real battery. */
static void a_drain_is_told_of_and_changes_nothing(void)
{
    static const struct stage_plan plan = {
        .scenario = STAGE_SCENARIOS "/battery-leader.yaml",
        .cable = CABLE_NONE,
    };

    stage_open(&stage, &plan);
    stage_says(&stage, "robot 1: the scenario drains its battery, which only a simulation can");
    stage_mark(&stage);
    stage_ticks(&stage, 100);
    stage_drove_on(&stage, 1);
    TEST_ASSERT_TRUE(stage_logged(&stage, ",1,drain,"));
    process_signal(&stage.server, SIGTERM);
    stage_server_ends(&stage, 0);
    stage_end(&stage);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_second_candidate_leads_on);
    RUN_TEST(a_drain_is_told_of_and_changes_nothing);
    return stage_verdict();
}
