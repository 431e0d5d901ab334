#include "ground.h"

#include "limits.h"

#include <unity.h>

#define MS 1000
#define FULL PWM_STEPS
#define START (INT64_C(5) * 1000000)

/* 1 m/s at full scale, one robot along x and one along -x. */
static struct scenario_robot robots[] = {{.id = 7, .x = 1, .y = 2}, {.id = 9, .theta = 3.14159265}};
static struct scenario scenario = {
    .robot_count = 2,
    .robots = robots,
    .body = BODY_IDEAL,
    .v_max = 1,
};
static struct ground *ground;

void setUp(void)
{
    ground = ground_new(&scenario, START);
    TEST_ASSERT_NOT_NULL(ground);
}

void tearDown(void)
{
    ground_free(ground);
}

static void set(uint16_t id, int16_t both, int64_t after_us)
{
    ground_set(ground, (struct setpoint){id, both, both}, START + after_us);
}

static void assert_way(double expected, int64_t after_us)
{
    ground_move(ground, START + after_us);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1 + expected, ground_look(ground, 0)->x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2, ground_look(ground, 0)->y);
}

static void test_robots_start_where_the_scenario_has_them(void)
{
    assert_way(0, 1000 * MS);
    TEST_ASSERT_DOUBLE_WITHIN(1e-7, 3.14159265, ground_look(ground, 1)->theta);
    TEST_ASSERT_TRUE(ground_look(ground, 0)->held);
}

static void test_set_points_take_effect_after_the_actuation(void)
{
    set(7, FULL, 0);
    assert_way(0, ACTUATION_MS * MS);
    assert_way(0.015, (ACTUATION_MS + 15) * MS);
}

/* However seldom it is looked at. */
static void test_motion_is_exact_between_looks(void)
{
    set(7, FULL, 0);
    set(7, FULL / 3, 20 * MS);
    set(7, -FULL, 47 * MS);
    assert_way(0.020 + 0.027 / 3 - 0.040, (47 + 5 + 40) * MS);
}

static void test_only_the_robot_that_is_meant_moves(void)
{
    set(9, FULL, 0);
    set(8, FULL, 0);
    set(UINT16_MAX, FULL, 0);
    assert_way(0, 15 * MS);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -0.010, ground_look(ground, 1)->x);
}

static void test_a_silent_robot_stands_still(void)
{
    set(7, FULL, 0);
    assert_way(0.095, 5000 * MS);
    TEST_ASSERT_TRUE(ground_look(ground, 0)->held);
    TEST_ASSERT_TRUE(body_v(ground_look(ground, 0)) == 0);
}

static void test_a_robot_that_is_back_waits_for_its_set_points(void)
{
    set(7, FULL, 0);
    set(7, FULL, 300 * MS);
    assert_way(0.095, 305 * MS);
    assert_way(0.095 + 0.010, 315 * MS);
}

/* Two ticks that were caught up with at once: the first one's time, the second one's values. */
static void test_of_two_at_once_the_later_counts(void)
{
    set(7, -FULL, 0);
    set(7, FULL, 1 * MS);
    assert_way(0.010, 15 * MS);
}

/* As in a simulation in virtual time. */
static void test_each_robot_has_its_own_body(void)
{
    struct scenario scattered = scenario;

    scattered.body = BODY_SMALL;
    scattered.scatter = 0.1;
    tearDown();
    ground = ground_new(&scattered, START);
    TEST_ASSERT_NOT_NULL(ground);
    for (int i = 0; i <= 20; i++) {
        set(7, FULL, i * 50 * MS);
        set(9, FULL, i * 50 * MS);
    }
    ground_move(ground, START + 1000 * MS);
    for (size_t i = 0; i < 2; i++) {
        struct body_kind kind = body_kind_of(&scattered, robots[i].id);

        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.6 * kind.left.gain, ground_look(ground, i)->left);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.6 * kind.right.gain, ground_look(ground, i)->right);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_robots_start_where_the_scenario_has_them);
    RUN_TEST(test_set_points_take_effect_after_the_actuation);
    RUN_TEST(test_motion_is_exact_between_looks);
    RUN_TEST(test_only_the_robot_that_is_meant_moves);
    RUN_TEST(test_a_silent_robot_stands_still);
    RUN_TEST(test_a_robot_that_is_back_waits_for_its_set_points);
    RUN_TEST(test_of_two_at_once_the_later_counts);
    RUN_TEST(test_each_robot_has_its_own_body);
    return UNITY_END();
}
