/* What the paper's figures 11 and 14 to 19 must show, on native robots. */
#include "fleet.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define MIRRORED "paper-sim-100-v-mirrored.yaml"
#define FAULT "paper-exp-leader-fault.yaml"
#define CHANGE "paper-exp-formation-change.yaml"

void setUp(void)
{
}
void tearDown(void)
{
}

static double path_by(const char *allocation)
{
    struct fleet_result result = fleet_run(&(struct fleet_run){
        .file = MIRRORED, .settings = {"network.range=3", allocation}, .robots = SIM_NATIVE});

    return result.summary.metrics.path_length;
}

static void a_hundred_in_a_mirrored_v_drive_hardly_more_than_the_optimum(void)
{
    struct fleet_result cpa = fleet_run(&(struct fleet_run){
        .file = MIRRORED, .settings = {"network.range=3"}, .robots = SIM_NATIVE});
    double path = cpa.summary.metrics.path_length;

    TEST_ASSERT_EQUAL_UINT(50, cpa.leader);
    TEST_ASSERT_TRUE(cpa.summary.metrics.complete);
    TEST_ASSERT_TRUE(path <= 1.05 * path_by("allocation=optimal"));
    TEST_ASSERT_TRUE(path <= 0.5 * path_by("allocation=rigid"));
}

/* Different vertices that live followers hold in the last tick of a trace. */
static unsigned held_at_the_end(const char *out)
{
    bool held[101] = {false};
    unsigned count = 0;
    double t = -1;
    struct fleet_row row;
    FILE *trace = fleet_trace(out);

    while (fleet_next(trace, &row)) {
        if (row.t != t) {
            memset(held, 0, sizeof held);
            count = 0;
        }
        t = row.t;
        if (row.alive == 0 || row.role == 'L' || row.vertex == 0 || held[row.vertex])
            continue;
        held[row.vertex] = true;
        count++;
    }
    return count;
}

static void with_a_range_of_1_m_nearly_all_vertices_are_held(void)
{
    fleet_run(&(struct fleet_run){.file = MIRRORED,
                                  .settings = {"network.range=1"},
                                  .robots = SIM_NATIVE,
                                  .out = "one-metre"});
    TEST_ASSERT_TRUE(held_at_the_end("one-metre") >= 97);
}

/* The largest mean distance error of the live from a time on. */
static double mean_error_from(const char *out, double from)
{
    double largest = 0, sum = 0, t = -1;
    unsigned alive = 0;
    struct fleet_row row;
    FILE *trace = fleet_trace(out);

    while (fleet_next(trace, &row)) {
        if (row.t != t && alive > 0)
            largest = fmax(largest, sum / alive);
        if (row.t != t)
            sum = alive = 0;
        t = row.t;
        if (row.t < from || row.alive == 0)
            continue;
        sum += row.error;
        alive++;
    }
    return fmax(largest, sum / alive);
}

static double died_at(const char *out)
{
    double t = -1;
    struct fleet_row row;
    FILE *trace = fleet_trace(out);

    while (fleet_next(trace, &row))
        if (t < 0 && row.alive == 0)
            t = row.t;
    return t;
}

static void experiment_1_has_a_new_leader_soon_and_comes_to_rest(void)
{
    for (uint64_t seed = 1; seed <= 10; seed++) {
        struct fleet_result result = fleet_run(
            &(struct fleet_run){.file = FAULT, .robots = SIM_NATIVE, .seed = seed, .out = "fault"});
        double died = died_at("fault");

        TEST_ASSERT_EQUAL_UINT(2, result.leader);
        TEST_ASSERT_TRUE(result.summary.metrics.complete);
        TEST_ASSERT_TRUE(died > 3 && died < 4);
        TEST_ASSERT_TRUE(fleet_leads_at("fault", 2, 0) - died <= 0.7);
        TEST_ASSERT_TRUE(mean_error_from("fault", result.summary.duration - 3) <= 0.02);
    }
}

static void experiment_2_comes_to_rest_in_the_new_formation(void)
{
    for (uint64_t seed = 1; seed <= 10; seed++) {
        struct fleet_result result = fleet_run(&(struct fleet_run){
            .file = CHANGE, .robots = SIM_NATIVE, .seed = seed, .out = "change"});

        TEST_ASSERT_EQUAL_UINT(1, result.leader);
        TEST_ASSERT_EQUAL_UINT(1, result.summary.metrics.elections);
        TEST_ASSERT_TRUE(result.summary.metrics.complete);
        TEST_ASSERT_TRUE(mean_error_from("change", result.summary.duration - 3) <= 0.02);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_hundred_in_a_mirrored_v_drive_hardly_more_than_the_optimum);
    RUN_TEST(with_a_range_of_1_m_nearly_all_vertices_are_held);
    RUN_TEST(experiment_1_has_a_new_leader_soon_and_comes_to_rest);
    RUN_TEST(experiment_2_comes_to_rest_in_the_new_formation);
    return UNITY_END();
}
