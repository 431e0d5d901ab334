/* control.c: the robot's image and the native robot, given the same bytes, do the same. */
#include "chip.h"
#include "message.h"
#include "play.h"
#include "random.h"

#include <string.h>
#include <unity.h>

#define PERIODS 600

static struct avr_image *image;
static struct sim_robot *avr, *native;
static struct link_timing timing;

void setUp(void)
{
    char error[300] = "";

    image = avr_image_open(chip_path, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(image, error);
    TEST_ASSERT_EQUAL_UINT32(NATIVE_BAUD, avr_image_baud(image));
    timing = link_timing_of(avr_image_baud(image));
    avr = robot_avr_new(PLAY_ROBOT, image);
    native = robot_native_new(PLAY_ROBOT);
}

void tearDown(void)
{
    avr->kind->destroy(avr);
    native->kind->destroy(native);
    avr_image_close(image);
}

/* What each board says of itself may differ. */
static void forget_board(struct message *message)
{
    if (message->type != MESSAGE_STATUS)
        return;
    message->status.reset_cause = 0;
    message->status.overruns = 0;
    message->status.tick_cycles = 0;
    message->status.stack_free = 0;
    message->status.vertices_max = 0;
}

/* The payloads in a period's bytes one after the other, without what the boards add. */
static size_t messages_of(const struct robot_period *period, uint8_t *payloads)
{
    struct frame_decoder decoder;
    size_t length = 0;

    frame_decoder_init(&decoder);
    for (uint16_t i = 0; i < period->sent; i++) {
        struct message message;
        enum frame_event event = frame_decode(&decoder, period->tx[i]);

        TEST_ASSERT_NOT_EQUAL(FRAME_BAD, event);
        if (event != FRAME_READY)
            continue;
        TEST_ASSERT_TRUE(message_read(&message, decoder.payload, decoder.length));
        forget_board(&message);
        length += message_write(payloads + length, &message);
    }
    return length;
}

static void assert_same(const struct robot_period *a, const struct robot_period *b)
{
    uint8_t of_a[ROBOT_TX_MAX + FRAME_PAYLOAD_MAX], of_b[ROBOT_TX_MAX + FRAME_PAYLOAD_MAX];
    size_t length = messages_of(a, of_a);

    TEST_ASSERT_EQUAL_INT16(a->left, b->left);
    TEST_ASSERT_EQUAL_INT16(a->right, b->right);
    TEST_ASSERT_EQUAL(a->sent, b->sent);
    TEST_ASSERT_EQUAL(length, messages_of(b, of_b));
    if (length > 0)
        TEST_ASSERT_EQUAL_HEX8_ARRAY(of_a, of_b, length);
}

/* Returns in how many periods the robot drove. */
static unsigned run_both(const struct play_part *part, uint32_t seed)
{
    struct play play;
    unsigned driven = 0;

    TEST_ASSERT_TRUE(avr->kind->power_on(avr));
    TEST_ASSERT_TRUE(native->kind->power_on(native));
    play_begin(&play, part, seed);
    for (unsigned i = 0; i < PERIODS; i++) {
        struct robot_period by_avr, by_native;

        play_next(&play, &timing);
        avr->battery = native->battery = (uint16_t)(7400 + 37 * i % 5000);
        avr->kind->run(avr, play.bytes, play.count, &by_avr);
        native->kind->run(native, play.bytes, play.count, &by_native);
        TEST_ASSERT_FALSE(by_avr.crashed);
        assert_same(&by_native, &by_avr);
        play_drive(&play, by_avr.left, by_avr.right);
        driven += by_avr.left != 0 || by_avr.right != 0;
    }
    avr->kind->power_off(avr);
    native->kind->power_off(native);
    return driven;
}

static void test_a_candidate_that_leads(void)
{
    TEST_ASSERT_GREATER_THAN(PERIODS / 2, run_both(&play_candidate, 1));
}

static void test_a_follower(void)
{
    TEST_ASSERT_GREATER_THAN(PERIODS / 2, run_both(&play_follower, 2));
}

/* With the two above, more than 10,000 control steps. */
static void test_every_part_there_is(void)
{
    static const uint8_t vertices[] = {5, 16, 100, VERTICES_MAX_CHIP};
    static const uint8_t others[] = {0, 6, NEIGHBOURS_MAX, NEIGHBOURS_MAX + 8};
    uint32_t seed = 3;

    for (int law = LAW_FL; law <= LAW_PID; law++)
        for (int allocation = ALLOCATION_CPA; allocation <= ALLOCATION_ASSIGNED; allocation++)
            for (int candidate = 0; candidate <= 1; candidate++, seed++) {
                struct play_part part = {candidate, law, allocation, vertices[seed % 4],
                                         others[seed / 4 % 4]};

                TEST_ASSERT_GREATER_THAN(PERIODS / 2, run_both(&part, seed));
            }
}

/* ---- what is asked between missions ---------------------------------------------------- */

static uint8_t bytes[256];
static size_t count;

static void send(const struct message *message)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];

    count += frame_encode(bytes + count, payload, message_write(payload, message));
}

