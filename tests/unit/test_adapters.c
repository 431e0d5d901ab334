#include "adapters.h"

#include <string.h>
#include <unity.h>

#define SECOND INT64_C(1000000)
#define ROBOTS_MAX 16

static const struct link_adapter three[] = {
    {.number = 0, .address = {0, 0, 0, 0, 0, 1}, .up = true},
    {.number = 1, .address = {0, 0, 0, 0, 0, 2}, .up = true},
    {.number = 4, .address = {0, 0, 0, 0, 0, 3}, .up = true},
};

static struct adapters adapters;
static struct adapter_caller callers[ROBOTS_MAX];
static char error[160];

void setUp(void)
{
    memset(&adapters, 0, sizeof adapters);
    memset(callers, 0, sizeof callers);
    for (size_t i = 0; i < ROBOTS_MAX; i++)
        callers[i] = (struct adapter_caller){.bluetooth = true, .wanted = -1, .waits = true};
}

void tearDown(void)
{
}

static bool spread(size_t adapter_count, size_t robots)
{
    adapters_refresh(&adapters, three, adapter_count, callers, 0);
    return adapters_spread(&adapters, callers, robots, error, sizeof error);
}

static size_t robots_of(size_t place)
{
    return adapters.adapter[place].seen.robots;
}

static void begin(size_t robot, int64_t now_us)
{
    adapters_begin(&adapters, &callers[robot], now_us);
}

/* As a link does: a robot that is not connected waits again. */
static void end(size_t robot, enum adapter_outcome outcome, int64_t now_us)
{
    callers[robot].waits = outcome != ADAPTER_CONNECTED;
    callers[robot].due_us = now_us;
    adapters_end(&adapters, &callers[robot], outcome, now_us);
}

static void test_robots_are_spread_evenly(void)
{
    TEST_ASSERT_TRUE(spread(3, 8));
    TEST_ASSERT_EQUAL_UINT(3, robots_of(0));
    TEST_ASSERT_EQUAL_UINT(3, robots_of(1));
    TEST_ASSERT_EQUAL_UINT(2, robots_of(2));
}

static void test_wishes_come_first(void)
{
    for (size_t i = 7; i < 14; i++)
        callers[i].wanted = 0;
    TEST_ASSERT_TRUE(spread(2, 14));
    for (size_t i = 0; i < 14; i++)
        TEST_ASSERT_EQUAL_UINT(i >= 7 ? 0 : 1, callers[i].own);
}

static void test_seven_robots_an_adapter(void)
{
    TEST_ASSERT_TRUE(spread(2, 14));
    setUp();
    TEST_ASSERT_FALSE(spread(2, 15));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, "this host has 2"), error);
    setUp();
    for (size_t i = 0; i < 8; i++)
        callers[i].wanted = 4;
    TEST_ASSERT_FALSE(spread(3, 8));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, "hci4: an adapter has at most 7"), error);
}

static void test_no_such_adapter(void)
{
    callers[0].wanted = 3;
    TEST_ASSERT_FALSE(spread(3, 1));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, "hci3"), error);
    setUp();
    TEST_ASSERT_FALSE(spread(0, 1));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, "this host has 0"), error);
    setUp();
    callers[0].bluetooth = false;
    TEST_ASSERT_TRUE(spread(0, 1));
    TEST_ASSERT_EQUAL_UINT(1, adapters_next(&adapters, callers, 1, 0));
}

static void test_one_dial_at_a_time_an_adapter(void)
{
    TEST_ASSERT_TRUE(spread(2, 4)); /* 0 and 2 are hci0's, 1 and 3 hci1's */
    TEST_ASSERT_EQUAL_UINT(0, adapters_next(&adapters, callers, 4, 0));
    begin(0, 0);
    TEST_ASSERT_EQUAL_UINT(1, adapters_next(&adapters, callers, 4, 0));
    begin(1, 0);
    TEST_ASSERT_EQUAL_UINT(4, adapters_next(&adapters, callers, 4, 0));
    end(1, ADAPTER_CONNECTED, 0);
    TEST_ASSERT_EQUAL_UINT(3, adapters_next(&adapters, callers, 4, 0));
    begin(3, 0);
    end(0, ADAPTER_FAILED, 0);
    callers[0].due_us = SECOND;
    TEST_ASSERT_EQUAL_UINT(2, adapters_next(&adapters, callers, 4, 0));
}

