/* Robots that differ, calibrated as `muster calibrate --sim' does it, with the noise and the radio
 * of the small robot's arena: what is measured, and what it brings. */
#include "body.h"
#include "calibrate_fleet.h"
#include "fleet.h"
#include "limits.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define UNCALIBRATED "uncalibrated-leader-fault.yaml"
#define ROBOTS 4
#define SEEDS 5

static struct scenario *scenario;
static struct calibration calibrations[ROBOTS];

void setUp(void)
{
}

void tearDown(void)
{
    scenario_free(scenario);
    scenario = NULL;
}

static void read_scenario(const char *setting)
{
    char error[512];

    scenario = scenario_read(FLEET_SCENARIOS "/" UNCALIBRATED, &setting, setting != NULL,
                             VERTICES_MAX_CHIP, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(scenario, error);
    TEST_ASSERT_EQUAL(ROBOTS, scenario->robot_count);
}

static void calibrate(enum sim_robots robots, uint64_t seed, unsigned threads)
{
    const struct calibrate_fleet_options options = {
        .robots = robots,
        .firmware = FLEET_FIRMWARE,
        .seed = seed,
        .threads = threads,
        .quiet = true,
    };
    char error[512] = "";
    enum sim_end end = calibrate_fleet(scenario, &options, &(volatile bool){false}, calibrations,
                                       error, sizeof error);

    TEST_ASSERT_EQUAL_MESSAGE(SIM_DONE, end, error);
    for (size_t i = 0; i < ROBOTS; i++)
        TEST_ASSERT_EQUAL_MESSAGE(JOB_DONE, calibrations[i].job.state, calibrations[i].job.words);
}

/* The farthest that anything measured is from what the robots are made of. */
struct worst {
    double gain, dead, track, lag, before, after;
};

static void see(double *worst, double measured, double is)
{
    *worst = fmax(*worst, fabs(measured - is));
}

static void compare(struct worst *worst)
{
    for (size_t i = 0; i < ROBOTS; i++) {
        const struct calibration_result *result = &calibrations[i].result;
        struct body_kind is = body_kind_of(scenario, scenario->robots[i].id);

        see(&worst->gain, result->value[0] / 16384.0, is.left.gain);
        see(&worst->gain, result->value[1] / 16384.0, is.right.gain);
        see(&worst->dead, result->value[2] / 16383.0, is.left.dead_band / PWM_STEPS);
        see(&worst->dead, result->value[3] / 16383.0, is.right.dead_band / PWM_STEPS);
        see(&worst->track, result->value[4] / 4000.0, is.track);
        see(&worst->lag, result->value[5] / 1000.0, is.lag);
        worst->before = fmax(worst->before, result->before);
        worst->after = fmax(worst->after, result->after);
    }
}

static void print_worst(const char *title, const struct worst *worst)
{
    printf("%s: at most %.4f of a gain, %.4f of full PWM of a dead band, %.2f mm of a track, "
           "%.1f ms of a lag off; trials %.3f m before, %.3f m after\n",
           title, worst->gain, worst->dead, worst->track * 1000, worst->lag * 1000, worst->before,
           worst->after);
}

/* The mean distance error at the end of a run. */
static double error_of(const char *setting, uint64_t seed, const struct parameter_file *parameters)
{
    struct fleet_result result = fleet_run(&(struct fleet_run){
        .file = UNCALIBRATED,
        .settings = {setting},
        .robots = SIM_AVR,
        .seed = seed,
        .parameters = parameters,
    });

    TEST_ASSERT_TRUE(result.summary.metrics.complete);
    return result.summary.metrics.error_final;
}

static void calibrate_and_run(const char *setting, const char *title, double gain, double error)
{
    struct parameter_entry entries[ROBOTS];
    struct worst worst = {0};

    read_scenario(setting);
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        calibrate(SIM_AVR, seed, 2);
        compare(&worst);

        const struct parameter_file file = {calibration_entries(calibrations, ROBOTS, entries),
                                            entries};
        double before = error_of(setting, seed, NULL);
        double after = error_of(setting, seed, &file);

        printf("%s, seed %u: mean distance error %.4f m before, %.4f m after\n", title,
               (unsigned)seed, before, after);
        TEST_ASSERT_TRUE(before > 0.05);
        TEST_ASSERT_TRUE(after < error);
    }
    print_worst(title, &worst);
    TEST_ASSERT_TRUE(worst.gain < gain);
    TEST_ASSERT_TRUE(worst.dead < 0.001);
    TEST_ASSERT_TRUE(worst.track < 0.0003);
    TEST_ASSERT_TRUE(worst.lag < 0.003);
    TEST_ASSERT_TRUE(worst.before > 0.05);
    TEST_ASSERT_TRUE(worst.after < 0.005);
}

static void robots_that_differ_by_a_tenth(void)
{
    calibrate_and_run(NULL, "scatter 0.1", 0.002, 0.005);
}

static void robots_that_differ_by_a_fifth(void)
{
    calibrate_and_run("scatter=0.2", "scatter 0.2", 0.002, 0.005);
}

static void same_results_on_chips_and_natively_with_any_threads(void)
{
    struct calibration_result results[ROBOTS];

    read_scenario(NULL);
    calibrate(SIM_AVR, 7, 1);
    for (size_t i = 0; i < ROBOTS; i++)
        results[i] = calibrations[i].result;
    calibrate(SIM_NATIVE, 7, 3);
    for (size_t i = 0; i < ROBOTS; i++)
        TEST_ASSERT_EQUAL_MEMORY(&results[i], &calibrations[i].result, sizeof results[i]);
}

/* Wheels that are as they should be are left so. */
static void ideal_robots(void)
{
    struct worst worst = {0};

    read_scenario("scatter=0");
    calibrate(SIM_NATIVE, 1, 2);
    compare(&worst);
    TEST_ASSERT_TRUE(worst.gain < 0.002);
    TEST_ASSERT_TRUE(worst.dead < 0.001);
    TEST_ASSERT_TRUE(worst.before < 0.005);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(robots_that_differ_by_a_tenth);
    RUN_TEST(robots_that_differ_by_a_fifth);
    RUN_TEST(same_results_on_chips_and_natively_with_any_threads);
    RUN_TEST(ideal_robots);
    return UNITY_END();
}
