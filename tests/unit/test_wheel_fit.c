#include "wheel_fit.h"

#include "driven.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

static const struct drive_wheels small = {.track = 0.08, .wheel_max = 0.6};
static struct driven robot;
static struct drive_plan plan;
static struct drive_record record;
static struct wheel_fit fit;
static char words[WHEEL_FIT_WORDS_MAX];

void setUp(void)
{
    robot = (struct driven){
        .wheel_max = 0.6,
        .gain = {0.93, 1.08},
        .dead = {0.04, 0.013},
        .track = 0.0815,
        .lag = 0.047,
    };
    drive_plan_measure(&plan, &small);
}

void tearDown(void)
{
}

static void assert_fits(double gain, double dead, double track, double lag)
{
    bool fitted = wheel_fit(&record, &small, &fit, words);

    TEST_ASSERT_TRUE_MESSAGE(fitted, words);
    for (int i = 0; i < WHEELS; i++) {
        TEST_ASSERT_DOUBLE_WITHIN(gain, robot.gain[i], fit.gain[i]);
        TEST_ASSERT_DOUBLE_WITHIN(dead, robot.dead[i], fit.dead[i]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(track, robot.track, fit.track);
    TEST_ASSERT_DOUBLE_WITHIN(lag, robot.lag, fit.lag);
}

static void test_exact(void)
{
    driven_record(&robot, &plan, 1, &record);
    assert_fits(1e-3, 1e-3, 1e-4, 2e-3);
}

static void test_noise_and_radio(void)
{
    robot.noisy = true;
    robot.latest = 0.02;
    for (uint32_t seed = 1; seed <= 5; seed++) {
        driven_record(&robot, &plan, seed, &record);
        assert_fits(2e-3, 2e-3, 2e-4, 4e-3);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_exact);
    RUN_TEST(test_noise_and_radio);
    return UNITY_END();
}