static void test_who_waits_longest_is_dialled_first(void)
{
    TEST_ASSERT_TRUE(spread(1, 3));
    callers[0].due_us = 3 * SECOND;
    callers[1].due_us = 1 * SECOND;
    callers[2].due_us = 2 * SECOND;
    TEST_ASSERT_EQUAL_UINT(3, adapters_next(&adapters, callers, 3, 0));
    TEST_ASSERT_EQUAL_UINT(1, adapters_next(&adapters, callers, 3, 4 * SECOND));
}

static void test_absent_robots_come_last(void)
{
    TEST_ASSERT_TRUE(spread(1, 3));
    begin(0, 0);
    end(0, ADAPTER_ABSENT, 5 * SECOND);
    callers[1].due_us = 6 * SECOND;
    callers[2].due_us = 6 * SECOND;
    TEST_ASSERT_EQUAL_UINT(0, adapters_next(&adapters, callers, 3, 5 * SECOND));
    TEST_ASSERT_EQUAL_UINT(1, adapters_next(&adapters, callers, 3, 6 * SECOND));
    begin(1, 6 * SECOND);
    end(1, ADAPTER_CONNECTED, 6 * SECOND);
    TEST_ASSERT_EQUAL_UINT(2, adapters_next(&adapters, callers, 3, 6 * SECOND));
    begin(0, 6 * SECOND);
    end(0, ADAPTER_CONNECTED, 6 * SECOND);
    callers[0].waits = true; /* lost: once it has answered it is as good as any */
    TEST_ASSERT_EQUAL_UINT(0, adapters_next(&adapters, callers, 3, 6 * SECOND));
}

/* Who is connected has the air for as long as a page in vain took it. */
static void test_paging_in_vain_is_followed_by_a_rest(void)
{
    TEST_ASSERT_TRUE(spread(1, 3));
    begin(0, 0);
    end(0, ADAPTER_CONNECTED, 0);
    begin(1, 0);
    end(1, ADAPTER_ABSENT, 5 * SECOND);
    callers[2].due_us = 7 * SECOND;
    TEST_ASSERT_EQUAL_UINT(3, adapters_next(&adapters, callers, 3, 6 * SECOND));
    TEST_ASSERT_EQUAL_UINT(2, adapters_next(&adapters, callers, 3, 7 * SECOND));
    callers[2].due_us = 20 * SECOND;
    TEST_ASSERT_EQUAL_UINT(1, adapters_next(&adapters, callers, 3, 10 * SECOND));
    callers[0].waits = true;
    adapters_lose(&adapters, &callers[0]);
    begin(1, 10 * SECOND);
    end(1, ADAPTER_ABSENT, 15 * SECOND);
    TEST_ASSERT_EQUAL_UINT(0, adapters_next(&adapters, callers, 3, 15 * SECOND));
    callers[0].waits = false;
    TEST_ASSERT_EQUAL_UINT(1, adapters_next(&adapters, callers, 3, 15 * SECOND));
}

static void test_an_absent_robot_tries_another_adapter(void)
{
    callers[1].wanted = 1;
    TEST_ASSERT_TRUE(spread(2, 2));
    TEST_ASSERT_EQUAL_UINT(0, callers[0].own);
    begin(0, 0);
    end(0, ADAPTER_ABSENT, 5 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, callers[0].own);
    TEST_ASSERT_EQUAL_UINT(0, robots_of(0));
    TEST_ASSERT_EQUAL_UINT(2, robots_of(1));
    begin(1, 5 * SECOND);
    end(1, ADAPTER_ABSENT, 10 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, callers[1].own); /* as it wants */
}

