#include "guard.h"

#include <unity.h>

static struct guard_limits limits;
static struct guard_robot robots[4];

void setUp(void)
{
    limits = (struct guard_limits){true, {-2, -1, 2, 1}, 0.2};
    for (size_t i = 0; i < 4; i++)
        robots[i] = (struct guard_robot){true, (double)i - 1.5, 0};
}

void tearDown(void)
{
}

static void test_robots_inside_and_apart_are_good(void)
{
    TEST_ASSERT_EQUAL(GUARD_GOOD, guard_judge(&limits, robots, 4).finding);
}

static void test_the_fence_itself_is_inside(void)
{
    robots[0] = (struct guard_robot){true, -2, -1};
    robots[3] = (struct guard_robot){true, 2, 1};
    TEST_ASSERT_EQUAL(GUARD_GOOD, guard_judge(&limits, robots, 4).finding);
}

static void test_who_is_farthest_out_is_named(void)
{
    robots[1].y = 1.1;
    robots[2] = (struct guard_robot){true, 2.3, -1.4};
    struct guard_alarm alarm = guard_judge(&limits, robots, 4);
    TEST_ASSERT_EQUAL(GUARD_FENCE, alarm.finding);
    TEST_ASSERT_EQUAL_UINT64(2, alarm.robot);
    TEST_ASSERT_TRUE(alarm.distance > 0.4999 && alarm.distance < 0.5001);
}

static void test_the_nearest_pair_is_named(void)
{
    robots[1].x = robots[0].x + 0.19;
    robots[3].x = robots[2].x + 0.1;
    struct guard_alarm alarm = guard_judge(&limits, robots, 4);
    TEST_ASSERT_EQUAL(GUARD_SEPARATION, alarm.finding);
    TEST_ASSERT_EQUAL_UINT64(2, alarm.robot);
    TEST_ASSERT_EQUAL_UINT64(3, alarm.other);
    TEST_ASSERT_TRUE(alarm.distance > 0.0999 && alarm.distance < 0.1001);
}

static void test_who_is_nowhere_is_neither_out_nor_near(void)
{
    robots[0] = (struct guard_robot){false, 50, 0};
    robots[1] = (struct guard_robot){false, robots[2].x, 0};
    TEST_ASSERT_EQUAL(GUARD_GOOD, guard_judge(&limits, robots, 4).finding);
}

static void test_what_is_not_limited_is_allowed(void)
{
    limits.fenced = false;
    limits.separation = 0;
    robots[0].x = 100;
    robots[1].x = robots[2].x;
    TEST_ASSERT_EQUAL(GUARD_GOOD, guard_judge(&limits, robots, 4).finding);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_robots_inside_and_apart_are_good);
    RUN_TEST(test_the_fence_itself_is_inside);
    RUN_TEST(test_who_is_farthest_out_is_named);
    RUN_TEST(test_the_nearest_pair_is_named);
    RUN_TEST(test_who_is_nowhere_is_neither_out_nor_near);
    RUN_TEST(test_what_is_not_limited_is_allowed);
    return UNITY_END();
}
