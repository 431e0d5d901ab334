#include "pace.h"

#include <unity.h>

#define MS INT64_C(1000000)
#define BEGIN (INT64_C(77) * 1000 * MS)

static struct pace pace;

void setUp(void)
{
    pace_begin(&pace, 1, BEGIN);
}

void tearDown(void)
{
}

static void assert_wait(int64_t expected_ms, int64_t at_ms)
{
    TEST_ASSERT_EQUAL_INT64(expected_ms * MS, pace_wait_ns(&pace, BEGIN + at_ms * MS));
}

static void tick(int64_t at_ms)
{
    pace_tick(&pace, BEGIN + at_ms * MS);
}

static void test_in_real_time_a_tick_is_due_every_20_ms(void)
{
    assert_wait(0, 0);
    tick(0);
    assert_wait(20, 0);
    assert_wait(5, 15);
    assert_wait(0, 20);
    tick(21);
    assert_wait(19, 21); /* what was late is made up for */
}

static void test_a_speed_is_times_real_time(void)
{
    pace_begin(&pace, 4, BEGIN);
    tick(0);
    assert_wait(5, 0);
    pace_begin(&pace, 0.1, BEGIN);
    tick(0);
    assert_wait(200, 0);
}

static void test_without_a_speed_every_tick_is_due(void)
{
    pace_begin(&pace, 0, BEGIN);
    for (int i = 0; i < 100; i++) {
        tick(0);
        assert_wait(0, 0);
    }
}

static void test_who_is_late_makes_up_for_100_ms(void)
{
    tick(0);
    tick(10000);
    for (int i = 0; i < 5; i++) {
        assert_wait(0, 10000);
        tick(10000);
    }
    assert_wait(0, 10000);
    tick(10000);
    assert_wait(20, 10000);
}

static void test_another_speed_begins_now(void)
{
    pace_begin(&pace, 0.01, BEGIN);
    tick(0);
    assert_wait(2000, 0);
    pace_set_speed(&pace, 2, BEGIN + 100 * MS);
    assert_wait(0, 100);
    tick(100);
    assert_wait(10, 100);
    pace_set_speed(&pace, 0, BEGIN + 105 * MS);
    assert_wait(0, 105);
    tick(105);
    pace_set_speed(&pace, 1, BEGIN + 5000 * MS);
    tick(5000);
    assert_wait(20, 5000); /* nothing is made up for */
}

static void test_what_is_paused_waits_for_ever_and_goes_on_as_if_nothing_had_been(void)
{
    tick(0);
    pace_pause(&pace, true, BEGIN + 1 * MS);
    TEST_ASSERT_EQUAL_INT64(PACE_NEVER, pace_wait_ns(&pace, BEGIN + 3600 * 1000 * MS));
    pace_pause(&pace, false, BEGIN + 5000 * MS);
    assert_wait(0, 5000);
    tick(5000);
    assert_wait(20, 5000);
}

static void test_a_step_is_one_tick(void)
{
    pace_pause(&pace, true, BEGIN);
    pace_step(&pace);
    assert_wait(0, 1);
    tick(1);
    TEST_ASSERT_EQUAL_INT64(PACE_NEVER, pace_wait_ns(&pace, BEGIN));
}

static void test_a_step_does_not_outlive_the_pause(void)
{
    pace_pause(&pace, true, BEGIN);
    pace_step(&pace);
    pace_pause(&pace, false, BEGIN);
    pace_pause(&pace, true, BEGIN);
    TEST_ASSERT_EQUAL_INT64(PACE_NEVER, pace_wait_ns(&pace, BEGIN));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_in_real_time_a_tick_is_due_every_20_ms);
    RUN_TEST(test_a_speed_is_times_real_time);
    RUN_TEST(test_without_a_speed_every_tick_is_due);
    RUN_TEST(test_who_is_late_makes_up_for_100_ms);
    RUN_TEST(test_another_speed_begins_now);
    RUN_TEST(test_what_is_paused_waits_for_ever_and_goes_on_as_if_nothing_had_been);
    RUN_TEST(test_a_step_is_one_tick);
    RUN_TEST(test_a_step_does_not_outlive_the_pause);
    return UNITY_END();
}
