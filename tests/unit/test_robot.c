#include "robot.h"

#include "message.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static const uint32_t rates[] = {9600, 19200, 38400, 57600, 76800, 115200, 230400, 500000, 1000000};

#define RATES (sizeof rates / sizeof rates[0])

static struct sim_robot *robot;
static struct robot_period period;

void setUp(void)
{
    robot = robot_native_new(42);
    TEST_ASSERT_NOT_NULL(robot);
    TEST_ASSERT_TRUE(robot->kind->power_on(robot));
}

void tearDown(void)
{
    robot->kind->destroy(robot);
}

/* ---- timing ---------------------------------------------------------------------------- */

static void test_the_tick_lies_half_way_between_two_bytes(void)
{
    for (size_t i = 0; i < RATES; i++) {
        struct link_timing timing = link_timing_of(rates[i]);
        double bytes = link_phase_s(&timing) * rates[i] / 10;

        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5, bytes - floor(bytes));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, timing.before_phase, floor(bytes));
    }
}

static void test_the_tick_is_near_5_ms(void)
{
    for (size_t i = 0; i < RATES; i++) {
        struct link_timing timing = link_timing_of(rates[i]);

        TEST_ASSERT_DOUBLE_WITHIN(5.0 / rates[i], 0.005, link_phase_s(&timing));
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, link_phase_s(&timing) + 0.005, link_actuation_s(&timing));
    }
}

static void test_a_period_has_room_for_whole_bytes(void)
{
    for (size_t i = 0; i < RATES; i++) {
        struct link_timing timing = link_timing_of(rates[i]);
        double byte = 10.0 / rates[i];

        TEST_ASSERT_TRUE(timing.slots * byte <= 0.02 + 1e-12);
        TEST_ASSERT_TRUE((timing.slots + 1) * byte > 0.02);
    }
}

/* ---- native robots --------------------------------------------------------------------- */

/* How many bytes long the frame is that asks a robot for its status. */
static uint8_t mission_frame(uint8_t *frame)
{
    struct message message = {.type = MESSAGE_MISSION,
                              .mission = {.version = PROTOCOL_VERSION,
                                          .mission = 1,
                                          .k = GAIN_ONE,
                                          .k_theta = GAIN_ONE,
                                          .v_max = 4000,
                                          .omega_max = 1024,
                                          .track = 400,
                                          .wheel_max = 4000}};
    uint8_t payload[FRAME_PAYLOAD_MAX];

    return frame_encode(frame, payload, message_write(payload, &message));
}

/* The mission that the robot says it has; -1: it says nothing. */
static int mission_said(void)
{
    struct frame_decoder decoder;
    struct message message;
    int said = -1;

    frame_decoder_init(&decoder);
    for (uint16_t i = 0; i < period.sent; i++) {
        if (frame_decode(&decoder, period.tx[i]) != FRAME_READY)
            continue;
        TEST_ASSERT_TRUE(message_read(&message, decoder.payload, decoder.length));
        if (message.type == MESSAGE_STATUS) {
            TEST_ASSERT_EQUAL_UINT16(42, message.status.id);
            said = message.status.mission;
        }
    }
    return said;
}

/* Runs a period in which the mission's last byte is the `last`th (from 1). */
static void run_with_mission_ending_at(uint16_t last)
{
    uint8_t frame[FRAME_BYTES_MAX], rx[300] = {0};
    uint8_t length = mission_frame(frame);

    memcpy(rx + last - length, frame, length);
    robot->kind->run(robot, rx, last, &period);
}

static void run_silent(void)
{
    robot->kind->run(robot, NULL, 0, &period);
}

/* Past the words of a robot that was just switched on. */
static void settle(void)
{
    run_silent();
    do
        run_silent();
    while (period.sent > 0);
}

static void test_a_tick_uses_what_arrived_before_it(void)
{
    settle();
    run_with_mission_ending_at(link_timing_of(NATIVE_BAUD).before_phase);
    TEST_ASSERT_EQUAL_INT(1, mission_said());
}

static void test_what_arrives_after_it_is_for_the_next(void)
{
    settle();
    run_with_mission_ending_at(link_timing_of(NATIVE_BAUD).before_phase + 1);
    TEST_ASSERT_EQUAL_INT(-1, mission_said());
    run_silent();
    TEST_ASSERT_EQUAL_INT(1, mission_said());
}

