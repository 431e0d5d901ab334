#include "brain.h"

#include "random.h"

#include <string.h>
#include <unity.h>

#define OWN 7
#define LEADER 1

static struct brain brain;
static struct brain_output output;
static struct brain_input input;
static uint8_t eeprom[PARAMETERS_BYTES];
static int32_t now; /* mission time of the coming tick, ms */
static uint8_t sequence;

static void switch_on(uint16_t id)
{
    struct parameters parameters;

    input = (struct brain_input){.battery = 7400};
    parameters_default(&parameters);
    parameters.value[PARAMETER_ID] = id;
    parameters_write(eeprom, &parameters);
    brain_init(&brain, eeprom);
}

void setUp(void)
{
    switch_on(OWN);
    now = 0;
    sequence = 0;
}

void tearDown(void)
{
}

static void tell(struct message message)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];
    uint8_t frame[FRAME_BYTES_MAX];
    uint8_t length = frame_encode(frame, payload, message_write(payload, &message));

    brain_bytes(&brain, frame, frame + length);
}

static void tell_pose(int32_t x, int32_t y, angle_t theta)
{
    tell((struct message){.type = MESSAGE_POSE, .pose = {now, {{x, y}, theta}}});
}

static void tell_keepalive(void)
{
    tell((struct message){.type = MESSAGE_KEEPALIVE, .keepalive = {now}});
}

static void step(void)
{
    brain_step(&brain, &input, &output);
    if (output.store.wanted)
        input.stored = eeprom[output.store.at] = output.store.byte;
    now += TICK_MS;
}

/* A mission with a leader's vertex and one 1 m behind it; a candidate gets a straight reference. */
static void brief(bool candidate)
{
    tell((struct message){.type = MESSAGE_MISSION,
                          .mission = {.mission = 1,
                                      .candidate = candidate,
                                      .k = GAIN_ONE,
                                      .k_theta = 3 * GAIN_ONE,
                                      .v_max = 16000,
                                      .omega_max = 10 * RATE_ONE,
                                      .track = 400,
                                      .wheel_max = 18000}});
    sequence = 1;
    tell((struct message){.type = MESSAGE_VERTICES,
                          .vertices = {.sequence = sequence++,
                                       .formation = 1,
                                       .total = 2,
                                       .count = 2,
                                       .vertex = {{0, 0}, {4000, 2 * ANGLE_QUARTER}}}});
    for (int32_t i = 0; candidate && i < 30; i++)
        tell((struct message){
            .type = MESSAGE_KNOT,
            .knot = {sequence++, {.time = i * 1000, .v = 2000, .pose = {{i * 2000, 0}, 0}}}});
}

static struct message beacon_of(uint16_t id, uint8_t role, int32_t x, int16_t v, int32_t age)
{
    return (struct message){.type = MESSAGE_BEACON,
                            .beacon = {.id = id,
                                       .time = (uint16_t)(now - age),
                                       .pose = {{x, 0}, 0},
                                       .v = v,
                                       .role = role,
                                       .candidate = true,
                                       .term = 1,
                                       .leader_age = UINT8_MAX,
                                       .vertex = role == ROLE_LEADER ? 1 : 0,
                                       .formation = 1}};
}

static bool moves(void)
{
    return output.left != 0 || output.right != 0;
}

/* The last message of a type among those just sent. */
static bool sent(uint8_t type, struct message *message)
{
    struct frame_decoder decoder;
    struct message got;
    bool found = false;

    frame_decoder_init(&decoder);
    for (uint8_t i = 0; i < output.length; i++) {
        if (frame_decode(&decoder, output.frames[i]) != FRAME_READY)
            continue;
        TEST_ASSERT_TRUE(message_read(&got, decoder.payload, decoder.length));
        if (got.type == type) {
            *message = got;
            found = true;
        }
    }
    return found;
}

/* A follower on the x axis 3 m behind a leader that stands: it will want to move. */
static void follow_for(int ticks)
{
    for (int i = 0; i < ticks; i++) {
        tell_pose(-12000, 0, 0);
        tell(beacon_of(LEADER, ROLE_LEADER, 0, 0, 0));
        step();
    }
}

static void test_without_an_id_it_never_moves_and_says_so(void)
{
    struct message status;
    bool told = false;

    switch_on(0);
    brief(false);
    for (int i = 0; i < 100; i++) {
        follow_for(1);
        TEST_ASSERT_FALSE(moves());
        if (sent(MESSAGE_STATUS, &status))
            told = status.status.faults & FAULT_NO_ID;
    }
    TEST_ASSERT_TRUE(told);
}

