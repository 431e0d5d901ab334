/* board.c: how the robot's own image behaves on its board. */
#include "../../firmware/atmega128/pins.h"
#include "atmega128.h"
#include "chip.h"
#include "play.h"

#include <string.h>
#include <unity.h>

static struct chip chip;
static struct link_timing timing;

void setUp(void)
{
    chip_start(&chip);
    timing = link_timing_of(chip.image->baud);
}

void tearDown(void)
{
    chip_stop(&chip);
}

/* The next status that the chip sends by itself. */
static struct message_status await_status(void)
{
    for (;;) {
        struct message message;
        uint8_t byte;

        chip_read(&chip, &byte, 1);
        if (frame_decode(&chip.decoder, byte) == FRAME_READY &&
            message_read(&message, chip.decoder.payload, chip.decoder.length) &&
            message.type == MESSAGE_STATUS)
            return message.status;
    }
}

static void assert_pin(uint8_t high, uint16_t port, uint16_t ddr, uint8_t mask)
{
    const uint8_t *data = avr_core_data(chip.core);

    TEST_ASSERT_BITS_HIGH(mask, data[ddr]);
    TEST_ASSERT_BITS(mask, high ? mask : 0, data[port]);
}

#define ASSERT_LOW(pin) assert_pin(0, PIN_PORT(pin), PIN_DDR(pin), PIN_MASK(pin))

static void test_it_starts_with_its_motors_off(void)
{
    for (int ms = 0; ms < 1000; ms++) {
        struct avr_motors motors = avr_core_motors(chip.core);

        TEST_ASSERT_EQUAL_INT16(0, motors.left);
        TEST_ASSERT_EQUAL_INT16(0, motors.right);
        chip_run_us(&chip, 1000);
    }
    ASSERT_LOW(PIN_LEFT_FORWARD);
    ASSERT_LOW(PIN_LEFT_REVERSE);
    ASSERT_LOW(PIN_RIGHT_FORWARD);
    ASSERT_LOW(PIN_RIGHT_REVERSE);
}

static void test_its_status_tells_of_the_board(void)
{
    struct message_status status;

    chip_run_us(&chip, 2000000);
    avr_core_take_sent(chip.core, (uint8_t[ROBOT_TX_MAX]){0}, ROBOT_TX_MAX);
    status = await_status();
    TEST_ASSERT_EQUAL_UINT16(0, status.id);
    TEST_ASSERT_EQUAL_UINT8(PROTOCOL_VERSION, status.version);
    TEST_ASSERT_BITS_HIGH(FAULT_NO_ID, status.faults);
    TEST_ASSERT_EQUAL_HEX8(1, status.reset_cause); /* power-on */
    TEST_ASSERT_UINT16_WITHIN(10, 7400, status.battery);
    TEST_ASSERT_EQUAL_UINT16(0, status.overruns);
    TEST_ASSERT_EQUAL_UINT16(0, status.bad_frames);
    TEST_ASSERT_EQUAL_UINT16(avr_core_stack_free(chip.core), status.stack_free);
    TEST_ASSERT_EQUAL_UINT16(VERTICES_MAX_CHIP, status.vertices_max);
}

static void test_its_watchdog_is_content(void)
{
    chip_run_us(&chip, 5000000);
    TEST_ASSERT_EQUAL(0, avr_core_resets(chip.core));
}

static void test_it_sleeps_when_there_is_nothing_to_do(void)
{
    chip_run_us(&chip, 1000000);
    TEST_ASSERT_GREATER_THAN_UINT64(avr_core_cycle(chip.core) / 100 * 95,
                                    avr_core_asleep(chip.core));
}

static unsigned periods_driven(uint16_t id)
{
    struct sim_robot *robot = robot_avr_new(id, chip.image);
    struct play play;
    unsigned driven = 0;

    TEST_ASSERT_TRUE(robot->kind->power_on(robot));
    play_begin(&play, &play_candidate, 1);
    for (int i = 0; i < 200; i++) {
        struct robot_period period;

        play_next(&play, &timing);
        robot->kind->run(robot, play.bytes, play.count, &period);
        TEST_ASSERT_FALSE(period.crashed);
        play_drive(&play, period.left, period.right);
        driven += period.left != 0 || period.right != 0;
    }
    robot->kind->destroy(robot);
    return driven;
}

static void test_without_an_id_it_never_drives(void)
{
    TEST_ASSERT_EQUAL(0, periods_driven(0));
    TEST_ASSERT_GREATER_THAN(100, periods_driven(PLAY_ROBOT));
}

/* Its first tick is in that period, for the mission in it is acknowledged. */
static void test_switched_on_it_takes_part_in_the_next_period(void)
{
    struct sim_robot *robot = robot_avr_new(PLAY_ROBOT, chip.image);
    uint64_t cycles[2];

    for (int round = 0; round < 2; round++) {
        struct robot_period period;
        struct play play;

        play_begin(&play, &play_candidate, 1);
        play.period = PLAY_MISSION;
        play_next(&play, &timing);
        TEST_ASSERT_TRUE(robot->kind->power_on(robot));
        robot->kind->run(robot, play.bytes, play.count, &period);
        TEST_ASSERT_GREATER_THAN(0, period.sent);
        robot->kind->power_off(robot);
        cycles[round] = robot->kind->load(robot).cycles;
    }
    TEST_ASSERT_EQUAL_UINT64(cycles[0], cycles[1]);
    robot->kind->destroy(robot);
}

static void test_its_eeprom_outlives_power(void)
{
    struct sim_robot *robot = robot_avr_new(PLAY_ROBOT, chip.image);
    uint8_t eeprom[PARAMETERS_BYTES];

    memcpy(eeprom, robot->eeprom, sizeof eeprom);
    TEST_ASSERT_TRUE(robot->kind->power_on(robot));
    memset(robot->eeprom, 0, sizeof robot->eeprom);
    robot->kind->power_off(robot);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(eeprom, robot->eeprom, sizeof eeprom);
    robot->kind->destroy(robot);
}

int main(int argc, char **argv)
{
    (void)argc;
    chip_path = argv[1];
    UNITY_BEGIN();
    RUN_TEST(test_it_starts_with_its_motors_off);
    RUN_TEST(test_its_status_tells_of_the_board);
    RUN_TEST(test_its_watchdog_is_content);
    RUN_TEST(test_it_sleeps_when_there_is_nothing_to_do);
    RUN_TEST(test_without_an_id_it_never_drives);
    RUN_TEST(test_switched_on_it_takes_part_in_the_next_period);
    RUN_TEST(test_its_eeprom_outlives_power);
    return UNITY_END();
}