static void test_power_off_forgets_the_mission(void)
{
    settle();
    run_with_mission_ending_at(40);
    robot->kind->power_off(robot);
    TEST_ASSERT_TRUE(robot->kind->power_on(robot));
    for (int said = -1; said < 0; said = mission_said()) {
        run_silent();
        TEST_ASSERT_TRUE(mission_said() <= 0);
    }
}

static void test_before_a_mission_the_motors_are_off(void)
{
    for (int i = 0; i < 100; i++) {
        run_silent();
        TEST_ASSERT_EQUAL_INT16(0, period.left);
        TEST_ASSERT_EQUAL_INT16(0, period.right);
        TEST_ASSERT_FALSE(period.crashed);
    }
}

static void test_a_native_robot_has_no_processor(void)
{
    struct robot_load load = robot->kind->load(robot);

    TEST_ASSERT_TRUE(load.cycles == 0 && load.asleep == 0 && load.tick_cycles == 0);
}

/* Says its status, whose battery it returns. */
static uint16_t battery_said(void)
{
    struct frame_decoder decoder;
    struct message message;

    frame_decoder_init(&decoder);
    for (;;) {
        run_with_mission_ending_at(40);
        for (uint16_t i = 0; i < period.sent; i++)
            if (frame_decode(&decoder, period.tx[i]) == FRAME_READY &&
                message_read(&message, decoder.payload, decoder.length) &&
                message.type == MESSAGE_STATUS)
                return message.status.battery;
    }
}

static void test_its_battery_is_measured_a_period_later(void)
{
    settle();
    TEST_ASSERT_EQUAL_UINT16(robot_battery_measured(7400), battery_said());
    robot->battery = 6000;
    TEST_ASSERT_EQUAL_UINT16(robot_battery_measured(7400), battery_said());
    TEST_ASSERT_EQUAL_UINT16(robot_battery_measured(6000), battery_said());
}

static void test_a_battery_is_measured_in_steps(void)
{
    TEST_ASSERT_EQUAL_UINT16(7392, robot_battery_measured(7400));
    TEST_ASSERT_EQUAL_UINT16(9990, robot_battery_measured(10000));
    TEST_ASSERT_EQUAL_UINT16(9990, robot_battery_measured(UINT16_MAX));
    TEST_ASSERT_EQUAL_UINT16(0, robot_battery_measured(0));
}

static void test_a_new_robot_has_its_id_and_else_defaults(void)
{
    struct parameters read;

    parameters_read(&read, robot->eeprom);
    TEST_ASSERT_EQUAL_UINT16(42, read.value[PARAMETER_ID]);
    TEST_ASSERT_EQUAL_UINT16(16384, read.value[PARAMETER_LEFT_GAIN]);
    struct sim_robot *blank = robot_native_new(0);
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, blank->eeprom, PARAMETERS_BYTES);
    blank->kind->destroy(blank);
}

static void test_a_robot_is_what_it_is_provisioned_with(void)
{
    struct parameters parameters;

    parameters_default(&parameters);
    parameters.value[PARAMETER_ID] = 42;
    parameters.value[PARAMETER_TRACK] = 321;
    robot->kind->power_off(robot);
    robot_provision(robot, &parameters);
    TEST_ASSERT_TRUE(robot->kind->power_on(robot));
    settle();
    run_with_mission_ending_at(40);
    TEST_ASSERT_EQUAL_INT(1, mission_said());
    struct parameters read;
    parameters_read(&read, robot->eeprom);
    TEST_ASSERT_EQUAL_UINT16(321, read.value[PARAMETER_TRACK]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_tick_lies_half_way_between_two_bytes);
    RUN_TEST(test_the_tick_is_near_5_ms);
    RUN_TEST(test_a_period_has_room_for_whole_bytes);
    RUN_TEST(test_a_tick_uses_what_arrived_before_it);
    RUN_TEST(test_what_arrives_after_it_is_for_the_next);
    RUN_TEST(test_power_off_forgets_the_mission);
    RUN_TEST(test_before_a_mission_the_motors_are_off);
    RUN_TEST(test_a_native_robot_has_no_processor);
    RUN_TEST(test_its_battery_is_measured_a_period_later);
    RUN_TEST(test_a_battery_is_measured_in_steps);
    RUN_TEST(test_a_new_robot_has_its_id_and_else_defaults);
    RUN_TEST(test_a_robot_is_what_it_is_provisioned_with);
    return UNITY_END();
}