static void test_motors_are_off_without_a_mission(void)
{
    follow_for(50);
    TEST_ASSERT_FALSE(moves());
}

static void test_motors_are_off_before_the_mission_starts(void)
{
    brief(false);
    now = -10 * TICK_MS;
    while (now < 0) {
        follow_for(1);
        TEST_ASSERT_FALSE(moves());
    }
    follow_for(3);
    TEST_ASSERT_TRUE(moves());
}

static void test_motors_are_off_without_a_pose(void)
{
    brief(false);
    for (int i = 0; i < 50; i++) {
        tell_keepalive();
        tell(beacon_of(LEADER, ROLE_LEADER, 0, 0, 0));
        step();
        TEST_ASSERT_FALSE(moves());
    }
}

static void test_a_pose_older_than_300_ms_stops_it(void)
{
    brief(false);
    follow_for(50);
    for (int i = 1; i <= 16; i++) {
        tell_keepalive();
        tell(beacon_of(LEADER, ROLE_LEADER, 0, 0, 0));
        step();
        TEST_ASSERT_EQUAL(i <= 300 / TICK_MS - 1, moves());
    }
    TEST_ASSERT_EQUAL(STATE_HOLD, brain.state);
    follow_for(1);
    TEST_ASSERT_TRUE(moves());
}

static void test_a_silent_server_stops_it(void)
{
    brief(false);
    follow_for(50);
    for (int i = 0; i < 500 / TICK_MS; i++)
        step();
    TEST_ASSERT_FALSE(moves());
    TEST_ASSERT_TRUE(brain.faults & FAULT_LINK_LOST || brain.faults & FAULT_POSE_STALE);
}

static void test_a_stale_pose_stays_stale_for_ever(void)
{
    brief(false);
    follow_for(50);
    for (int32_t i = 0; i < 140000; i++) {
        tell_keepalive();
        step();
        if (i > 20)
            TEST_ASSERT_EQUAL(STATE_HOLD, brain.state);
    }
}

static void test_an_emergency_stop_outlives_missions(void)
{
    brief(false);
    follow_for(50);
    tell((struct message){.type = MESSAGE_ESTOP});
    follow_for(50);
    TEST_ASSERT_FALSE(moves());
    tell((struct message){
        .type = MESSAGE_MISSION,
        .mission = {.mission = 2, .v_max = 1, .omega_max = 1, .track = 1, .wheel_max = 1}});
    follow_for(50);
    TEST_ASSERT_FALSE(moves());
    TEST_ASSERT_EQUAL(STATE_ESTOP, brain.state);
}

static void test_a_follower_is_heard_ten_times_a_second(void)
{
    struct message message;
    int beacons = 0;

    brief(false);
    follow_for(20);
    for (int i = 0; i < 10 * TICKS_PER_S; i++) {
        follow_for(1);
        if (sent(MESSAGE_BEACON, &message)) {
            beacons++;
            TEST_ASSERT_FALSE(message.beacon.to_all);
        }
    }
    TEST_ASSERT_EQUAL(100, beacons);
}

static void test_a_leader_is_heard_by_all_twenty_times_a_second(void)
{
    struct message message;
    int beacons = 0;

    brief(true);
    for (int i = 0; i < 20 * TICKS_PER_S; i++) {
        tell_pose(i * 40, 0, 0);
        step();
        if (i >= 10 * TICKS_PER_S && sent(MESSAGE_BEACON, &message)) {
            beacons++;
            TEST_ASSERT_EQUAL(ROLE_LEADER, message.beacon.role);
            TEST_ASSERT_TRUE(message.beacon.to_all);
            TEST_ASSERT_EQUAL(1, message.beacon.vertex);
        }
    }
    TEST_ASSERT_EQUAL(200, beacons);
}

static void test_another_candidate_is_heard_by_all_five_times_a_second(void)
{
    struct message message;
    int beacons = 0, far = 0;

    brief(true);
    follow_for(20);
    for (int i = 0; i < 10 * TICKS_PER_S; i++) {
        follow_for(1);
        if (sent(MESSAGE_BEACON, &message)) {
            beacons++;
            far += message.beacon.to_all;
        }
    }
    TEST_ASSERT_EQUAL(100, beacons);
    TEST_ASSERT_EQUAL(50, far);
}

