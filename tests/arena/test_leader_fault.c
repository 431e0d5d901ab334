/* The shipped leader-fault scenario as it is to be in an arena: simulated chips behind ptys, poses
 * by NatNet, real time. */
#include "stage.h"

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
    TEST_ASSERT_EQUAL_INT(2, (int)stage_summary(&stage, "\"final_leader\"", "\"final_leader\""));
    TEST_ASSERT_EQUAL_INT(2, (int)stage_summary(&stage, "\"elections\"", "\"elections\""));
    TEST_ASSERT_TRUE(stage_summary(&stage, "\"mean_distance_error_m\"", "\"final\"") <= 0.05);
    TEST_ASSERT_TRUE(stage_summary(&stage, "\"complete\": true", "\"time_to_complete_s\"") > 0);
    stage_end(&stage);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_second_candidate_leads_on);
    return UNITY_END();
}
