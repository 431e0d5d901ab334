#include "histogram.h"

#include <string.h>
#include <unity.h>

static struct histogram histogram;

void setUp(void)
{
    memset(&histogram, 0, sizeof histogram);
}

void tearDown(void)
{
}

static void test_of_nothing_everything_is_0(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, (uint32_t)histogram_at(&histogram, 0.5));
}

static void test_small_values_are_exact(void)
{
    for (int us = 0; us < 60; us++)
        histogram_add(&histogram, us);
    TEST_ASSERT_EQUAL_UINT32(29, (uint32_t)histogram_at(&histogram, 0.5));
    TEST_ASSERT_EQUAL_UINT32(59, (uint32_t)histogram_at(&histogram, 1));
}

static void test_percentiles_are_right_to_3_percent_and_never_too_low(void)
{
    for (int us = 1; us <= 100000; us++)
        histogram_add(&histogram, us);
    for (int percent = 1; percent <= 100; percent++) {
        double right = percent * 1000.0;
        double got = histogram_at(&histogram, percent / 100.0);

        TEST_ASSERT_TRUE(got >= right && got <= right * 1.032);
    }
}

static void test_what_is_beyond_is_kept_as_the_most(void)
{
    histogram_add(&histogram, -5);
    histogram_add(&histogram, INT64_C(1) << 40);
    TEST_ASSERT_EQUAL_UINT32(0, (uint32_t)histogram_at(&histogram, 0.5));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, histogram.most);
    TEST_ASSERT_EQUAL_UINT64(2, histogram.count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_of_nothing_everything_is_0);
    RUN_TEST(test_small_values_are_exact);
    RUN_TEST(test_percentiles_are_right_to_3_percent_and_never_too_low);
    RUN_TEST(test_what_is_beyond_is_kept_as_the_most);
    return UNITY_END();
}
