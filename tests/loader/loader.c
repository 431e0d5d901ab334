/* loader.c: the boot loader with a chip around it, byte by byte. */
#include "flash_map.h"
#include "orders.h"
#include "station.h"

#include <string.h>
#include <unity.h>

enum { POWER_ON = 1, EXTERNAL = 2, WATCHDOG = 8, RESTART = 0 };

#define WINDOW_US 1000000
#define SILENCE_US 10000000

/* Checks of both slots and an installation are over by then. */
#define BOOT_US 200000

static struct avr_image *loader, *program_a, *program_b;
static struct station station;

void setUp(void)
{
    station_begin(&station, loader, program_a);
}

void tearDown(void)
{
    station_end(&station);
}

/* It starts within `us` and tells why it was reset. */
static void assert_runs(char name, uint8_t cause, uint32_t us)
{
    TEST_ASSERT_EQUAL_INT(name, station_hear(&station, us));
    TEST_ASSERT_EQUAL_INT(cause, station_hear(&station, BOOT_US));
}

static void test_after_power_on_a_second_passes_and_the_program_runs(void)
{
    station_power_on(&station);
    TEST_ASSERT_EQUAL_INT(-1, station_hear(&station, WINDOW_US * 9 / 10));
    assert_runs('a', POWER_ON, WINDOW_US / 5);
}

static void test_a_program_is_replaced(void)
{
    station_power_on(&station);
    TEST_ASSERT_TRUE(station_update(&station, program_b));
    assert_runs('b', RESTART, BOOT_US);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(program_b->flash, station.flash->bytes, SLOT_BYTES);
}

int main(int argc, char **argv)
{
    (void)argc;
    loader = station_open(argv[1]);
    program_a = station_open(argv[2]);
    program_b = station_open(argv[3]);
    UNITY_BEGIN();
    RUN_TEST(test_after_power_on_a_second_passes_and_the_program_runs);
    RUN_TEST(test_a_program_is_replaced);
    avr_image_close(loader);
    avr_image_close(program_a);
    avr_image_close(program_b);
    return UNITY_END();
}
