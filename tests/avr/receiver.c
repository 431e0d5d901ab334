#include "atmega128.h"
#include "chip.h"

#include <unity.h>

#define RXC 0x80
#define DOR 0x08

static struct chip chip;

void setUp(void)
{
    chip_start(&chip);
    chip_await_led(&chip);
}

void tearDown(void)
{
    chip_stop(&chip);
}

static uint8_t status(void)
{
    return avr_core_data(chip.core)[UCSR0A];
}

static uint64_t arrival(uint64_t start, unsigned byte)
{
    uint64_t bits = (byte + 1) * 10;

    return start + (bits * chip.image->f_cpu + chip.image->baud / 2) / chip.image->baud;
}

static const uint8_t *some_bytes(void)
{
    static uint8_t bytes[300];

    for (unsigned i = 0; i < sizeof bytes; i++)
        bytes[i] = (uint8_t)(i * 7 + 1);
    return bytes;
}

/* To the instruction: no interrupt is on that could fetch it. */
static void test_a_byte_arrives_with_its_last_bit(void)
{
    uint64_t start = avr_core_cycle(chip.core);

    avr_core_receive(chip.core, start, some_bytes(), 1);
    avr_core_run(chip.core, arrival(start, 0) - 4);
    TEST_ASSERT_BITS(RXC, 0, status());
    avr_core_run(chip.core, arrival(start, 0));
    TEST_ASSERT_BITS(RXC, RXC, status());
}

static void test_the_fourth_byte_that_nobody_fetches_is_lost(void)
{
    uint64_t start = avr_core_cycle(chip.core);

    avr_core_receive(chip.core, start, some_bytes(), 8);
    avr_core_run(chip.core, arrival(start, 3) - 4);
    TEST_ASSERT_BITS(DOR, 0, status());
    avr_core_run(chip.core, arrival(start, 3));
    TEST_ASSERT_BITS(DOR, DOR, status());
}

static void assert_report(uint8_t count, uint8_t lost, const uint8_t *bytes)
{
    uint8_t report[2 + 255];

    chip_read(&chip, report, 2u + count);
    TEST_ASSERT_EQUAL_UINT8(count, report[0]);
    TEST_ASSERT_EQUAL_UINT8(lost, report[1]);
    if (count > 0)
        TEST_ASSERT_EQUAL_HEX8_ARRAY(bytes, report + 2, count);
    chip_await_end(&chip);
}

static void test_an_overrun_is_counted(void)
{
    chip_write(&chip, some_bytes(), 8);
    assert_report(3, 1, some_bytes());
}

static void test_what_does_not_fit_into_the_ring_is_counted(void)
{
    assert_report(0, 0, NULL);
    chip_write(&chip, some_bytes(), 300);
    assert_report(255, 45, some_bytes());
}

int main(int argc, char **argv)
{
    (void)argc;
    chip_path = argv[1];
    UNITY_BEGIN();
    RUN_TEST(test_a_byte_arrives_with_its_last_bit);
    RUN_TEST(test_the_fourth_byte_that_nobody_fetches_is_lost);
    RUN_TEST(test_an_overrun_is_counted);
    RUN_TEST(test_what_does_not_fit_into_the_ring_is_counted);
    return UNITY_END();
}
