#include "fake_fleet.h"

#include <string.h>
#include <unity.h>

void setUp(void)
{
    fleet_reset(4);
    fleet_start();
}

void tearDown(void)
{
    fleet_free();
}

static struct message beacon_of(uint16_t id)
{
    return (struct message){.type = MESSAGE_BEACON, .beacon = {.id = id, .role = ROLE_FOLLOWER}};
}

/* ---- beacons --------------------------------------------------------------------------- */

static void test_a_beacon_reaches_the_robots_in_range_in_the_next_tick(void)
{
    fleet_beacon(1, ROLE_FOLLOWER, 0);
    fleet_tick();
    TEST_ASSERT_TRUE(fleet_hears(0, 1));
    TEST_ASSERT_FALSE(fleet_hears(1, 1));
    TEST_ASSERT_TRUE(fleet_hears(2, 1));
    TEST_ASSERT_FALSE(fleet_hears(3, 1));
    fleet_tick();
    TEST_ASSERT_FALSE(fleet_hears(0, 1));
}

static void test_the_long_range_is_the_candidates_alone(void)
{
    struct message message = beacon_of(10);

    message.beacon.to_all = true;
    fleet_say(0, &message);
    message.beacon.id = 40;
    fleet_say(3, &message);
    fleet_tick();
    TEST_ASSERT_TRUE(fleet_hears(1, 0));
    TEST_ASSERT_TRUE(fleet_hears(3, 0));
    TEST_ASSERT_FALSE(fleet_hears(0, 3));
    TEST_ASSERT_TRUE(fleet_hears(2, 3));
}

static void test_a_beacon_under_another_robots_id_is_nobodys(void)
{
    struct message message = beacon_of(20);

    message.beacon.term = 5;
    fleet_say(0, &message);
    fleet_tick();
    for (size_t i = 0; i < 4; i++) {
        TEST_ASSERT_EQUAL_UINT(0, fleet[i].beacons);
        TEST_ASSERT_EQUAL_UINT16(0, server_look(server, i)->term);
    }
}

static void test_a_beacon_is_relayed_as_it_came(void)
{
    struct message message = {
        .type = MESSAGE_BEACON,
        .beacon = {.id = 20,
                   .time = 65000,
                   .pose = {{-123456, 654321}, 0xABCD},
                   .v = -4321,
                   .omega = 1234,
                   .role = ROLE_CANDIDATE,
                   .candidate = true,
                   .fault = true,
                   .term = 513,
                   .leader_age = 42,
                   .vertex = 1027,
                   .formation = 200},
    };

    uint8_t payload[FRAME_PAYLOAD_MAX];
    uint8_t length = message_write(payload, &message);

    fleet_say_payload(1, payload, length);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT8(length, fleet[0].length);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(payload, fleet[0].payload, length);
}

/* 1,000 beacons at a loss of one half: the standard deviation is 16. */
static void test_every_beacon_has_a_fate_of_its_own(void)
{
    unsigned heard = 0;

    fleet_free();
    fleet_reset(2);
    fleet_config.loss = 0.5;
    fleet_start();
    for (unsigned i = 0; i < 1000; i++) {
        fleet_beacon(0, ROLE_FOLLOWER, 0);
        fleet_tick();
        heard += fleet_hears(1, 0);
    }
    TEST_ASSERT_UINT_WITHIN(70, 500, heard);
}

/* A later version's beacon carries more; what cannot be relayed counts as a bad frame. */
static void test_what_a_later_version_appends_is_relayed_while_it_fits(void)
{
    struct message message = beacon_of(20);
    uint8_t payload[FRAME_PAYLOAD_MAX];
    uint8_t length = message_write(payload, &message);

    memset(payload + length, 0x77, sizeof payload - length);
    fleet_say_payload(1, payload, length + 4);
    fleet_tick();
    TEST_ASSERT_TRUE(fleet_hears(0, 1));
    TEST_ASSERT_EQUAL_UINT8(length + 4, fleet[0].length);
    TEST_ASSERT_EQUAL_UINT64(0, server_count(server).bad_frames);

    fleet_say_payload(1, payload, length + 5);
    fleet_tick();
    TEST_ASSERT_FALSE(fleet_hears(0, 1));
    TEST_ASSERT_EQUAL_UINT64(1, server_count(server).bad_frames);
}

static void test_an_unknown_message_is_no_error(void)
{
    static const uint8_t payload[] = {0x7F, 1, 2, 3};

    fleet_say_payload(0, payload, sizeof payload);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT64(0, server_count(server).bad_frames);
    TEST_ASSERT_EQUAL_UINT(0, fleet[1].beacons);
}

/* ---- reports --------------------------------------------------------------------------- */

static void test_a_beacon_tells_role_term_and_vertex(void)
{
    struct message message = beacon_of(10);

    message.beacon.term = 3;
    message.beacon.vertex = 2;
    fleet_say(0, &message);
    TEST_ASSERT_EQUAL_UINT8(ROLE_FOLLOWER, server_look(server, 0)->role);
    TEST_ASSERT_EQUAL_UINT16(3, server_look(server, 0)->term);
    TEST_ASSERT_EQUAL_UINT16(2, server_look(server, 0)->vertex);
}

static void test_roles_are_reported_when_they_change(void)
{
    fleet_beacon(0, ROLE_CANDIDATE, 0);
    fleet_beacon(0, ROLE_CANDIDATE, 0);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_ROLE, 10, ROLE_CANDIDATE));
    fleet_beacon(0, ROLE_LEADER, 1);
    fleet_beacon(0, ROLE_LEADER, 1);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_ROLE, 10, ROLE_LEADER));
}

