#include "clock.h"

#include "limits.h"

#include <unity.h>

static struct clock clock;

void setUp(void)
{
    clock = (struct clock){0};
}

void tearDown(void)
{
}

static void start(int32_t time)
{
    clock_heard(&clock, time);
    TEST_ASSERT_TRUE(clock_tick(&clock));
    TEST_ASSERT_EQUAL_INT32(time, clock.now);
}

static void test_the_first_word_sets_it(void)
{
    TEST_ASSERT_FALSE(clock_tick(&clock));
    TEST_ASSERT_FALSE(clock.set);
    start(-500);
    TEST_ASSERT_TRUE(clock.set);
}

static void test_it_goes_on_by_itself(void)
{
    start(1000);
    for (int i = 0; i < 10; i++)
        TEST_ASSERT_FALSE(clock_tick(&clock));
    TEST_ASSERT_EQUAL_INT32(1000 + 10 * TICK_MS, clock.now);
}

static void test_the_least_delayed_word_counts(void)
{
    start(1000);
    clock_heard(&clock, 1000 + TICK_MS + 30);
    clock_tick(&clock);
    TEST_ASSERT_EQUAL_INT32(1000 + TICK_MS + 30, clock.now);
    clock_heard(&clock, 1000 + 2 * TICK_MS - 15);
    clock_tick(&clock);
    TEST_ASSERT_EQUAL_INT32(1000 + 2 * TICK_MS + 30, clock.now);
}

static void test_a_fast_crystal_is_held_back(void)
{
    int32_t server = 1000;

    start(server);
    /* The robot makes 1,001 ticks in the server's 1,000; poses come without delay. */
    for (int i = 0; i < 100000; i++) {
        if (i % 1000 != 0)
            server += TICK_MS;
        clock_heard(&clock, server);
        clock_tick(&clock);
        TEST_ASSERT_TRUE(clock.now - server <= 2 * TICK_MS + 25);
        TEST_ASSERT_TRUE(clock.now >= server);
    }
}

static void test_a_server_that_starts_anew_sets_it_back(void)
{
    start(100000);
    clock_heard(&clock, -60000);
    TEST_ASSERT_TRUE(clock_tick(&clock));
    TEST_ASSERT_EQUAL_INT32(-60000, clock.now);
}

static void test_another_candidate_pulls_it_forward_a_little(void)
{
    start(70000);
    clock_heard_beacon(&clock, (uint16_t)(70000 + 60));
    clock_tick(&clock);
    TEST_ASSERT_EQUAL_INT32(70060, clock.now);
    clock_heard_beacon(&clock, (uint16_t)(70060 - 200));
    clock_tick(&clock);
    TEST_ASSERT_EQUAL_INT32(70080, clock.now);
    clock_heard_beacon(&clock, (uint16_t)(70080 + 5000));
    TEST_ASSERT_FALSE(clock_tick(&clock));
    TEST_ASSERT_EQUAL_INT32(70100, clock.now);
}

static void test_ages(void)
{
    start(65536 + 100);
    TEST_ASSERT_EQUAL_UINT16(0, clock_age(&clock, 100));
    TEST_ASSERT_EQUAL_UINT16(150, clock_age(&clock, (uint16_t)(100 - 150)));
    TEST_ASSERT_EQUAL_UINT16(0, clock_age(&clock, 130));
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, clock_age(&clock, 5000));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_first_word_sets_it);
    RUN_TEST(test_it_goes_on_by_itself);
    RUN_TEST(test_the_least_delayed_word_counts);
    RUN_TEST(test_a_fast_crystal_is_held_back);
    RUN_TEST(test_a_server_that_starts_anew_sets_it_back);
    RUN_TEST(test_another_candidate_pulls_it_forward_a_little);
    RUN_TEST(test_ages);
    return UNITY_END();
}
