#include "units.h"

#include <math.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_metres_are_rounded_to_the_nearest_quarter_millimetre(void)
{
    TEST_ASSERT_EQUAL_INT32(0, wide_of(0));
    TEST_ASSERT_EQUAL_INT32(4000, wide_of(1));
    TEST_ASSERT_EQUAL_INT32(-8388000, wide_of(-2097));
    TEST_ASSERT_EQUAL_INT32(1, wide_of(0.00013));
    TEST_ASSERT_EQUAL_INT32(-1, wide_of(-0.00013));
    TEST_ASSERT_EQUAL_INT32(0, wide_of(0.00012));
    TEST_ASSERT_EQUAL_INT32(0, wide_of(-0.00012));
}

static void test_angles_wrap(void)
{
    TEST_ASSERT_EQUAL_UINT16(0, angle_of(0));
    TEST_ASSERT_EQUAL_UINT16(16384, angle_of(M_PI / 2));
    TEST_ASSERT_EQUAL_UINT16(32768, angle_of(M_PI));
    TEST_ASSERT_EQUAL_UINT16(32768, angle_of(-M_PI));
    TEST_ASSERT_EQUAL_UINT16(49152, angle_of(-M_PI / 2));
    TEST_ASSERT_EQUAL_UINT16(16384, angle_of(M_PI / 2 + 200 * M_PI));
    TEST_ASSERT_EQUAL_UINT16(49152, angle_of(-M_PI / 2 - 200 * M_PI));
}

static void test_just_below_a_turn_is_0(void)
{
    TEST_ASSERT_EQUAL_UINT16(65535, angle_of(2 * M_PI * 65535.4 / 65536));
    TEST_ASSERT_EQUAL_UINT16(0, angle_of(2 * M_PI * 65535.6 / 65536));
    TEST_ASSERT_EQUAL_UINT16(0, angle_of(-1e-9));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_metres_are_rounded_to_the_nearest_quarter_millimetre);
    RUN_TEST(test_angles_wrap);
    RUN_TEST(test_just_below_a_turn_is_0);
    return UNITY_END();
}
