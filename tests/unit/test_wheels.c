#include "wheels.h"

#include "limits.h"
#include "random.h"

#include <math.h>
#include <stdlib.h>
#include <unity.h>

#define TRACK (NARROW_PER_M / 10)
#define WHEEL_MAX 18000
#define V_MAX (4 * NARROW_PER_M)
#define OMEGA_MAX (10 * RATE_ONE)

static struct parameters parameters;
static struct wheels wheels;
static uint32_t state;

void setUp(void)
{
    state = 1;
    parameters_default(&parameters);
    wheels_set(&wheels, TRACK, WHEEL_MAX, &parameters);
}

void tearDown(void)
{
}

static void set(enum parameter index, uint16_t value)
{
    parameters.value[index] = value;
    wheels_set(&wheels, TRACK, WHEEL_MAX, &parameters);
}

static int16_t within(int32_t limit)
{
    return (int16_t)((int32_t)(random_next(&state) % (2 * (uint32_t)limit + 1)) - limit);
}

static struct motion_command any_command(void)
{
    int16_t v = within(V_MAX);

    return (struct motion_command){v, within(OMEGA_MAX)};
}

/* What a wheel does with its steps, by its parameters. */
static double speed_of(int16_t steps, double full, double dead)
{
    double turning = fabs((double)steps) / PWM_STEPS - dead;

    return turning <= 0 ? 0 : copysign(turning / (1 - dead) * full, steps);
}

static void assert_makes(const struct motion_command *command, struct wheel_steps steps,
                         double track)
{
    double left = speed_of(steps.left, WHEEL_MAX * parameters.value[PARAMETER_LEFT_GAIN] / 16384.0,
                           parameters.value[PARAMETER_LEFT_DEAD_BAND] / 16383.0);
    double right =
        speed_of(steps.right, WHEEL_MAX * parameters.value[PARAMETER_RIGHT_GAIN] / 16384.0,
                 parameters.value[PARAMETER_RIGHT_DEAD_BAND] / 16383.0);

    TEST_ASSERT_TRUE(fabs((left + right) / 2 - command->v) < 3);
    TEST_ASSERT_TRUE(fabs((right - left) * RATE_ONE / track - command->omega) < 12);
}

static void test_they_make_the_command(void)
{
    for (int i = 0; i < 100000; i++) {
        struct motion_command command = any_command(), before = command;
        struct wheel_steps steps = wheels_turn(&wheels, &command);

        TEST_ASSERT_EQUAL_MEMORY(&before, &command, sizeof command);
        assert_makes(&command, steps, TRACK);
    }
}

/* As the firmware had it before wheels had parameters. */
static struct wheel_steps plain_steps(struct motion_command *command)
{
    uint32_t gain = (((uint32_t)PWM_STEPS << 14) + WHEEL_MAX / 2) / WHEEL_MAX;
    int32_t half = ((int32_t)command->omega * TRACK + RATE_ONE) >> 11;
    int32_t speed[2] = {command->v - half, command->v + half};
    int16_t steps[2];
    int32_t fastest =
        labs(speed[0]) > labs(speed[1]) ? (int32_t)labs(speed[0]) : (int32_t)labs(speed[1]);

    if (fastest > WHEEL_MAX) {
        speed[0] = speed[0] * WHEEL_MAX / fastest;
        speed[1] = speed[1] * WHEEL_MAX / fastest;
        command->v = (int16_t)((int32_t)command->v * WHEEL_MAX / fastest);
        command->omega = (int16_t)((int32_t)command->omega * WHEEL_MAX / fastest);
    }
    for (int i = 0; i < 2; i++) {
        int32_t size = (int32_t)(((uint32_t)labs(speed[i]) * gain + 0x2000) >> 14);

        if (size > PWM_STEPS)
            size = PWM_STEPS;
        steps[i] = (int16_t)(speed[i] < 0 ? -size : size);
    }
    return (struct wheel_steps){steps[0], steps[1]};
}