static void test_a_leader_state_is_carried_on_to_now(void)
{
    struct motion_command fresh;

    /* 1.5 m/s and 50 ms: 7.5 cm, or 7.5 cm/s at k = 1. */
    brief(false);
    follow_for(10);
    tell_pose(-4000, 0, 0);
    tell(beacon_of(LEADER, ROLE_LEADER, 600, 6000, 0));
    step();
    fresh = brain.command;

    setUp();
    brief(false);
    follow_for(10);
    tell_pose(-4000, 0, 0);
    tell(beacon_of(LEADER, ROLE_LEADER, 600 - 6 * 50, 6000, 50));
    step();
    TEST_ASSERT_INT16_WITHIN(8, fresh.v, brain.command.v);
}

static void test_with_no_leader_it_follows_the_closest_candidate(void)
{
    brief(false);
    for (int i = 0; i < 50; i++) {
        tell_pose(-4000, 0, 0);
        tell(beacon_of(1, ROLE_CANDIDATE, 40000, 0, 0));
        tell(beacon_of(2, ROLE_CANDIDATE, 8000, 0, 0));
        step();
    }
    TEST_ASSERT_EQUAL(2, brain.about);
    TEST_ASSERT_TRUE(moves());
}

static void test_a_rival_far_off_is_not_taken_for_a_near_one(void)
{
    brief(false);
    for (int i = 0; i < 20; i++) {
        struct message rival = beacon_of(9, ROLE_FOLLOWER, -40000, 0, 0);

        /* Vertex 2 lies at -1 m; this robot is 3 m from it, the rival 9 m. */
        rival.beacon.vertex = 2;
        tell_pose(-16000, 0, 0);
        tell(beacon_of(LEADER, ROLE_LEADER, 0, 0, 0));
        tell(rival);
        step();
    }
    TEST_ASSERT_EQUAL(2, brain.allocation.held);
}

static void test_with_no_candidate_it_stops(void)
{
    brief(false);
    follow_for(50);
    TEST_ASSERT_TRUE(moves());
    for (int i = 0; i < 60; i++) {
        tell_pose(-12000, 0, 0);
        step();
    }
    TEST_ASSERT_FALSE(moves());
}

static void test_it_reports_a_stall(void)
{
    struct message message = {0};

    brief(false);
    follow_for(60);
    TEST_ASSERT_TRUE(brain.faults & FAULT_STALL);
    for (int i = 0; i < 10 && !sent(MESSAGE_BEACON, &message); i++)
        follow_for(1);
    TEST_ASSERT_TRUE(message.beacon.fault);
}

/* ---- parameters ------------------------------------------------------------------------ */

static void ask(uint8_t action, uint8_t index, uint32_t value)
{
    tell((struct message){.type = MESSAGE_ASK, .ask = {9, action, index, value}});
}

/* The answer, which comes within two ticks. */
static struct message_answer answer_of(uint8_t action, uint8_t index, uint32_t value)
{
    struct message message = {0};

    ask(action, index, value);
    step();
    if (!sent(MESSAGE_ANSWER, &message)) {
        step();
        TEST_ASSERT_TRUE(sent(MESSAGE_ANSWER, &message));
    }
    TEST_ASSERT_EQUAL_UINT8(9, message.answer.tag);
    return message.answer;
}

static void set(uint8_t index, uint32_t value)
{
    TEST_ASSERT_EQUAL(PARAMETER_DONE, answer_of(PARAMETER_SET, index, value).result);
}

static void test_it_answers_at_once_and_once(void)
{
    struct message message;

    follow_for(2);
    ask(PARAMETER_GET, PARAMETER_BATTERY_WARNING, 0);
    step();
    TEST_ASSERT_TRUE(sent(MESSAGE_ANSWER, &message));
    TEST_ASSERT_EQUAL_UINT16(OWN, message.answer.id);
    TEST_ASSERT_EQUAL(PARAMETER_DONE, message.answer.result);
    TEST_ASSERT_EQUAL_UINT32(6600, message.answer.value);
    for (int i = 0; i < 100; i++) {
        step();
        TEST_ASSERT_FALSE(sent(MESSAGE_ANSWER, &message));
    }
}

/* The transmit ring has room for a beacon and one more. */
static void test_a_status_and_an_answer_never_share_a_tick(void)
{
    struct message message;
    int answers = 0;

    brief(false);
    for (int i = 0; i < 200; i++) {
        ask(PARAMETER_GET, PARAMETER_ID, 0);
        follow_for(1);
        TEST_ASSERT_TRUE(output.length <= BRAIN_FRAMES_MAX);
        answers += sent(MESSAGE_ANSWER, &message);
        TEST_ASSERT_FALSE(sent(MESSAGE_ANSWER, &message) && sent(MESSAGE_STATUS, &message));
    }
    TEST_ASSERT_TRUE(answers > 180);
}

