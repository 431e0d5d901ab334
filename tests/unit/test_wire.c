#include "wire.h"

#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_numbers_are_little_endian(void)
{
    static const uint8_t bytes[] = {0x01, 0x02, 0x80, 0xFF, 0xFF, 0x7F, 0xFE, 0xFF, 0xFF, 0xFF};
    const uint8_t *in = bytes;

    TEST_ASSERT_EQUAL_HEX8(0x01, take_u8(&in));
    TEST_ASSERT_EQUAL_HEX16(0x8002, take_u16(&in));
    TEST_ASSERT_EQUAL_INT32(8388607, take_i24(&in));
    TEST_ASSERT_EQUAL_INT32(-2, take_i32(&in));
    TEST_ASSERT_EQUAL_PTR(bytes + sizeof bytes, in);
}

static void test_what_is_put_is_taken_again(void)
{
    uint8_t bytes[10];
    uint8_t *out = bytes;
    const uint8_t *in = bytes;

    put_u8(&out, 0xA5);
    put_u16(&out, 0x1234);
    put_i24(&out, -7654321);
    put_i32(&out, -2000000000);
    TEST_ASSERT_EQUAL_PTR(bytes + sizeof bytes, out);
    TEST_ASSERT_EQUAL_HEX8(0xA5, take_u8(&in));
    TEST_ASSERT_EQUAL_HEX16(0x1234, take_u16(&in));
    TEST_ASSERT_EQUAL_INT32(-7654321, take_i24(&in));
    TEST_ASSERT_EQUAL_INT32(-2000000000, take_i32(&in));
}

static int32_t through_24_bits(int32_t value)
{
    uint8_t bytes[3];
    uint8_t *out = bytes;
    const uint8_t *in = bytes;

    put_i24(&out, value);
    return take_i24(&in);
}

static void test_positions_saturate_at_24_bits(void)
{
    TEST_ASSERT_EQUAL_INT32(-1, through_24_bits(-1));
    TEST_ASSERT_EQUAL_INT32(8388607, through_24_bits(8388607));
    TEST_ASSERT_EQUAL_INT32(8388607, through_24_bits(8388608));
    TEST_ASSERT_EQUAL_INT32(8388607, through_24_bits(INT32_MAX));
    TEST_ASSERT_EQUAL_INT32(-8388607, through_24_bits(-8388607));
    TEST_ASSERT_EQUAL_INT32(-8388607, through_24_bits(-8388608));
    TEST_ASSERT_EQUAL_INT32(-8388607, through_24_bits(INT32_MIN));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_numbers_are_little_endian);
    RUN_TEST(test_what_is_put_is_taken_again);
    RUN_TEST(test_positions_saturate_at_24_bits);
    return UNITY_END();
}
