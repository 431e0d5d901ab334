#include "chip.h"
#include "limits.h"
#include "ticks.h"

#include <unity.h>

/* Cycles that the interrupt takes to latch both motors; half of what is allowed. */
#define LATENCY 60

static struct chip chip;

void setUp(void)
{
    chip_start(&chip);
}

void tearDown(void)
{
    chip_stop(&chip);
}

/* Runs until the motors are at (k, -k) and returns when that was, in cycles since timer 1
 * started. */
static uint64_t await_motors(int16_t k)
{
    uint64_t limit = avr_core_cycle(chip.core) + chip.image->f_cpu / 10;
    struct avr_motors motors = avr_core_motors(chip.core);

    while (motors.left != k || motors.right != -k) {
        TEST_ASSERT_TRUE(avr_core_run(chip.core, avr_core_cycle(chip.core) + 4));
        TEST_ASSERT_TRUE_MESSAGE(avr_core_cycle(chip.core) < limit, "the motors are not set");
        motors = avr_core_motors(chip.core);
        TEST_ASSERT_TRUE(motors.left == k || motors.left == k - 1);
    }
    return avr_core_cycle(chip.core) - avr_core_timer_start(chip.core);
}

static uint64_t cycles_of_ms(unsigned ms)
{
    return (uint64_t)chip.image->f_cpu / 1000 * ms + chip.image->f_cpu % 1000 * ms / 1000;
}

static void test_set_points_take_effect_at_a_fixed_time_after_the_tick(void)
{
    for (int16_t k = 1; k <= TICKS; k++) {
        uint64_t latched =
            (uint64_t)k * (chip.image->f_cpu / TICKS_PER_S) + cycles_of_ms(ACTUATION_MS);
        uint64_t late = k % 3 == 0 ? cycles_of_ms(2) : 0;

        TEST_ASSERT_UINT64_WITHIN(late + LATENCY, latched + late + LATENCY, await_motors(k));
        if (late > 0)
            TEST_ASSERT_GREATER_THAN_UINT64(latched + late, avr_core_cycle(chip.core));
    }
    chip_await_end(&chip);
}

static void test_the_tick_is_exactly_50_hz(void)
{
    uint64_t first = await_motors(1);

    await_motors(2);
    await_motors(3);
    for (int16_t k = 4; k <= TICKS; k++) {
        uint64_t now = await_motors(k);

        /* Idle but for the tick: every latch is as late as the first, to an instruction. */
        if (k % 3 != 0)
            TEST_ASSERT_UINT64_WITHIN(12, first + (uint64_t)(k - 1) * (chip.image->f_cpu / 50),
                                      now);
    }
}

static void test_the_longest_tick_is_kept(void)
{
    const uint8_t *data = avr_core_data(chip.core);
    unsigned longest;

    for (int16_t k = 1; k <= 4; k++)
        await_motors(k);
    longest = data[chip.image->tick_cycles_max] | data[chip.image->tick_cycles_max + 1] << 8;
    TEST_ASSERT_UINT_WITHIN(100, (unsigned)cycles_of_ms(ACTUATION_MS + 2) / 8, longest);
}

int main(int argc, char **argv)
{
    (void)argc;
    chip_path = argv[1];
    UNITY_BEGIN();
    RUN_TEST(test_set_points_take_effect_at_a_fixed_time_after_the_tick);
    RUN_TEST(test_the_tick_is_exactly_50_hz);
    RUN_TEST(test_the_longest_tick_is_kept);
    return UNITY_END();
}
