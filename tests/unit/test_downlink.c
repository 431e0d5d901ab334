#include "fake_fleet.h"

#include "random.h"

#include <math.h>
#include <unity.h>

void setUp(void)
{
    fleet_reset(4);
}

void tearDown(void)
{
    fleet_free();
}

/* Everyone within range says something. */
static void crowd_the_links(void)
{
    for (size_t i = 0; i < fleet_config.robot_count; i++)
        fleet_beacon(i, ROLE_FOLLOWER, 0);
}

/* ---- poses ----------------------------------------------------------------------------- */

static void test_the_pose_of_this_moment_goes_first(void)
{
    fleet_power_on();
    for (unsigned tick = 0; tick < 200; tick++) {
        fleet_poses[2] = (struct server_pose){-1.5 + tick, 0.25, -M_PI / 2, true, 0};
        crowd_the_links();
        fleet_tick();
        TEST_ASSERT_EQUAL_UINT8(MESSAGE_POSE, fleet[2].first);
        TEST_ASSERT_EQUAL_UINT(1, fleet[2].poses);
        TEST_ASSERT_EQUAL_INT32(server_time(server), fleet[2].pose.time);
        TEST_ASSERT_EQUAL_INT32(-6000 + NARROW_PER_M * (int32_t)tick, fleet[2].pose.pose.at.x);
        TEST_ASSERT_EQUAL_INT32(1000, fleet[2].pose.pose.at.y);
        TEST_ASSERT_EQUAL_UINT16(49152, fleet[2].pose.pose.theta);
    }
}

static void test_the_stamp_of_a_pose_is_when_it_was_measured(void)
{
    fleet_start();
    fleet_poses[0].age_ms = 7;
    fleet_tick();
    TEST_ASSERT_EQUAL_INT32(server_time(server) - 7, fleet[0].pose.time);
    TEST_ASSERT_EQUAL_INT32(server_time(server), fleet[1].pose.time);
}

/* 60 bytes a tick take the end of a cut beacon (28 bytes) and a pose (17), not all the beacons. */
static void test_a_crowded_link_still_brings_every_pose(void)
{
    fleet_config.range = 10;
    fleet_start();
    fleet_room = 60;
    for (unsigned tick = 0; tick < 200; tick++) {
        crowd_the_links();
        fleet_tick();
        TEST_ASSERT_EQUAL_UINT(1, fleet[1].poses);
        TEST_ASSERT_EQUAL_INT32(server_time(server), fleet[1].pose.time);
    }
    TEST_ASSERT_EQUAL_UINT(0, fleet[1].bad);
    TEST_ASSERT_TRUE(server_count(server).dropped > 0);
}

static void test_without_a_pose_there_is_a_keep_alive_at_10_hz(void)
{
    unsigned keepalives = 0;

    fleet_start();
    fleet_poses[1].tracked = false;
    for (unsigned tick = 0; tick < TICKS_PER_S; tick++) {
        fleet_tick();
        TEST_ASSERT_EQUAL_UINT(0, fleet[1].poses);
        TEST_ASSERT_EQUAL_UINT(1, fleet[0].poses);
        keepalives += fleet[1].keepalives;
    }
    TEST_ASSERT_EQUAL_UINT(10, keepalives);
}

static void test_with_a_pose_there_is_no_keep_alive(void)
{
    fleet_start();
    for (unsigned tick = 0; tick < TICKS_PER_S; tick++) {
        fleet_tick();
        TEST_ASSERT_EQUAL_UINT(0, fleet[1].keepalives);
    }
}

/* ---- mission --------------------------------------------------------------------------- */

static void test_every_robot_is_given_mission_and_formation(void)
{
    static const struct vec16 vertices[] = {{0, 0}, {8000, 0}, {0, 8000}, {-8000, 0}};

    fleet_start();
    for (size_t i = 0; i < 4; i++) {
        const struct mission *mission = &fleet[i].mission;

        TEST_ASSERT_EQUAL_UINT(1, fleet[i].missions);
        TEST_ASSERT_EQUAL_UINT8(PROTOCOL_VERSION, mission->parameters.version);
        TEST_ASSERT_EQUAL_UINT16(3 * GAIN_ONE, mission->parameters.k_theta);
        TEST_ASSERT_EQUAL_UINT8(i < 2, mission->parameters.candidate);
        TEST_ASSERT_EQUAL_UINT8(ALLOCATION_CPA, mission->parameters.allocation);
        TEST_ASSERT_EQUAL_UINT16(4, mission->formation.total);
        TEST_ASSERT_EQUAL_UINT16(1, mission->formation.leader);
        for (size_t j = 0; j < 4; j++) {
            TEST_ASSERT_INT16_WITHIN(1, vertices[j].x, mission->formation.vertex[j].x);
            TEST_ASSERT_INT16_WITHIN(1, vertices[j].y, mission->formation.vertex[j].y);
        }
        TEST_ASSERT_FALSE(mission->refused);
    }
}