static void test_readings_are_the_board_s(void)
{
    input.image = 0xCBF43926;
    input.resets = 4;
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926, answer_of(PARAMETER_GET, PARAMETER_IMAGE, 0).value);
    TEST_ASSERT_EQUAL_UINT32(4, answer_of(PARAMETER_GET, PARAMETER_RESETS, 0).value);
}

static void test_a_new_id_is_the_robot_s_at_once(void)
{
    struct message message;

    switch_on(0);
    follow_for(5);
    TEST_ASSERT_EQUAL(STATE_BOOT, brain.state);
    TEST_ASSERT_EQUAL_UINT16(12, answer_of(PARAMETER_SET, PARAMETER_ID, 12).id);
    brief(false);
    for (int i = 0; i < 60 && !sent(MESSAGE_BEACON, &message); i++)
        follow_for(1);
    TEST_ASSERT_TRUE(sent(MESSAGE_BEACON, &message));
    TEST_ASSERT_EQUAL_UINT16(12, message.beacon.id);
    TEST_ASSERT_EQUAL(STATE_RUN, brain.state);
}

static void test_a_new_id_has_its_own_slot(void)
{
    follow_for(7);
    set(PARAMETER_ID, 12);
    TEST_ASSERT_EQUAL(brain.clock.now / TICK_MS % 10 + 2, brain.slot);
}

static void test_an_id_stays_during_a_mission(void)
{
    brief(false);
    follow_for(5);
    TEST_ASSERT_EQUAL(PARAMETER_BUSY, answer_of(PARAMETER_SET, PARAMETER_ID, 12).result);
    TEST_ASSERT_EQUAL_UINT16(OWN, brain.id);
}

static void test_a_new_id_before_the_start_begins_the_mission_anew(void)
{
    brief(true);
    for (now = -300; now < -100;) {
        tell_pose(0, 0, 0);
        step();
    }
    TEST_ASSERT_EQUAL(OWN, brain.election.leader);
    set(PARAMETER_ID, 12);
    TEST_ASSERT_EQUAL(ROLE_CANDIDATE, brain.election.role);
    TEST_ASSERT_EQUAL(0, brain.election.leader);
}

static void test_an_id_taken_away_stops_it_before_it_starts(void)
{
    brief(false);
    now = -20 * TICK_MS;
    follow_for(3);
    TEST_ASSERT_EQUAL(STATE_READY, brain.state);
    set(PARAMETER_ID, 0);
    follow_for(50);
    TEST_ASSERT_FALSE(moves());
    TEST_ASSERT_EQUAL(STATE_BOOT, brain.state);
}

static void test_wheels_are_corrected_at_once(void)
{
    brief(false);
    follow_for(20);
    int16_t left = output.left;
    tell_pose(-12000, 0, 0);
    tell(beacon_of(LEADER, ROLE_LEADER, 0, 0, 0));
    ask(PARAMETER_SET, PARAMETER_LEFT_GAIN, 20480);
    step();
    TEST_ASSERT_INT16_WITHIN(2, left * 4 / 5, output.left);
    TEST_ASSERT_INT16_WITHIN(2, left, output.right);
}

static void test_what_it_saves_outlives_power(void)
{
    set(PARAMETER_ID, 12);
    set(PARAMETER_TRACK, 333);
    ask(PARAMETER_SAVE, 0, 0);
    for (int i = 0; i < 40; i++)
        step();
    brain_init(&brain, eeprom);
    TEST_ASSERT_EQUAL_UINT16(12, brain.id);
    TEST_ASSERT_EQUAL_UINT32(333, answer_of(PARAMETER_GET, PARAMETER_TRACK, 0).value);
    TEST_ASSERT_EQUAL_UINT32(2, answer_of(PARAMETER_GET, PARAMETER_EEPROM, 0).value);
}

/* It sets out to drive at full speed: its pose is carried on at what its wheels do by then. */
static void test_wheels_that_lag_are_reckoned_with(void)
{
    brief(false);
    follow_for(6);
    TEST_ASSERT_INT16_WITHIN(200, brain.command.v, brain.moving.v);
    setUp();
    set(PARAMETER_MOTOR_LAG, 100);
    brief(false);
    follow_for(6);
    TEST_ASSERT_TRUE(brain.command.v > 4000);
    TEST_ASSERT_TRUE(brain.moving.v > 0);
    TEST_ASSERT_TRUE(brain.moving.v < brain.command.v * 3 / 4);
}

