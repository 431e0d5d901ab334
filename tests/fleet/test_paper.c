/* The paper's two simulations, as shipped, on simulated chips. */
#include "fleet.h"

#include <math.h>
#include <unity.h>

#define LEADER_FAULT "paper-sim-leader-fault.yaml"
#define FORMATION_CHANGE "paper-sim-formation-change.yaml"

void setUp(void)
{
}
void tearDown(void)
{
}

static void leader_fault_recovers(void)
{
    struct fleet_result r = fleet_run(
        &(struct fleet_run){.file = LEADER_FAULT, .robots = SIM_AVR, .out = "leader-fault"});

    TEST_ASSERT_EQUAL_UINT16(2, r.leader);
    TEST_ASSERT_EQUAL_UINT(2, r.summary.metrics.elections);
    TEST_ASSERT_TRUE(r.summary.metrics.complete);
    TEST_ASSERT_TRUE(r.summary.metrics.error_final <= 0.02);
    TEST_ASSERT_TRUE(r.summary.metrics.error_integral <= 8.5);
    TEST_ASSERT_TRUE(r.summary.metrics.switches <= 12);
    TEST_ASSERT_EQUAL_UINT64(0, r.summary.link.bad_frames);
    TEST_ASSERT_TRUE(r.summary.stack_free_min > 256);
}

static void the_first_robot_leads_from_the_start_and_the_second_from_the_kill(void)
{
    TEST_ASSERT_TRUE(fleet_leads_at("leader-fault", 1, 0) <= 0.1);
    double taken_over = fleet_leads_at("leader-fault", 2, 0);
    TEST_ASSERT_TRUE(taken_over > 10 && taken_over <= 10.7);

    FILE *trace = fleet_trace("leader-fault");
    struct fleet_row row;
    while (fleet_next(trace, &row)) {
        TEST_ASSERT_TRUE(row.alive == (row.robot != 1 || row.t < 10));
        if (row.alive && row.robot == 1)
            TEST_ASSERT_EQUAL_INT('L', row.role);
        if (row.robot == 2 && row.t > taken_over)
            TEST_ASSERT_EQUAL_INT('L', row.role);
    }
}

static void a_dead_robot_stands_still(void)
{
    FILE *trace = fleet_trace("leader-fault");
    struct fleet_row row, died = {.t = -1};

    while (fleet_next(trace, &row)) {
        if (row.robot != 1 || row.alive)
            continue;
        if (died.t < 0)
            died = row;
        TEST_ASSERT_TRUE(row.x == died.x && row.y == died.y && row.v == 0 && row.error == 0);
    }
    TEST_ASSERT_TRUE(died.t == 10);
}

static void formation_change_keeps_the_leader(void)
{
    struct fleet_result r = fleet_run(&(struct fleet_run){
        .file = FORMATION_CHANGE, .robots = SIM_AVR, .out = "formation-change"});

    TEST_ASSERT_EQUAL_UINT16(1, r.leader);
    TEST_ASSERT_EQUAL_UINT(1, r.summary.metrics.elections);
    TEST_ASSERT_TRUE(r.summary.metrics.complete);
    TEST_ASSERT_TRUE(r.summary.metrics.error_final <= 0.02);
    TEST_ASSERT_TRUE(r.summary.metrics.error_integral <= 6.8);
}

static void native_robots_leave_the_same_files(void)
{
    fleet_run(&(struct fleet_run){
        .file = LEADER_FAULT, .robots = SIM_NATIVE, .out = "leader-fault-native"});
    fleet_same_files("leader-fault", "leader-fault-native");
    fleet_run(&(struct fleet_run){
        .file = FORMATION_CHANGE, .robots = SIM_NATIVE, .out = "formation-change-native"});
    fleet_same_files("formation-change", "formation-change-native");
}

static void a_second_run_and_two_threads_leave_the_same_files(void)
{
    fleet_run(&(struct fleet_run){.file = LEADER_FAULT, .robots = SIM_AVR, .out = "again"});
    fleet_same_files("leader-fault", "again");
    fleet_run(&(struct fleet_run){
        .file = LEADER_FAULT, .robots = SIM_AVR, .threads = 2, .out = "two-threads"});
    fleet_same_files("leader-fault", "two-threads");
}

static void chance_is_the_same_on_chip_and_host(void)
{
    const char *const bad[] = {"network.loss=0.2", "network.delay=0.05"};

    fleet_run(&(struct fleet_run){.file = LEADER_FAULT,
                                  .settings = {bad[0], bad[1]},
                                  .seed = 7,
                                  .robots = SIM_AVR,
                                  .threads = 2,
                                  .out = "lossy"});
    fleet_run(&(struct fleet_run){.file = LEADER_FAULT,
                                  .settings = {bad[0], bad[1]},
                                  .seed = 7,
                                  .robots = SIM_NATIVE,
                                  .out = "lossy-native"});
    fleet_same_files("lossy", "lossy-native");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(leader_fault_recovers);
    RUN_TEST(the_first_robot_leads_from_the_start_and_the_second_from_the_kill);
    RUN_TEST(a_dead_robot_stands_still);
    RUN_TEST(formation_change_keeps_the_leader);
    RUN_TEST(native_robots_leave_the_same_files);
    RUN_TEST(a_second_run_and_two_threads_leave_the_same_files);
    RUN_TEST(chance_is_the_same_on_chip_and_host);
    return UNITY_END();
}