static void test_by_default_every_bit_is_as_without_parameters(void)
{
    for (int i = 0; i < 100000; i++) {
        struct motion_command command = {within(26000), within(20 * RATE_ONE)}, plain = command;
        struct wheel_steps steps = wheels_turn(&wheels, &command), expected = plain_steps(&plain);

        TEST_ASSERT_EQUAL_MEMORY(&expected, &steps, sizeof steps);
        TEST_ASSERT_EQUAL_MEMORY(&plain, &command, sizeof command);
    }
}

static void test_they_make_it_with_wheels_that_are_not_alike(void)
{
    set(PARAMETER_LEFT_GAIN, 15000);
    set(PARAMETER_RIGHT_GAIN, 19000);
    set(PARAMETER_LEFT_DEAD_BAND, 3000);
    set(PARAMETER_RIGHT_DEAD_BAND, 900);
    set(PARAMETER_TRACK, 350);
    for (int i = 0; i < 100000; i++) {
        struct motion_command command = {within(14000), within(OMEGA_MAX)}, before = command;
        struct wheel_steps steps = wheels_turn(&wheels, &command);

        TEST_ASSERT_EQUAL_MEMORY(&before, &command, sizeof command);
        assert_makes(&command, steps, 350);
    }
}

static void test_a_wheel_that_shall_stand_gets_no_dead_band(void)
{
    struct motion_command still = {0, 0}, creeping = {1, 0};

    set(PARAMETER_LEFT_DEAD_BAND, 3000);
    set(PARAMETER_RIGHT_DEAD_BAND, 900);
    struct wheel_steps steps = wheels_turn(&wheels, &still);
    TEST_ASSERT_EQUAL_INT16(0, steps.left);
    TEST_ASSERT_EQUAL_INT16(0, steps.right);
    steps = wheels_turn(&wheels, &creeping);
    TEST_ASSERT_EQUAL_INT16(3001, steps.left);
    TEST_ASSERT_EQUAL_INT16(901, steps.right);
    creeping.v = -1;
    TEST_ASSERT_EQUAL_INT16(-3001, wheels_turn(&wheels, &creeping).left);
}

static void test_full_speed_is_full_pwm_whatever_the_dead_band(void)
{
    struct motion_command command = {WHEEL_MAX, 0};

    set(PARAMETER_LEFT_DEAD_BAND, 4915);
    struct wheel_steps steps = wheels_turn(&wheels, &command);
    TEST_ASSERT_INT16_WITHIN(1, PWM_STEPS, steps.left);
    TEST_ASSERT_EQUAL_INT16(PWM_STEPS, steps.right);
}

static void test_wheels_too_slow_keep_the_curve(void)
{
    struct motion_command command = {8000, 4 * RATE_ONE};

    wheels_set(&wheels, TRACK, 2400, &parameters);
    struct wheel_steps steps = wheels_turn(&wheels, &command);
    TEST_ASSERT_EQUAL_INT16(PWM_STEPS, steps.right);
    TEST_ASSERT_INT16_WITHIN(60, PWM_STEPS * (8000 - 800) / (8000 + 800), steps.left);
    TEST_ASSERT_INT16_WITHIN(2, 8000 * 2400 / 8800, command.v);
    TEST_ASSERT_INT16_WITHIN(2, 4 * RATE_ONE * 2400 / 8800, command.omega);
}

/* The right wheel is asked for more, and the left one can do less. */
static void test_the_slower_wheel_sets_the_pace(void)
{
    struct motion_command command = {16000, RATE_ONE / 2};

    set(PARAMETER_LEFT_GAIN, 8192);
    struct wheel_steps steps = wheels_turn(&wheels, &command);
    TEST_ASSERT_INT16_WITHIN(2, PWM_STEPS, steps.left);
    TEST_ASSERT_INT16_WITHIN(2, 16000 * 9000 / 15900, command.v);
    TEST_ASSERT_INT16_WITHIN(2, RATE_ONE / 2 * 9000 / 15900, command.omega);
    assert_makes(&command, steps, TRACK);
}