/* ---- trials and the loader ------------------------------------------------------------- */

static void drive(int16_t left, int16_t right, bool corrected)
{
    tell((struct message){.type = MESSAGE_DRIVE, .drive = {left, right, corrected}});
    step();
}

static void test_a_trial_turns_the_wheels_for_200_ms(void)
{
    step();
    for (int i = 0; i < 20; i++) {
        drive(1000, -2000, false);
        TEST_ASSERT_EQUAL_INT16(1000, output.left);
        TEST_ASSERT_EQUAL_INT16(-2000, output.right);
    }
    TEST_ASSERT_EQUAL(STATE_TRIAL, brain.state);
    for (int i = 1; i < 20; i++) {
        tell_keepalive();
        step();
        TEST_ASSERT_EQUAL(i < 200 / TICK_MS, moves());
    }
    TEST_ASSERT_EQUAL(STATE_IDLE, brain.state);
}

static void test_a_trial_can_be_corrected(void)
{
    set(PARAMETER_LEFT_GAIN, 8192);
    set(PARAMETER_RIGHT_DEAD_BAND, 1638);
    drive(4000, 4000, true);
    TEST_ASSERT_INT16_WITHIN(1, 8000, output.left);
    TEST_ASSERT_INT16_WITHIN(1, 1638 + 3600, output.right);
    drive(4000, 4000, false);
    TEST_ASSERT_EQUAL_INT16(4000, output.left);
}

static void test_without_an_id_there_is_no_trial(void)
{
    switch_on(0);
    for (int i = 0; i < 10; i++) {
        drive(1000, 1000, false);
        TEST_ASSERT_FALSE(moves());
    }
}

static void test_a_mission_under_way_is_not_for_trials(void)
{
    brief(false);
    follow_for(10);
    for (int i = 0; i < 30; i++) {
        tell((struct message){.type = MESSAGE_DRIVE, .drive = {PWM_STEPS, -PWM_STEPS, false}});
        follow_for(1);
        TEST_ASSERT_EQUAL(STATE_RUN, brain.state);
        TEST_ASSERT_TRUE(output.left > 0 && output.right > 0);
    }
    for (int i = 0; i < 30; i++) { /* in HOLD, for want of a pose */
        tell_keepalive();
        drive(PWM_STEPS, -PWM_STEPS, false);
        TEST_ASSERT_FALSE(i > 20 && moves());
    }
    TEST_ASSERT_EQUAL(STATE_HOLD, brain.state);
}

static void test_a_mission_that_has_not_started_allows_trials_until_then(void)
{
    brief(false);
    now = -30 * TICK_MS;
    follow_for(3);
    while (now < 0) {
        tell((struct message){.type = MESSAGE_DRIVE, .drive = {700, 700, false}});
        follow_for(1);
        TEST_ASSERT_EQUAL_INT16(700, output.left);
    }
    tell((struct message){.type = MESSAGE_DRIVE, .drive = {700, 700, false}});
    follow_for(1);
    TEST_ASSERT_FALSE(moves());
    follow_for(2);
    TEST_ASSERT_EQUAL(STATE_RUN, brain.state);
}

static void test_an_emergency_stop_ends_a_trial(void)
{
    step();
    drive(1000, 1000, false);
    TEST_ASSERT_TRUE(moves());
    tell((struct message){.type = MESSAGE_ESTOP});
    drive(1000, 1000, false);
    TEST_ASSERT_FALSE(moves());
    TEST_ASSERT_EQUAL(STATE_ESTOP, brain.state);
}

static void test_it_leaves_for_the_loader_once(void)
{
    tell((struct message){.type = MESSAGE_LOADER});
    step();
    TEST_ASSERT_TRUE(output.leave);
    step();
    TEST_ASSERT_FALSE(output.leave);
}

/* STK500v2's SIGN_ON, as avrdude says it. */
static void sign_on(uint8_t number)
{
    const uint8_t message[] = {0x1B, number, 0x00, 0x01, 0x0E, 0x01, (uint8_t)(0x15 ^ number)};

    brain_bytes(&brain, message, message + sizeof message);
}