/* Any of them, but the reading that boards answer from their own flash; the id stays, and so do the
 * battery's thresholds. */
static void send_ask(uint32_t *state)
{
    static const uint16_t values[] = {0, 321, 4915, 9000, 16384, 20000, 65535};
    struct message message = {.type = MESSAGE_ASK, .ask = {.tag = (uint8_t)random_next(state)}};
    struct message_ask *ask = &message.ask;

    ask->action = random_next(state) % 6;
    ask->index = random_next(state) % 2 == 0 ? PARAMETER_LEFT_GAIN + random_next(state) % 6
                                             : PARAMETER_RESETS + random_next(state) % 4;
    ask->value = values[random_next(state) % 7];
    send(&message);
}

static void send_drive(uint32_t *state)
{
    struct message message = {.type = MESSAGE_DRIVE};

    message.drive.left = (int16_t)(random_next(state) % (2 * PWM_STEPS + 1)) - PWM_STEPS;
    message.drive.right = (int16_t)(random_next(state) % (2 * PWM_STEPS + 1)) - PWM_STEPS;
    message.drive.corrected = random_next(state) % 2;
    send(&message);
}

static void send_any(uint32_t *state)
{
    static const struct message keepalive = {.type = MESSAGE_KEEPALIVE, .keepalive = {-1000}};
    static const struct message loader = {.type = MESSAGE_LOADER};

    count = 0;
    if (random_next(state) % 4 == 0)
        send(&keepalive);
    if (random_next(state) % 3 == 0)
        send_ask(state);
    if (random_next(state) % 12 == 0)
        send_drive(state);
    if (random_next(state) % 50 == 0)
        send(&loader); /* there is none: they stay */
}

/* Asks, trials and saves; then a mission, with what was set. */
static void test_a_robot_that_is_asked_and_tried(void)
{
    uint32_t state = 5;
    unsigned driven = 0;

    TEST_ASSERT_TRUE(avr->kind->power_on(avr));
    TEST_ASSERT_TRUE(native->kind->power_on(native));
    for (unsigned i = 0; i < 10 * PERIODS; i++) {
        struct robot_period by_avr, by_native;

        send_any(&state);
        avr->kind->run(avr, bytes, count, &by_avr);
        native->kind->run(native, bytes, count, &by_native);
        TEST_ASSERT_FALSE(by_avr.crashed);
        assert_same(&by_native, &by_avr);
        driven += by_avr.left != 0 || by_avr.right != 0;
    }
    avr->kind->power_off(avr);
    native->kind->power_off(native);
    TEST_ASSERT_GREATER_THAN(PERIODS, driven);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(native->eeprom, avr->eeprom, PARAMETERS_BYTES);
    TEST_ASSERT_NOT_EQUAL(0xFF, native->eeprom[PARAMETERS_BANK_BYTES]);
}

static void test_a_robot_with_parameters_of_its_own(void)
{
    struct parameters parameters;

    parameters_default(&parameters);
    parameters.value[PARAMETER_ID] = PLAY_ROBOT;
    parameters.value[PARAMETER_LEFT_GAIN] = 15000;
    parameters.value[PARAMETER_RIGHT_GAIN] = 18000;
    parameters.value[PARAMETER_LEFT_DEAD_BAND] = 700;
    parameters.value[PARAMETER_RIGHT_DEAD_BAND] = 400;
    parameters.value[PARAMETER_TRACK] = 330;
    parameters.value[PARAMETER_MOTOR_LAG] = 60;
    robot_provision(avr, &parameters);
    robot_provision(native, &parameters);
    TEST_ASSERT_GREATER_THAN(PERIODS / 2, run_both(&play_candidate, 1));
    TEST_ASSERT_GREATER_THAN(PERIODS / 2, run_both(&play_follower, 2));
}

/* Thresholds that the battery of run_both() is below for more than a second at its beginning. */
static void test_a_robot_whose_battery_runs_down(void)
{
    struct parameters parameters;

    parameters_default(&parameters);
    parameters.value[PARAMETER_ID] = PLAY_ROBOT;
    parameters.value[PARAMETER_BATTERY_WARNING] = 9990;
    parameters.value[PARAMETER_BATTERY_CRITICAL] = 9900;
    robot_provision(avr, &parameters);
    robot_provision(native, &parameters);
    unsigned leading = run_both(&play_candidate, 1), following = run_both(&play_follower, 2);
    TEST_ASSERT_GREATER_THAN(following, leading); /* for it hands over */
    TEST_ASSERT_LESS_THAN(PERIODS / 2, leading);
}

int main(int argc, char **argv)
{
    (void)argc;
    chip_path = argv[1];
    UNITY_BEGIN();
    RUN_TEST(test_a_candidate_that_leads);
    RUN_TEST(test_a_follower);
    RUN_TEST(test_every_part_there_is);
    RUN_TEST(test_a_robot_that_is_asked_and_tried);
    RUN_TEST(test_a_robot_with_parameters_of_its_own);
    RUN_TEST(test_a_robot_whose_battery_runs_down);
    return UNITY_END();
}
