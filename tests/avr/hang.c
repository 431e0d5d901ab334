#include "chip.h"

#include <unity.h>

#define PORF 1
#define WDRF 8

static struct chip chip;

void setUp(void)
{
    chip_start(&chip);
}

void tearDown(void)
{
    chip_stop(&chip);
}

static uint8_t read_byte(void)
{
    uint8_t byte;

    chip_read(&chip, &byte, 1);
    return byte;
}

static void assert_motors(int16_t left, int16_t right)
{
    struct avr_motors motors = avr_core_motors(chip.core);

    TEST_ASSERT_EQUAL_INT16(left, motors.left);
    TEST_ASSERT_EQUAL_INT16(right, motors.right);
}

static void test_a_hung_image_is_reset_with_its_motors_off(void)
{
    TEST_ASSERT_EQUAL_HEX8(PORF, read_byte());
    TEST_ASSERT_EQUAL_UINT8(0, read_byte());
    chip_run_us(&chip, 240000);
    TEST_ASSERT_EQUAL(0, avr_core_resets(chip.core));
    assert_motors(1000, -1000);
    chip_run_us(&chip, 60000);
    TEST_ASSERT_EQUAL(1, avr_core_resets(chip.core));
    assert_motors(0, 0);
    TEST_ASSERT_EQUAL_HEX8(WDRF, read_byte());
    TEST_ASSERT_EQUAL_UINT8(1, read_byte());
    chip_await_end(&chip);
}

int main(int argc, char **argv)
{
    (void)argc;
    chip_path = argv[1];
    UNITY_BEGIN();
    RUN_TEST(test_a_hung_image_is_reset_with_its_motors_off);
    return UNITY_END();
}