static void test_it_leaves_for_a_programmer_that_says_so_twice(void)
{
    sign_on(1);
    step();
    TEST_ASSERT_FALSE(output.leave);
    sign_on(2);
    step();
    TEST_ASSERT_TRUE(output.leave);
    sign_on(9);
    step();
    TEST_ASSERT_FALSE(output.leave);
    sign_on(9);
    step();
    TEST_ASSERT_TRUE(output.leave);
}

/* As `muster flash' asks who is there. */
static void test_it_does_not_leave_for_a_programmer_between_zeros(void)
{
    static const uint8_t zero = 0;

    for (uint8_t number = 1; number < 10; number++) {
        brain_bytes(&brain, &zero, &zero + 1);
        sign_on(number);
        step();
        TEST_ASSERT_FALSE(output.leave);
    }
}

static void test_it_does_not_leave_with_its_wheels_turning(void)
{
    brief(false);
    follow_for(10);
    tell((struct message){.type = MESSAGE_LOADER});
    follow_for(1);
    TEST_ASSERT_FALSE(output.leave);
    setUp();
    step();
    drive(1000, 1000, false);
    tell((struct message){.type = MESSAGE_LOADER});
    step();
    TEST_ASSERT_FALSE(output.leave);
    for (int i = 0; i < 30; i++) {
        step();
        TEST_ASSERT_FALSE(output.leave);
    }
}

/* ---- the battery ----------------------------------------------------------------------- */

/* What a candidate that follows a straight reference says of itself, tick by tick. */
static void lead_for(int ticks)
{
    for (int i = 0; i < ticks; i++) {
        tell_pose(now * 2, 0, 0);
        step();
    }
}

static void test_a_warning_is_no_fault(void)
{
    struct message message = {0};
    bool told = false;

    brief(true);
    lead_for(2 * TICKS_PER_S);
    input.battery = 6500;
    for (int i = 0; i < 4 * TICKS_PER_S; i++) {
        lead_for(1);
        if (sent(MESSAGE_BEACON, &message)) {
            TEST_ASSERT_FALSE(message.beacon.fault);
        }
        if (sent(MESSAGE_STATUS, &message))
            told = message.status.faults == WARN_BATTERY;
    }
    TEST_ASSERT_TRUE(told);
    TEST_ASSERT_EQUAL(ROLE_LEADER, brain.election.role);
    TEST_ASSERT_EQUAL(STATE_RUN, brain.state);
}

static void test_a_warned_candidate_is_elected(void)
{
    input.battery = 6500;
    brief(true);
    lead_for(4 * TICKS_PER_S);
    TEST_ASSERT_EQUAL(WARN_BATTERY, brain.faults);
    setUp();
    input.battery = 6500;
    for (int i = 0; i < 2 * TICKS_PER_S; i++)
        step();
    TEST_ASSERT_TRUE(brain.faults & WARN_BATTERY);
    now = 0;
    brief(true);
    lead_for(TICKS_PER_S);
    TEST_ASSERT_EQUAL(ROLE_LEADER, brain.election.role);
}

static void test_a_spent_follower_stops_and_leaves_its_vertex(void)
{
    struct message message = {0};
    bool heard = false;

    brief(false);
    follow_for(20);
    TEST_ASSERT_EQUAL(2, brain.allocation.held);
    input.battery = 6100;
    follow_for(TICKS_PER_S - 1);
    TEST_ASSERT_TRUE(moves());
    follow_for(1);
    TEST_ASSERT_FALSE(moves());
    TEST_ASSERT_EQUAL(STATE_SPENT, brain.state);
    input.battery = 7400;
    for (int i = 0; i < 100; i++) {
        follow_for(1);
        TEST_ASSERT_FALSE(moves());
        if (sent(MESSAGE_BEACON, &message)) {
            heard = true;
            TEST_ASSERT_TRUE(message.beacon.fault);
            TEST_ASSERT_EQUAL(0, message.beacon.vertex);
        }
    }
    TEST_ASSERT_TRUE(heard);
    TEST_ASSERT_EQUAL(STATE_SPENT, brain.state);
}

static void spend_leading(void)
{
    brief(true);
    lead_for(2 * TICKS_PER_S);
    input.battery = 6100;
    lead_for(TICKS_PER_S);
    TEST_ASSERT_TRUE(brain.faults & FAULT_BATTERY);
}

