#include "wheel_fit.h"

#include "driven.h"

#include <math.h>
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
    TEST_ASSERT_TRUE_MESSAGE(wheel_fit(&record, &small, &fit, words), words);
    for (int i = 0; i < WHEELS; i++) {
        TEST_ASSERT_DOUBLE_WITHIN(gain, robot.gain[i], fit.gain[i]);
        TEST_ASSERT_DOUBLE_WITHIN(dead, robot.dead[i], fit.dead[i]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(track, robot.track, fit.track);
    TEST_ASSERT_DOUBLE_WITHIN(lag, robot.lag, fit.lag);
}

static void assert_refused(const char *part)
{
    TEST_ASSERT_FALSE(wheel_fit(&record, &small, &fit, words));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, part), words);
}

static void test_exact(void)
{
    driven_record(&robot, &plan, 1, &record);
    assert_fits(1e-4, 1e-4, 1e-5, 1e-3);
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 0.025, fit.delay);
    TEST_ASSERT_TRUE(fit.rms < 1e-4);
}

/* What is measured again and again differs by no more than this. */
static void test_noise_and_radio(void)
{
    robot.noisy = true;
    robot.latest = 0.02;
    for (uint32_t seed = 1; seed <= 5; seed++) {
        driven_record(&robot, &plan, seed, &record);
        assert_fits(1e-3, 1e-3, 1e-4, 2e-3);
        TEST_ASSERT_DOUBLE_WITHIN(4e-3, 0.035, fit.delay);
        TEST_ASSERT_TRUE(fit.rms < 1e-3);
    }
}

/* Scatter of 0.3, the most that a scenario may have. */
static void test_wheels_that_are_far_off(void)
{
    static const struct driven others[] = {
        {0.6, {0.7, 1.3}, {0.15, 0}, 0.085, 0.065, .noisy = true},
        {0.6, {1.3, 1.3}, {0, 0}, 0.075, 0.035, .noisy = true},
        {0.6, {0.7, 0.75}, {0.15, 0.15}, 0.08, 0.02, .noisy = true, .latest = 0.02},
        {0.6, {1, 1}, {0, 0}, 0.08, 0, .noisy = true},
    };

    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        robot = others[i];
        driven_record(&robot, &plan, 3, &record);
        assert_fits(4e-3, 2e-3, 2e-4, 4e-3);
    }
}

static void test_a_body_that_lies_askew_on_its_robot(void)
{
    robot.heading = -0.1;
    robot.ahead = 0.03;
    robot.aside = -0.02;
    robot.noisy = true;
    driven_record(&robot, &plan, 5, &record);
    assert_fits(1e-3, 1e-3, 1e-4, 2e-3);
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, -0.1, fit.heading);
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, 0.03, fit.ahead);
    TEST_ASSERT_DOUBLE_WITHIN(5e-4, -0.02, fit.aside);
}

static void test_too_few_sights(void)
{
    driven_record(&robot, &plan, 1, &record);
    record.sight_count = 10;
    assert_refused("saw it only 10 times");
    driven_record(&robot, &plan, 1, &record);
    for (size_t i = 0; i < record.sight_count / 4; i++)
        record.sight[i] = record.sight[4 * i];
    record.sight_count /= 4;
    assert_refused("20 a second are needed");
}

static void test_what_no_robot_has(void)
{
    robot.gain[WHEEL_RIGHT] = 1.6;
    driven_record(&robot, &plan, 1, &record);
    assert_refused("right wheel is 1.60 times as fast");
    setUp();
    robot.dead[WHEEL_LEFT] = 0.35;
    driven_record(&robot, &plan, 1, &record);
    assert_refused("left wheel turns only from 0.35");
    setUp();
    robot.track = 0.17;
    driven_record(&robot, &plan, 1, &record);
    assert_refused("its wheels are 0.170 m apart");
    setUp();
    robot.lag = 0.7;
    driven_record(&robot, &plan, 1, &record);
    assert_refused("take 0.70 s to follow");
}

static void test_a_robot_that_is_pushed(void)
{
    driven_record(&robot, &plan, 1, &record);
    for (size_t i = record.sight_count / 2; i < record.sight_count; i++)
        record.sight[i].x += 0.05;
    assert_refused("no two wheels drive as it did");
}

/* The same wheels as a trial finds them: off by far without their parameters, and by nothing when
 * each is given what it needs. */
static void test_trials(void)
{
    robot.noisy = true;
    robot.heading = 0.1;
    robot.ahead = 0.04;
    robot.aside = 0.03;
    driven_record(&robot, &plan, 1, &record);
    assert_fits(1e-3, 1e-3, 1e-4, 2e-3);
    drive_plan_trial(&plan, &small, small.track);
    driven_record(&robot, &plan, 2, &record);
    TEST_ASSERT_TRUE(wheel_fit_trial_error(&record, &small, small.track, &fit) > 0.05);

    robot.gain[WHEEL_LEFT] = robot.gain[WHEEL_RIGHT] = 1;
    robot.dead[WHEEL_LEFT] = robot.dead[WHEEL_RIGHT] = 0;
    drive_plan_trial(&plan, &small, fit.track);
    driven_record(&robot, &plan, 2, &record);
    TEST_ASSERT_TRUE(wheel_fit_trial_error(&record, &small, fit.track, &fit) < 0.003);
    record.sight_count = 0;
    TEST_ASSERT_TRUE(isnan(wheel_fit_trial_error(&record, &small, fit.track, &fit)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_exact);
    RUN_TEST(test_noise_and_radio);
    RUN_TEST(test_wheels_that_are_far_off);
    RUN_TEST(test_a_body_that_lies_askew_on_its_robot);
    RUN_TEST(test_too_few_sights);
    RUN_TEST(test_what_no_robot_has);
    RUN_TEST(test_a_robot_that_is_pushed);
    RUN_TEST(test_trials);
    return UNITY_END();
}
