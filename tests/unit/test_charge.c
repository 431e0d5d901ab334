#include "charge.h"

#include <unity.h>

static struct charge charge;
static struct parameters parameters;

void setUp(void)
{
    charge = (struct charge){0};
    parameters_default(&parameters);
    parameters.value[PARAMETER_BATTERY_WARNING] = 6600;
    parameters.value[PARAMETER_BATTERY_CRITICAL] = 6200;
}

void tearDown(void)
{
}

static void watch(uint16_t millivolts, int ticks)
{
    for (int i = 0; i < ticks; i++)
        charge_watch(&charge, millivolts, &parameters);
}

static void test_a_full_battery_is_no_news(void)
{
    watch(7400, 1000);
    watch(6600, 1000);
    TEST_ASSERT_FALSE(charge.warns);
    TEST_ASSERT_FALSE(charge.spent);
}

static void test_it_warns_after_a_second(void)
{
    watch(6599, CHARGE_TICKS - 1);
    TEST_ASSERT_FALSE(charge.warns);
    watch(6599, 1);
    TEST_ASSERT_TRUE(charge.warns);
    TEST_ASSERT_FALSE(charge.spent);
}

static void test_a_dip_is_not_a_second(void)
{
    for (int i = 0; i < 20; i++) {
        watch(6000, CHARGE_TICKS - 1);
        watch(6600, 1);
    }
    TEST_ASSERT_FALSE(charge.warns);
    TEST_ASSERT_FALSE(charge.spent);
}

static void test_the_warning_goes_when_there_is_clearly_more(void)
{
    watch(6599, CHARGE_TICKS);
    watch(6799, 1000);
    TEST_ASSERT_TRUE(charge.warns);
    watch(6800, 1);
    TEST_ASSERT_FALSE(charge.warns);
}

static void test_spent_is_for_good(void)
{
    watch(6199, CHARGE_TICKS - 1);
    TEST_ASSERT_FALSE(charge.spent);
    watch(6199, 1);
    TEST_ASSERT_TRUE(charge.spent);
    watch(7400, 1000);
    TEST_ASSERT_TRUE(charge.spent);
    TEST_ASSERT_FALSE(charge.warns);
}

static void test_how_long_it_has_been_spent(void)
{
    watch(6000, CHARGE_TICKS);
    TEST_ASSERT_EQUAL_UINT8(0, charge.spent_for);
    watch(6000, CHARGE_HANDOVER_TICKS - 1);
    TEST_ASSERT_EQUAL_UINT8(CHARGE_HANDOVER_TICKS - 1, charge.spent_for);
    watch(0, 1000);
    TEST_ASSERT_EQUAL_UINT8(CHARGE_HANDOVER_TICKS, charge.spent_for);
}

static void test_what_is_not_measured_yet_is_not_low(void)
{
    watch(0, 1000);
    TEST_ASSERT_FALSE(charge.warns);
    TEST_ASSERT_FALSE(charge.spent);
    watch(6000, CHARGE_TICKS / 2);
    watch(0, 1000);
    TEST_ASSERT_FALSE(charge.warns);
    watch(6000, CHARGE_TICKS / 2);
    TEST_ASSERT_TRUE(charge.warns);
}

static void test_a_threshold_of_0_is_never_met(void)
{
    parameters.value[PARAMETER_BATTERY_WARNING] = 0;
    parameters.value[PARAMETER_BATTERY_CRITICAL] = 0;
    watch(1, 1000);
    TEST_ASSERT_FALSE(charge.warns);
    TEST_ASSERT_FALSE(charge.spent);
}

static void test_a_threshold_set_to_0_ends_the_warning(void)
{
    watch(100, CHARGE_TICKS);
    TEST_ASSERT_TRUE(charge.warns);
    parameters.value[PARAMETER_BATTERY_WARNING] = 0;
    watch(100, 1);
    TEST_ASSERT_FALSE(charge.warns);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_full_battery_is_no_news);
    RUN_TEST(test_it_warns_after_a_second);
    RUN_TEST(test_a_dip_is_not_a_second);
    RUN_TEST(test_the_warning_goes_when_there_is_clearly_more);
    RUN_TEST(test_spent_is_for_good);
    RUN_TEST(test_how_long_it_has_been_spent);
    RUN_TEST(test_what_is_not_measured_yet_is_not_low);
    RUN_TEST(test_a_threshold_of_0_is_never_met);
    RUN_TEST(test_a_threshold_set_to_0_ends_the_warning);
    return UNITY_END();
}