static void test_a_spent_leader_leads_on_until_another_does(void)
{
    struct message message = {0}, heir;

    spend_leading();
    for (int i = 0; i < 2 * TICKS_PER_S; i++) {
        lead_for(1);
        TEST_ASSERT_TRUE(moves());
        if (sent(MESSAGE_BEACON, &message)) {
            TEST_ASSERT_TRUE(message.beacon.fault);
            TEST_ASSERT_EQUAL(ROLE_LEADER, message.beacon.role);
            TEST_ASSERT_EQUAL(1, message.beacon.vertex);
        }
    }
    heir = beacon_of(LEADER, ROLE_LEADER, now * 2 - 2000, 2000, 0);
    heir.beacon.term = brain.election.term + 1;
    tell(heir);
    lead_for(1);
    TEST_ASSERT_FALSE(moves());
    TEST_ASSERT_EQUAL(STATE_SPENT, brain.state);
    TEST_ASSERT_EQUAL(ROLE_FOLLOWER, brain.election.role);
}

static void test_a_spent_leader_does_not_wait_for_ever(void)
{
    spend_leading();
    lead_for(CHARGE_HANDOVER_TICKS - 1);
    TEST_ASSERT_TRUE(moves());
    lead_for(2);
    TEST_ASSERT_FALSE(moves());
    TEST_ASSERT_EQUAL(STATE_SPENT, brain.state);
    for (int i = 0; i < 5 * TICKS_PER_S; i++) {
        lead_for(1);
        TEST_ASSERT_NOT_EQUAL(ROLE_LEADER, brain.election.role);
    }
}

static void test_a_spent_leader_with_another_fault_gives_up_at_once(void)
{
    spend_leading();
    for (int i = 0; i < POSE_STALE_TICKS + 1; i++) {
        tell_keepalive();
        step();
    }
    TEST_ASSERT_NOT_EQUAL(ROLE_LEADER, brain.election.role);
}

/* A candidate `behind` the reference hears its leader, on it, tick by tick. */
static void hear_leader_for(int ticks, int32_t behind, uint8_t role, bool fault)
{
    for (int i = 0; i < ticks; i++) {
        struct message leader = beacon_of(LEADER, role, now * 2, 2000, 0);

        leader.beacon.fault = fault;
        tell_pose(now * 2 - behind, 0, 0);
        tell(leader);
        step();
    }
}

static void begin_to_replace(void)
{
    brief(true);
    hear_leader_for(30, 4000, ROLE_LEADER, false);
    TEST_ASSERT_EQUAL(2, brain.allocation.held);
    hear_leader_for(ELECTION_WINDOW_TICKS + 2, 4000, ROLE_LEADER, true);
}

static void test_who_replaces_a_leader_that_leads_on_goes_to_the_reference_first(void)
{
    begin_to_replace();
    TEST_ASSERT_EQUAL(ROLE_CANDIDATE, brain.election.role);
    TEST_ASSERT_EQUAL(0, brain.allocation.held);
    /* The reference's 0.5 m/s and k times the metre that it is behind. */
    TEST_ASSERT_INT_WITHIN(100, 2000 + 4000, brain.command.v);
    hear_leader_for(50, 1100, ROLE_LEADER, true);
    TEST_ASSERT_EQUAL(ROLE_CANDIDATE, brain.election.role);
    hear_leader_for(1, 900, ROLE_LEADER, true);
    TEST_ASSERT_EQUAL(ROLE_LEADER, brain.election.role);
    TEST_ASSERT_EQUAL(1, brain.allocation.held);
}

static void test_it_leads_before_the_old_leader_gives_up(void)
{
    int ticks = 0;

    begin_to_replace();
    for (; brain.election.role == ROLE_CANDIDATE && ticks < 1000; ticks++)
        hear_leader_for(1, 4000, ROLE_LEADER, true);
    TEST_ASSERT_EQUAL(ROLE_LEADER, brain.election.role);
    TEST_ASSERT_INT_WITHIN(15, CHARGE_HANDOVER_TICKS - 30, ticks);
}

static void test_it_leads_at_once_when_the_old_leader_has_given_up(void)
{
    begin_to_replace();
    hear_leader_for(1, 4000, ROLE_CANDIDATE, true);
    TEST_ASSERT_EQUAL(ROLE_LEADER, brain.election.role);
}

/* A candidate is nearer, but the old leader leads on. */
static void test_followers_stay_with_a_leader_that_hands_over(void)
{
    brief(false);
    follow_for(20);
    for (int i = 0; i < 20; i++) {
        struct message leader = beacon_of(LEADER, ROLE_LEADER, 0, 0, 0);

        leader.beacon.fault = true;
        tell_pose(-12000, 0, 0);
        tell(leader);
        tell(beacon_of(2, ROLE_CANDIDATE, -8000, 0, 0));
        step();
        TEST_ASSERT_EQUAL(LEADER, brain.about);
    }
    struct message heir = beacon_of(2, ROLE_LEADER, -8000, 0, 0);
    heir.beacon.term = 2;
    tell(heir);
    follow_for(1);
    TEST_ASSERT_EQUAL(2, brain.about);
}

