#include "chip.h"
#include "crashes.h"

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

static bool runs(uint8_t crash)
{
    avr_core_write_eeprom(chip.core, 0, &crash, 1);
    return avr_core_run(chip.core, 1000000);
}

static void test_a_core_that_does_nothing_wrong_runs_on(void)
{
    TEST_ASSERT_TRUE(runs(NONE));
}

static void test_sleep_that_nothing_can_end_is_a_crash(void)
{
    TEST_ASSERT_FALSE(runs(SLEEP_FOR_EVER));
}

static void test_a_write_beyond_the_ram_is_a_crash(void)
{
    TEST_ASSERT_FALSE(runs(WRITE_BEYOND_RAM));
}

static void test_an_illegal_instruction_is_a_crash(void)
{
    TEST_ASSERT_FALSE(runs(ILLEGAL_INSTRUCTION));
}

static void test_a_stack_that_met_the_variables_is_told(void)
{
    runs(NONE);
    TEST_ASSERT_FALSE(avr_core_stack_overflown(chip.core));
    chip_stop(&chip);
    chip_start(&chip);
    runs(STACK_OVERFLOW);
    TEST_ASSERT_TRUE(avr_core_stack_overflown(chip.core));
    TEST_ASSERT_EQUAL(0, avr_core_stack_free(chip.core));
}

static void test_a_stack_that_passed_the_variables_without_a_trace_is_seen_by_who_watches(void)
{
    TEST_ASSERT_TRUE(runs(LARGE_FRAME));
    TEST_ASSERT_FALSE(avr_core_stack_overflown(chip.core));
    TEST_ASSERT_GREATER_THAN(0, avr_core_stack_free(chip.core));
    chip_stop(&chip);
    chip_start(&chip);
    avr_core_watch_stack(chip.core);
    TEST_ASSERT_FALSE(runs(LARGE_FRAME));
    TEST_ASSERT_TRUE(avr_core_stack_overflown(chip.core));
    TEST_ASSERT_EQUAL(0, avr_core_stack_free(chip.core));
}

static void test_a_robot_says_that_it_has_crashed(void)
{
    struct sim_robot *robot = robot_avr_new(1, chip.image); /* byte 0 is 1: beyond the RAM */
    struct robot_period period;

    TEST_ASSERT_TRUE(robot->kind->power_on(robot));
    robot->kind->run(robot, NULL, 0, &period);
    TEST_ASSERT_TRUE(period.crashed);
    TEST_ASSERT_EQUAL(0, period.sent);
    robot->kind->destroy(robot);
}

int main(int argc, char **argv)
{
    (void)argc;
    chip_path = argv[1];
    UNITY_BEGIN();
    RUN_TEST(test_a_core_that_does_nothing_wrong_runs_on);
    RUN_TEST(test_sleep_that_nothing_can_end_is_a_crash);
    RUN_TEST(test_a_write_beyond_the_ram_is_a_crash);
    RUN_TEST(test_an_illegal_instruction_is_a_crash);
    RUN_TEST(test_a_stack_that_met_the_variables_is_told);
    RUN_TEST(test_a_stack_that_passed_the_variables_without_a_trace_is_seen_by_who_watches);
    RUN_TEST(test_a_robot_says_that_it_has_crashed);
    return UNITY_END();
}