static void test_an_election_is_a_new_leader_or_a_new_term(void)
{
    fleet_beacon(0, ROLE_LEADER, 1);
    fleet_beacon(0, ROLE_LEADER, 1);
    fleet_beacon(1, ROLE_FOLLOWER, 1);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_ELECTION, 10, 1));
    TEST_ASSERT_EQUAL_UINT(0, fleet_reported(REPORT_ELECTION, 20, 1));
    fleet_beacon(0, ROLE_LEADER, 3);
    fleet_beacon(0, ROLE_FOLLOWER, 3);
    fleet_beacon(0, ROLE_LEADER, 3);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(2, fleet_reported(REPORT_ELECTION, 10, 3));
}

static void test_vertices_are_reported_when_they_change(void)
{
    struct message message = beacon_of(40);

    for (uint16_t vertex = 0; vertex < 3; vertex++) {
        message.beacon.vertex = vertex;
        fleet_say(3, &message);
        fleet_say(3, &message);
    }
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(0, fleet_reported(REPORT_VERTEX, 40, 0));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_VERTEX, 40, 1));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_VERTEX, 40, 2));
}

static void test_faults_are_reported_when_they_change(void)
{
    fleet[2].faults = FAULT_STALL | FAULT_POSE_STALE;
    fleet_status(2);
    fleet_status(2);
    fleet[2].faults = 0;
    fleet_status(2);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_FAULT, 30, FAULT_STALL | FAULT_POSE_STALE));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_FAULT, 30, 0));
}

static void test_bad_frames_at_the_robots_end_count_too(void)
{
    fleet[2].bad_frames = 3;
    fleet_status(2);
    fleet[2].bad_frames = 5;
    fleet_status(2);
    fleet_status(2);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT64(5, server_count(server).bad_frames);
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_LINK, 30, 3));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_LINK, 30, 5));
    fleet[2].bad_frames = 1; /* since a reset */
    fleet_status(2);
    fleet[2].bad_frames = 2;
    fleet_status(2);
    TEST_ASSERT_EQUAL_UINT64(6, server_count(server).bad_frames);
}

static void test_a_status_tells_of_the_robots_health(void)
{
    struct message message = {
        .type = MESSAGE_STATUS,
        .status = {.id = 10,
                   .mission = fleet[0].mission.number,
                   .expected = fleet[0].mission.expected,
                   .state = 3,
                   .battery = 7412,
                   .tick_cycles = 9999,
                   .stack_free = 812},
    };

    fleet_say(0, &message);
    TEST_ASSERT_EQUAL_UINT8(3, server_look(server, 0)->state);
    TEST_ASSERT_EQUAL_UINT16(7412, server_look(server, 0)->battery);
    TEST_ASSERT_EQUAL_UINT16(9999, server_look(server, 0)->tick_cycles);
    TEST_ASSERT_EQUAL_UINT16(812, server_look(server, 0)->stack_free);
}

/* ---- lost missions --------------------------------------------------------------------- */

static void test_a_robot_that_was_reset_is_given_its_mission_again(void)
{
    fleet_reset_robot(0);
    fleet_status(0);
    fleet_ticks(10);
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_RESTART, 10, 0));
    TEST_ASSERT_EQUAL_UINT(1, fleet[0].missions);
    TEST_ASSERT_TRUE(fleet[0].mission.formation.number != 0);
    TEST_ASSERT_TRUE(fleet[0].mission.knots > 0);
    TEST_ASSERT_TRUE(server_waits_for(server) == SERVER_NOBODY);
    fleet_until(20000);
    TEST_ASSERT_EQUAL_UINT(1, fleet[0].missions);
}

/* Sequence numbers are back at 0 after 256 messages: no sign of a fresh start. */
static void test_a_reset_is_noticed_at_any_sequence_number(void)
{
    for (unsigned tick = 0; fleet[0].mission.expected != 0; tick++) {
        TEST_ASSERT_TRUE(tick < 2000);
        fleet_tick();
    }
    test_a_robot_that_was_reset_is_given_its_mission_again();
}

static void test_a_status_that_agrees_restarts_nothing(void)
{
    for (unsigned i = 0; i < 100; i++) {
        fleet_status(i % 4);
        fleet_tick();
    }
    for (uint16_t id = 10; id <= 40; id += 10)
        TEST_ASSERT_EQUAL_UINT(0, fleet_reported(REPORT_RESTART, id, 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_beacon_reaches_the_robots_in_range_in_the_next_tick);
    RUN_TEST(test_the_long_range_is_the_candidates_alone);
    RUN_TEST(test_a_beacon_under_another_robots_id_is_nobodys);
    RUN_TEST(test_a_beacon_is_relayed_as_it_came);
    RUN_TEST(test_every_beacon_has_a_fate_of_its_own);
    RUN_TEST(test_what_a_later_version_appends_is_relayed_while_it_fits);
    RUN_TEST(test_an_unknown_message_is_no_error);
    RUN_TEST(test_a_beacon_tells_role_term_and_vertex);
    RUN_TEST(test_roles_are_reported_when_they_change);
    RUN_TEST(test_an_election_is_a_new_leader_or_a_new_term);
    RUN_TEST(test_vertices_are_reported_when_they_change);
    RUN_TEST(test_faults_are_reported_when_they_change);
    RUN_TEST(test_bad_frames_at_the_robots_end_count_too);
    RUN_TEST(test_a_status_tells_of_the_robots_health);
    RUN_TEST(test_a_robot_that_was_reset_is_given_its_mission_again);
    RUN_TEST(test_a_reset_is_noticed_at_any_sequence_number);
    RUN_TEST(test_a_status_that_agrees_restarts_nothing);
    return UNITY_END();
}