static void test_the_allocation_is_the_scenarios(void)
{
    static const uint8_t expected[] = {
        [SERVER_CPA] = ALLOCATION_CPA,
        [SERVER_CPA_LITERAL] = ALLOCATION_CPA_LITERAL,
        [SERVER_RIGID] = ALLOCATION_ASSIGNED,
        [SERVER_OPTIMAL] = ALLOCATION_ASSIGNED,
    };

    for (size_t i = 0; i < sizeof expected; i++) {
        fleet_reset(2);
        fleet_config.allocation = (enum server_allocation)i;
        fleet_start();
        TEST_ASSERT_EQUAL_UINT8(expected[i], fleet[1].mission.parameters.allocation);
        fleet_free();
    }
}

static void test_candidates_alone_are_given_the_trajectory(void)
{
    fleet_start();
    fleet_until(5000);
    TEST_ASSERT_TRUE(fleet[0].mission.knots > 0);
    TEST_ASSERT_TRUE(fleet[1].mission.knots > 0);
    TEST_ASSERT_EQUAL_UINT8(0, fleet[2].mission.knots);
    TEST_ASSERT_EQUAL_UINT8(0, fleet[3].mission.knots);
}

/* The robot's window of knots always holds the one in force, and some that are to come. */
static void test_the_reference_is_there_before_it_is_needed(void)
{
    struct reference reference;

    fleet_start();
    while (server_time(server) < 36000) {
        fleet_tick();
        for (int32_t ahead = 0; ahead <= 2000; ahead += 500) {
            int32_t time = server_time(server) + ahead;

            TEST_ASSERT_TRUE(mission_reference(&fleet[0].mission, time, &reference));
            TEST_ASSERT_INT32_WITHIN(1, time * (NARROW_PER_M / 1000), reference.pose.at.x);
        }
    }
}

/* Every fiftieth byte is lost: half of the frames. */
static void test_a_bad_link_gets_the_mission_in_the_end(void)
{
    uint8_t bytes[FLEET_ROOM];
    uint32_t state = 1;
    struct fake_robot *r = &fleet[0];
    struct message message;

    fleet_reset(1);
    fleet_power_on();
    for (unsigned tick = 0; server_time(server) < 0; tick++) {
        TEST_ASSERT_TRUE(tick < 5000);
        fleet_see(0);
        server_tick(server);
        size_t count = server_take(server, 0, bytes, sizeof bytes);

        for (size_t i = 0; i < count; i++) {
            bool lost = random_next(&state) % 100 < 2;

            if (!lost && frame_decode(&r->decoder, bytes[i]) == FRAME_READY &&
                message_read(&message, r->decoder.payload, r->decoder.length))
                mission_take(&r->mission, &message);
        }
        fleet_status(0);
    }
    TEST_ASSERT_EQUAL_UINT16(4, r->mission.formation.total);
    TEST_ASSERT_FALSE(r->mission.refused);
}

static void test_an_upload_takes_the_whole_of_a_free_link(void)
{
    fleet_power_on();
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(10, fleet[0].frames); /* pose, mission, formation, seven knots: 228 */
}

static void test_an_upload_leaves_half_the_link_to_beacons(void)
{
    fleet_start();
    for (unsigned tick = 0; tick < 20; tick++) {
        fleet_reset_robot(0);
        fleet_status(0);
        fleet_beacon(1, ROLE_FOLLOWER, 0);
        fleet_tick();
        TEST_ASSERT_TRUE(fleet_hears(0, 1));
        TEST_ASSERT_TRUE(fleet[0].mission.number != 0);
    }
}

/* ---- emergency stop -------------------------------------------------------------------- */

static const struct event stop = {.action = EVENT_ESTOP, .at_tick = 50};

static void test_an_emergency_stop_is_repeated_until_it_is_confirmed(void)
{
    unsigned stops[4] = {0};

    fleet_config.event_count = 1;
    fleet_config.events = &stop;
    fleet_start();
    for (unsigned tick = 0; tick < 3 * TICKS_PER_S; tick++) {
        fleet_tick();
        for (size_t i = 0; i < 4; i++) {
            TEST_ASSERT_TRUE(fleet[i].estops == 0 || server_time(server) >= 1000);
            stops[i] += fleet[i].estops;
        }
        if (stops[0] == 1) {
            fleet[0].faults = FAULT_ESTOP;
            fleet_status(0);
        }
    }
    TEST_ASSERT_EQUAL_UINT(1, stops[0]);
    for (size_t i = 1; i < 4; i++)
        TEST_ASSERT_UINT_WITHIN(1, 20, stops[i]); /* 10 Hz for the 2 s that are left */
}

