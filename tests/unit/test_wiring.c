#include "wiring.h"

#include "driven.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static const struct drive_wheels small = {.track = 0.08, .wheel_max = 0.6};
static struct driven robot;
static struct drive_record record;
static char words[WHEEL_FIT_WORDS_MAX];

void setUp(void)
{
    robot = (struct driven){
        .wheel_max = 0.6,
        .gain = {0.8, 1.2},
        .dead = {0.05, 0.1},
        .track = 0.085,
        .lag = 0.08,
        .noisy = true,
        .latest = 0.02,
    };
}

void tearDown(void)
{
}

static bool is_right(void)
{
    struct drive_plan plan;

    drive_plan_measure(&plan, &small);
    driven_record(&robot, &plan, 7, &record);
    return wiring_is_right(&record, &small, words);
}

static void assert_told(const char *part)
{
    TEST_ASSERT_FALSE(is_right());
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, part), words);
}

static void test_as_it_should_be(void)
{
    TEST_ASSERT_TRUE_MESSAGE(is_right(), words);
}

/* A body's origin as far from the robot's middle as a wheel is. */
static void test_a_body_that_lies_askew(void)
{
    robot.ahead = 0.06;
    for (robot.aside = -0.06; robot.aside <= 0.061; robot.aside += 0.03)
        for (robot.heading = -0.2; robot.heading <= 0.21; robot.heading += 0.2)
            TEST_ASSERT_TRUE_MESSAGE(is_right(), words);
}

static void test_one_motor_turns_backwards(void)
{
    robot.gain[WHEEL_LEFT] = -0.9;
    assert_told("left motor turns backwards");
    setUp();
    robot.gain[WHEEL_RIGHT] = -0.9;
    assert_told("right motor turns backwards");
}

static void test_both_turn_backwards(void)
{
    robot.gain[WHEEL_LEFT] = robot.gain[WHEEL_RIGHT] = -1;
    assert_told("both motors turn backwards");
}

static void test_motors_are_swapped(void)
{
    robot.swapped = true;
    assert_told("its motors are swapped");
}

/* So does a robot look whose body in motion capture points to its back. */
static void test_it_drives_backwards(void)
{
    robot.heading = M_PI;
    assert_told("by pi");
    setUp();
    robot.swapped = true;
    robot.gain[WHEEL_LEFT] = robot.gain[WHEEL_RIGHT] = -1;
    assert_told("by pi");
}

static void test_it_moves_across_its_heading(void)
{
    robot.heading = M_PI / 2;
    assert_told("across its heading");
}

static void test_a_motor_does_not_turn(void)
{
    robot.gain[WHEEL_RIGHT] = 0;
    assert_told("right motor does not turn at 50 % of full PWM");
    setUp();
    robot.dead[WHEEL_LEFT] = 0.5;
    assert_told("left motor does not turn");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_as_it_should_be);
    RUN_TEST(test_a_body_that_lies_askew);
    RUN_TEST(test_one_motor_turns_backwards);
    RUN_TEST(test_both_turn_backwards);
    RUN_TEST(test_motors_are_swapped);
    RUN_TEST(test_it_drives_backwards);
    RUN_TEST(test_it_moves_across_its_heading);
    RUN_TEST(test_a_motor_does_not_turn);
    return UNITY_END();
}
