#include "brain.h"

#include "random.h"

#include <string.h>
#include <unity.h>

#define OWN 7
#define LEADER 1

static struct brain brain;
static struct brain_output output;
static const struct brain_input input = {.battery = 7400};
static int32_t now; /* mission time of the coming tick, ms */
static uint8_t sequence;

static void switch_on(uint16_t id)
{
    struct parameters parameters;
    uint8_t eeprom[PARAMETERS_BYTES];

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
    RUN_TEST(test_noise_does_nothing);
    return UNITY_END();
}
