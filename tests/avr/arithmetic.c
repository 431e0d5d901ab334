#include "arithmetic.h"

#include "chip.h"

#include <unity.h>

static struct chip chip;

void setUp(void)
{
    chip_start(&chip);
}

void tearDown(void)
{
    chip_stop(&chip);
}

static void test_the_chip_computes_the_same_bits(void)
{
    for (uint8_t i = 0; i < ARITHMETIC_FUNCTIONS; i++) {
        uint8_t bytes[4];
        uint32_t hash;

        chip_read(&chip, bytes, sizeof bytes);
        hash = bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
               (uint32_t)bytes[3] << 24;
        TEST_ASSERT_EQUAL_HEX32(arithmetic_hash(i), hash);
    }
    chip_await_end(&chip);
}

int main(int argc, char **argv)
{
    (void)argc;
    chip_path = argv[1];
    UNITY_BEGIN();
    RUN_TEST(test_the_chip_computes_the_same_bits);
    return UNITY_END();
}