static void test_every_command_stays_within_the_steps(void)
{
    for (int i = 0; i < 200000; i++) {
        struct motion_command command = {within(INT16_MAX), within(INT16_MAX)};
        uint16_t wheel_max = (uint16_t)(random_next(&state) % INT16_MAX + 1);

        parameters.value[PARAMETER_LEFT_GAIN] = (uint16_t)(8192 + random_next(&state) % 16385);
        parameters.value[PARAMETER_RIGHT_GAIN] = (uint16_t)(8192 + random_next(&state) % 16385);
        parameters.value[PARAMETER_LEFT_DEAD_BAND] = (uint16_t)(random_next(&state) % 4916);
        wheels_set(&wheels, TRACK, (int16_t)wheel_max, &parameters);
        struct motion_command before = command;
        struct wheel_steps steps = wheels_turn(&wheels, &command);
        TEST_ASSERT_TRUE(abs32(steps.left) <= PWM_STEPS && abs32(steps.right) <= PWM_STEPS);
        TEST_ASSERT_TRUE(abs32(command.v) <= abs32(before.v));
        TEST_ASSERT_TRUE((int32_t)command.v * before.v >= 0);
    }
}

static void test_a_trial_is_corrected_in_parts_of_full_speed(void)
{
    set(PARAMETER_LEFT_GAIN, 8192);
    set(PARAMETER_RIGHT_DEAD_BAND, 1638);
    wheels_set(&wheels, TRACK, PWM_STEPS, &parameters);
    struct wheel_steps steps = wheels_correct(&wheels, 4000, 4000);
    TEST_ASSERT_INT16_WITHIN(1, 8000, steps.left); /* half as fast: twice as much */
    TEST_ASSERT_INT16_WITHIN(1, 1638 + 4000 * 9 / 10, steps.right);
    steps = wheels_correct(&wheels, -PWM_STEPS, 0);
    TEST_ASSERT_EQUAL_INT16(-PWM_STEPS, steps.left);
    TEST_ASSERT_EQUAL_INT16(0, steps.right);
}

static void test_without_a_lag_the_wheels_do_as_they_are_told(void)
{
    for (int i = 0; i < 1000; i++) {
        struct motion_command moving = {within(INT16_MAX), within(INT16_MAX)};
        struct motion_command command = {within(INT16_MAX), within(INT16_MAX)};

        wheels_follow(&wheels, &moving, &command);
        TEST_ASSERT_EQUAL_MEMORY(&command, &moving, sizeof moving);
    }
}

static void test_with_a_lag_they_follow_in_its_time(void)
{
    static const uint16_t lags[] = {10, 20, 50, 100, 300, 500};

    for (size_t i = 0; i < sizeof lags / sizeof *lags; i++) {
        struct motion_command moving = {0, 0}, command = {20000, -20000};
        double expected = 0, share = 1 - exp(-20.0 / lags[i]);

        set(PARAMETER_MOTOR_LAG, lags[i]);
        for (int tick = 0; tick < 25; tick++) {
            expected += (20000 - expected) * share;
            wheels_follow(&wheels, &moving, &command);
            TEST_ASSERT_TRUE(fabs(moving.v - expected) < 0.07 * 20000);
            TEST_ASSERT_TRUE(fabs(moving.omega + expected) < 0.07 * 20000);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_they_make_the_command);
    RUN_TEST(test_by_default_every_bit_is_as_without_parameters);
    RUN_TEST(test_they_make_it_with_wheels_that_are_not_alike);
    RUN_TEST(test_a_wheel_that_shall_stand_gets_no_dead_band);
    RUN_TEST(test_full_speed_is_full_pwm_whatever_the_dead_band);
    RUN_TEST(test_wheels_too_slow_keep_the_curve);
    RUN_TEST(test_the_slower_wheel_sets_the_pace);
    RUN_TEST(test_every_command_stays_within_the_steps);
    RUN_TEST(test_a_trial_is_corrected_in_parts_of_full_speed);
    RUN_TEST(test_without_a_lag_the_wheels_do_as_they_are_told);
    RUN_TEST(test_with_a_lag_they_follow_in_its_time);
    return UNITY_END();
}