static void test_who_returns_to_a_stopped_fleet_is_stopped_too(void)
{
    unsigned stops = 0;

    fleet_config.event_count = 1;
    fleet_config.events = &stop;
    fleet_start();
    fleet[3].faults = FAULT_ESTOP;
    fleet_until(2000);
    server_link(server, 3, false);
    fleet_tick();
    fleet_reset_robot(3);
    server_link(server, 3, true);
    for (unsigned tick = 0; tick < 5; tick++) {
        fleet_tick();
        stops += fleet[3].estops;
    }
    TEST_ASSERT_EQUAL_UINT(1, stops);
}

/* ---- in real time ---------------------------------------------------------------------- */

static void test_a_pose_between_ticks_goes_out_at_once_and_bears_its_own_time(void)
{
    struct server_pose pose = {1.5, 0, 0, true, -7};

    fleet_start();
    server_see(server, 0, &pose);
    fleet_listen(0);
    TEST_ASSERT_EQUAL_UINT(1, fleet[0].poses);
    TEST_ASSERT_EQUAL_INT32(server_time(server) + 7, fleet[0].pose.time);
    fleet_listen(0);
    TEST_ASSERT_EQUAL_UINT(0, fleet[0].frames);
}

static void test_a_pose_goes_out_once(void)
{
    fleet_start();
    fleet[0].unseen = true;
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(0, fleet[0].poses);
    TEST_ASSERT_EQUAL_UINT(1, fleet[1].poses);
}

static void test_a_pose_that_is_not_renewed_is_none(void)
{
    unsigned keepalives = 0;

    fleet_start();
    fleet[0].unseen = true;
    fleet_ticks(SERVER_POSE_OLD_MS / TICK_MS);
    for (unsigned tick = 0; tick < 10 * TICKS_PER_S; tick++) {
        fleet_tick();
        TEST_ASSERT_EQUAL_UINT(0, fleet[0].poses);
        keepalives += fleet[0].keepalives;
    }
    TEST_ASSERT_EQUAL_UINT(100, keepalives);
}

static void test_a_keep_alive_comes_once_a_tick_however_often_bytes_are_taken(void)
{
    unsigned keepalives = 0;

    fleet_start();
    fleet_poses[1].tracked = false;
    for (unsigned tick = 0; tick < TICKS_PER_S; tick++) {
        fleet_tick();
        keepalives += fleet[1].keepalives;
        fleet_listen(1);
        keepalives += fleet[1].keepalives;
    }
    TEST_ASSERT_EQUAL_UINT(10, keepalives);
}

/* 960 bytes a second, of which poses take their half: a knot still finds its way past beacons. */
static void test_a_slow_link_gets_its_mission_too(void)
{
    fleet_room = 33;
    fleet_power_on();
    for (unsigned tick = 0; tick < 20 * TICKS_PER_S && server_time(server) < 0; tick++) {
        for (size_t i = 0; i < 3; i++)
            fleet_beacon(i, ROLE_FOLLOWER, 0);
        fleet_tick();
    }
    TEST_ASSERT_EQUAL_INT32(0, server_time(server));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_pose_of_this_moment_goes_first);
    RUN_TEST(test_the_stamp_of_a_pose_is_when_it_was_measured);
    RUN_TEST(test_a_crowded_link_still_brings_every_pose);
    RUN_TEST(test_without_a_pose_there_is_a_keep_alive_at_10_hz);
    RUN_TEST(test_with_a_pose_there_is_no_keep_alive);
    RUN_TEST(test_a_pose_between_ticks_goes_out_at_once_and_bears_its_own_time);
    RUN_TEST(test_a_pose_goes_out_once);
    RUN_TEST(test_a_pose_that_is_not_renewed_is_none);
    RUN_TEST(test_a_keep_alive_comes_once_a_tick_however_often_bytes_are_taken);
    RUN_TEST(test_every_robot_is_given_mission_and_formation);
    RUN_TEST(test_the_allocation_is_the_scenarios);
    RUN_TEST(test_candidates_alone_are_given_the_trajectory);
    RUN_TEST(test_the_reference_is_there_before_it_is_needed);
    RUN_TEST(test_a_bad_link_gets_the_mission_in_the_end);
    RUN_TEST(test_an_upload_takes_the_whole_of_a_free_link);
    RUN_TEST(test_an_upload_leaves_half_the_link_to_beacons);
    RUN_TEST(test_a_slow_link_gets_its_mission_too);
    RUN_TEST(test_an_emergency_stop_is_repeated_until_it_is_confirmed);
    RUN_TEST(test_who_returns_to_a_stopped_fleet_is_stopped_too);
    return UNITY_END();
}
