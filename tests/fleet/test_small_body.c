/* The paper's robot in the paper's arena: wheels with limits and lag, motion capture with noise, a
 * radio that is late. Its two experiments, as shipped. */
#include "body.h"
#include "fleet.h"

#include <math.h>
#include <unity.h>

#define LEADER_FAULT "paper-exp-leader-fault.yaml"
#define UNCALIBRATED "uncalibrated-leader-fault.yaml"
#define FORMATION_CHANGE "paper-exp-formation-change.yaml"
#define SEEDS 10

void setUp(void)
{
}
void tearDown(void)
{
}

static struct fleet_result run_seed(const char *file, uint64_t seed)
{
    return fleet_run(
        &(struct fleet_run){.file = file, .robots = SIM_NATIVE, .seed = seed, .out = "last"});
}

/* When `robot` died, s; -1: never. */
static double died_at(const char *out, unsigned robot)
{
    FILE *trace = fleet_trace(out);
    struct fleet_row row;
    double died = -1;

    while (fleet_next(trace, &row))
        if (row.robot == robot && !row.alive && died < 0)
            died = row.t;
    return died;
}

static void the_leader_is_replaced_within_700_ms(void)
{
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        struct fleet_result r = run_seed(LEADER_FAULT, seed);
        double died = died_at("last", 1);
        double replaced = fleet_leads_at("last", 2, 0);

        TEST_ASSERT_TRUE(r.summary.metrics.complete);
        TEST_ASSERT_TRUE(r.summary.metrics.error_final <= 0.02);
        TEST_ASSERT_EQUAL_UINT(2, r.summary.metrics.elections);
        TEST_ASSERT_TRUE(died > 3 && replaced > died && replaced <= died + 0.7001);
    }
}

static void the_formation_changes(void)
{
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        struct fleet_result r = run_seed(FORMATION_CHANGE, seed);

        TEST_ASSERT_TRUE(r.summary.metrics.complete);
        TEST_ASSERT_TRUE(r.summary.metrics.error_final <= 0.02);
        TEST_ASSERT_EQUAL_UINT(1, r.summary.metrics.elections);
    }
}

/* The leader follows the reference along y at 0.3 m/s. Samples that were stamped 3 ms late, which
 * is their age in the mean, would put it 1 mm off. */
static void the_stamps_of_poses_are_honest(void)
{
    struct fleet_row row;
    double sum = 0;
    unsigned count = 0;

    fleet_run(&(struct fleet_run){.file = FORMATION_CHANGE,
                                  .settings = {"duration=40"},
                                  .robots = SIM_NATIVE,
                                  .out = "straight"});
    FILE *trace = fleet_trace("straight");
    while (fleet_next(trace, &row)) {
        if (row.robot == 1 && row.t >= 10) {
            sum += row.y - 0.3 * row.t;
            count++;
        }
    }
    TEST_ASSERT_TRUE(fabs(sum / count) <= 0.0005);
}

/* Every robot, not their mean: no pose is new, but all are carried on to the same moment. */
static void a_curve_is_held_within_10_mm(void)
{
    struct fleet_row row;
    double worst = 0;

    fleet_run(&(struct fleet_run){.file = LEADER_FAULT,
                                  .settings = {"trajectory.omega=0.2", "duration=40"},
                                  .robots = SIM_NATIVE,
                                  .out = "curve"});
    FILE *trace = fleet_trace("curve");
    while (fleet_next(trace, &row))
        if (row.t >= 20)
            worst = fmax(worst, row.error);
    TEST_ASSERT_TRUE(worst <= 0.01);
}

/* Robots start when their clocks say so: these are right in spite of the radio's delay. */
static void everyone_sets_out_at_0(void)
{
    struct fleet_row row;

    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        run_seed(LEADER_FAULT, seed);
        FILE *trace = fleet_trace("last");
        while (fleet_next(trace, &row)) {
            if (row.t <= 0.02) {
                TEST_ASSERT_TRUE((row.v != 0) == (row.t > 0));
            }
        }
    }
}

static void the_seed_decides_on_noise_and_delays(void)
{
    double errors[2];

    for (uint64_t seed = 1; seed <= 2; seed++)
        errors[seed - 1] = run_seed(FORMATION_CHANGE, seed).summary.metrics.error_integral;
    TEST_ASSERT_TRUE(errors[0] != errors[1]);
}

/* What a calibration without any error would find of a robot. */
static struct parameter_entry known(uint16_t id)
{
    struct body_kind kind =
        body_kind_of(&(struct scenario){.body = BODY_SMALL, .scatter = 0.1}, id);
    struct parameter_entry entry = {.given = 0};
    uint16_t *value = entry.parameters.value;

    parameters_default(&entry.parameters);
    value[PARAMETER_ID] = id;
    value[PARAMETER_LEFT_GAIN] = (uint16_t)lround(kind.left.gain * 16384);
    value[PARAMETER_RIGHT_GAIN] = (uint16_t)lround(kind.right.gain * 16384);
    value[PARAMETER_LEFT_DEAD_BAND] = (uint16_t)lround(kind.left.dead_band);
    value[PARAMETER_RIGHT_DEAD_BAND] = (uint16_t)lround(kind.right.dead_band);
    value[PARAMETER_TRACK] = (uint16_t)lround(kind.track * 4000);
    value[PARAMETER_MOTOR_LAG] = (uint16_t)lround(kind.lag * 1000);
    return entry;
}

static void robots_that_know_their_bodies_drive_as_designed(void)
{
    struct parameter_entry robots[] = {known(1), known(2), known(3), known(4)};
    const struct parameter_file file = {4, robots};

    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        struct fleet_run run = {.file = UNCALIBRATED, .robots = SIM_NATIVE, .seed = seed};
        double unknown = fleet_run(&run).summary.metrics.error_final;

        run.parameters = &file;
        TEST_ASSERT_TRUE(unknown > 0.05);
        TEST_ASSERT_TRUE(fleet_run(&run).summary.metrics.error_final <= 0.02);
    }
}

/* Whatever is not the design's has to be the same on both. */
static void chips_know_their_bodies_as_well(void)
{
    struct parameter_entry robots[] = {known(1), known(2), known(3), known(4)};
    const struct parameter_file file = {4, robots};
    struct fleet_run run = {
        .file = UNCALIBRATED, .robots = SIM_AVR, .parameters = &file, .out = "chips"};

    fleet_run(&run);
    run.robots = SIM_NATIVE;
    run.out = "native";
    fleet_run(&run);
    fleet_same_files("chips", "native");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_leader_is_replaced_within_700_ms);
    RUN_TEST(the_formation_changes);
    RUN_TEST(the_stamps_of_poses_are_honest);
    RUN_TEST(a_curve_is_held_within_10_mm);
    RUN_TEST(everyone_sets_out_at_0);
    RUN_TEST(the_seed_decides_on_noise_and_delays);
    RUN_TEST(robots_that_know_their_bodies_drive_as_designed);
    RUN_TEST(chips_know_their_bodies_as_well);
    return UNITY_END();
}