static void test_noise_does_nothing(void)
{
    uint32_t state = 1;

    for (int i = 0; i < 1000; i++) {
        for (int j = 0; j < 230; j++) {
            uint8_t byte = (uint8_t)random_next(&state);

            brain_bytes(&brain, &byte, &byte + 1);
        }
        step();
        TEST_ASSERT_FALSE(moves());
    }
    TEST_ASSERT_TRUE(brain.bad_frames > 0);
    TEST_ASSERT_EQUAL(STATE_IDLE, brain.state);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_without_an_id_it_never_moves_and_says_so);
    RUN_TEST(test_motors_are_off_without_a_mission);
    RUN_TEST(test_motors_are_off_before_the_mission_starts);
    RUN_TEST(test_motors_are_off_without_a_pose);
    RUN_TEST(test_a_pose_older_than_300_ms_stops_it);
    RUN_TEST(test_a_silent_server_stops_it);
    RUN_TEST(test_a_stale_pose_stays_stale_for_ever);
    RUN_TEST(test_an_emergency_stop_outlives_missions);
    RUN_TEST(test_a_follower_is_heard_ten_times_a_second);
    RUN_TEST(test_a_leader_is_heard_by_all_twenty_times_a_second);
    RUN_TEST(test_another_candidate_is_heard_by_all_five_times_a_second);
    RUN_TEST(test_a_leader_state_is_carried_on_to_now);
    RUN_TEST(test_with_no_leader_it_follows_the_closest_candidate);
    RUN_TEST(test_a_rival_far_off_is_not_taken_for_a_near_one);
    RUN_TEST(test_with_no_candidate_it_stops);
    RUN_TEST(test_it_reports_a_stall);
    RUN_TEST(test_it_answers_at_once_and_once);
    RUN_TEST(test_a_status_and_an_answer_never_share_a_tick);
    RUN_TEST(test_readings_are_the_board_s);
    RUN_TEST(test_a_new_id_is_the_robot_s_at_once);
    RUN_TEST(test_a_new_id_has_its_own_slot);
    RUN_TEST(test_an_id_stays_during_a_mission);
    RUN_TEST(test_a_new_id_before_the_start_begins_the_mission_anew);
    RUN_TEST(test_an_id_taken_away_stops_it_before_it_starts);
    RUN_TEST(test_wheels_are_corrected_at_once);
    RUN_TEST(test_what_it_saves_outlives_power);
    RUN_TEST(test_wheels_that_lag_are_reckoned_with);
    RUN_TEST(test_a_trial_turns_the_wheels_for_200_ms);
    RUN_TEST(test_a_trial_can_be_corrected);
    RUN_TEST(test_without_an_id_there_is_no_trial);
    RUN_TEST(test_a_mission_under_way_is_not_for_trials);
    RUN_TEST(test_a_mission_that_has_not_started_allows_trials_until_then);
    RUN_TEST(test_an_emergency_stop_ends_a_trial);
    RUN_TEST(test_it_leaves_for_the_loader_once);
    RUN_TEST(test_it_leaves_for_a_programmer_that_says_so_twice);
    RUN_TEST(test_it_does_not_leave_for_a_programmer_between_zeros);
    RUN_TEST(test_it_does_not_leave_with_its_wheels_turning);
    RUN_TEST(test_a_warning_is_no_fault);
    RUN_TEST(test_a_warned_candidate_is_elected);
    RUN_TEST(test_a_spent_follower_stops_and_leaves_its_vertex);
    RUN_TEST(test_a_spent_leader_leads_on_until_another_does);
    RUN_TEST(test_a_spent_leader_does_not_wait_for_ever);
    RUN_TEST(test_a_spent_leader_with_another_fault_gives_up_at_once);
    RUN_TEST(test_who_replaces_a_leader_that_leads_on_goes_to_the_reference_first);
    RUN_TEST(test_it_leads_before_the_old_leader_gives_up);
    RUN_TEST(test_it_leads_at_once_when_the_old_leader_has_given_up);
    RUN_TEST(test_followers_stay_with_a_leader_that_hands_over);
    RUN_TEST(test_noise_does_nothing);
    return UNITY_END();
}