/* 0 and 2 are hci0's, 1 is hci1's: 2 does not wait for 0 any longer than it has to. */
static void test_an_idle_adapter_helps_out(void)
{
    callers[1].wanted = 1;
    TEST_ASSERT_TRUE(spread(2, 3));
    begin(0, 0);
    begin(1, 0);
    TEST_ASSERT_EQUAL_UINT(3, adapters_next(&adapters, callers, 3, 2 * SECOND)); /* both are busy */
    end(1, ADAPTER_ABSENT, SECOND);
    TEST_ASSERT_EQUAL_UINT(1, adapters_next(&adapters, callers, 3, SECOND));
    TEST_ASSERT_EQUAL_UINT(2, adapters_next(&adapters, callers, 3, 2 * SECOND));
    TEST_ASSERT_EQUAL_UINT(1, callers[2].own);
    TEST_ASSERT_EQUAL_UINT(1, robots_of(0));
    TEST_ASSERT_EQUAL_UINT(2, robots_of(1));
}

static void test_an_idle_adapter_takes_no_robot_of_another(void)
{
    callers[1].wanted = 0;
    TEST_ASSERT_TRUE(spread(2, 2));
    callers[0].own = 0; /* both with hci0 */
    begin(0, 0);
    TEST_ASSERT_EQUAL_UINT(2, adapters_next(&adapters, callers, 2, 2 * SECOND));
    TEST_ASSERT_EQUAL_UINT(0, callers[1].own);
}

static void test_no_adapter_takes_an_eighth(void)
{
    TEST_ASSERT_TRUE(spread(2, 14));
    begin(0, 0);
    end(0, ADAPTER_ABSENT, 5 * SECOND);
    TEST_ASSERT_EQUAL_UINT(7, robots_of(0));
    TEST_ASSERT_EQUAL_UINT(7, robots_of(1));
}

static void test_an_adapter_is_unplugged_and_plugged_in_again(void)
{
    callers[2].wanted = 0;
    TEST_ASSERT_TRUE(spread(2, 3)); /* 0 and 2 hci0's, or 1 and 2 */
    adapters_refresh(&adapters, &three[1], 1, callers, 3);
    TEST_ASSERT_FALSE(adapters.adapter[0].seen.up);
    TEST_ASSERT_EQUAL_UINT(1, callers[0].own);
    TEST_ASSERT_EQUAL_UINT(1, callers[1].own);
    TEST_ASSERT_EQUAL_UINT(0, callers[2].own);
    callers[0].waits = callers[1].waits = false;
    TEST_ASSERT_EQUAL_UINT(3, adapters_next(&adapters, callers, 3, 0));
    adapters_refresh(&adapters, three, 3, callers, 3);
    TEST_ASSERT_EQUAL_UINT(2, adapters_next(&adapters, callers, 3, 0));
    TEST_ASSERT_EQUAL_UINT(3, adapters.count);
    TEST_ASSERT_EQUAL_UINT8(3, adapters.adapter[2].seen.address[5]);
}

static void test_kernels_that_crash(void)
{
    TEST_ASSERT_NOT_NULL(adapters_warn("6.1.0-55-amd64"));
    TEST_ASSERT_NOT_NULL(adapters_warn("6.1.0-56-rt-arm64"));
    TEST_ASSERT_NULL(adapters_warn("6.1.0-54-amd64"));
    TEST_ASSERT_NULL(adapters_warn("6.1.0-5-amd64"));
    TEST_ASSERT_NULL(adapters_warn("6.12.117+deb13-amd64"));
    TEST_ASSERT_NULL(adapters_warn(""));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_robots_are_spread_evenly);
    RUN_TEST(test_wishes_come_first);
    RUN_TEST(test_seven_robots_an_adapter);
    RUN_TEST(test_no_such_adapter);
    RUN_TEST(test_one_dial_at_a_time_an_adapter);
    RUN_TEST(test_who_waits_longest_is_dialled_first);
    RUN_TEST(test_absent_robots_come_last);
    RUN_TEST(test_paging_in_vain_is_followed_by_a_rest);
    RUN_TEST(test_an_absent_robot_tries_another_adapter);
    RUN_TEST(test_an_idle_adapter_helps_out);
    RUN_TEST(test_an_idle_adapter_takes_no_robot_of_another);
    RUN_TEST(test_no_adapter_takes_an_eighth);
    RUN_TEST(test_an_adapter_is_unplugged_and_plugged_in_again);
    RUN_TEST(test_kernels_that_crash);
    return UNITY_END();
}
