#include "fake_fleet.h"

#include "random.h"

#include <string.h>
#include <unity.h>

void setUp(void)
{
    fleet_reset(3);
}

void tearDown(void)
{
    fleet_free();
}

/* ---- start ----------------------------------------------------------------------------- */

static void test_the_mission_starts_when_all_have_acknowledged_it(void)
{
    fleet_power_on();
    fleet[2].deaf = true;
    fleet_ticks(20);
    for (unsigned tick = 0; tick < 3 * 60 * TICKS_PER_S; tick++) {
        fleet_tick();
        TEST_ASSERT_TRUE(server_time(server) <= -10000);
        TEST_ASSERT_EQUAL_UINT64(2, server_waits_for(server));
    }
    fleet[2].deaf = false;
    fleet_until(-500);
    TEST_ASSERT_TRUE(server_waits_for(server) == SERVER_NOBODY);
    TEST_ASSERT_EQUAL_INT32(-500, server_time(server));
}

static void test_t_0_comes_half_a_second_later_and_is_reported(void)
{
    fleet_power_on();
    fleet_until(-500);
    for (int32_t time = -500; time < 0; time += TICK_MS) {
        TEST_ASSERT_EQUAL_INT32(time, server_time(server));
        TEST_ASSERT_EQUAL_UINT(0, fleet_reported(REPORT_START, 0, 0));
        fleet_tick();
    }
    TEST_ASSERT_EQUAL_INT32(0, server_time(server));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_START, 0, 0));
    fleet_ticks(500);
    TEST_ASSERT_EQUAL_INT32(10000, server_time(server));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_START, 0, 0));
}

static void test_a_robot_without_a_link_is_not_waited_for(void)
{
    fleet_power_on();
    server_link(server, 1, false);
    for (unsigned tick = 0; tick < 100 && server_time(server) < 0; tick++)
        fleet_tick();
    TEST_ASSERT_EQUAL_INT32(0, server_time(server));
    TEST_ASSERT_EQUAL_UINT(0, fleet[1].frames);
}

static void test_with_no_link_at_all_nothing_starts(void)
{
    fleet_power_on();
    for (size_t i = 0; i < 3; i++)
        server_link(server, i, false);
    fleet_ticks(200);
    TEST_ASSERT_TRUE(server_time(server) <= -10000);
}

/* ---- links ----------------------------------------------------------------------------- */

static void test_a_late_robot_is_given_the_mission_while_time_goes_on(void)
{
    struct reference reference;

    fleet_power_on();
    server_link(server, 1, false);
    fleet_until(20000);
    server_link(server, 1, true);
    fleet_ticks(4);
    TEST_ASSERT_EQUAL_INT32(20080, server_time(server));
    TEST_ASSERT_TRUE(server_waits_for(server) == SERVER_NOBODY);
    TEST_ASSERT_EQUAL_UINT16(4, fleet[1].mission.formation.total);
    TEST_ASSERT_TRUE(mission_reference(&fleet[1].mission, 20080, &reference));
    TEST_ASSERT_INT32_WITHIN(1, 20080 * NARROW_PER_M / 1000, reference.pose.at.x);
}

/* The robot has kept its mission, the link has not. */
static void test_a_link_that_comes_back_is_uploaded_to_from_the_start(void)
{
    fleet_start();
    server_link(server, 0, false);
    fleet_ticks(20);
    TEST_ASSERT_EQUAL_UINT(0, fleet[0].frames);
    server_link(server, 0, true);
    fleet_ticks(20);
    TEST_ASSERT_EQUAL_UINT(2, fleet[0].missions);
    TEST_ASSERT_TRUE(server_waits_for(server) == SERVER_NOBODY);
    fleet_until(20000);
    TEST_ASSERT_EQUAL_UINT(2, fleet[0].missions);
    TEST_ASSERT_FALSE(fleet[0].mission.refused);
    TEST_ASSERT_EQUAL_UINT(0, fleet_reported(REPORT_RESTART, 10, 0));
}

static void test_what_waited_for_a_lost_link_is_gone(void)
{
    fleet_start();
    fleet_room = 20;
    fleet_beacon(1, ROLE_FOLLOWER, 0);
    fleet_tick();
    TEST_ASSERT_FALSE(fleet_hears(0, 1));
    server_link(server, 0, false);
    server_link(server, 0, true);
    fleet_reset_robot(0);
    fleet_room = FLEET_ROOM;
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(0, fleet[0].bad);
    TEST_ASSERT_EQUAL_UINT(0, fleet[0].beacons);
}

static void test_of_an_unlinked_robot_nothing_is_known(void)
{
    fleet_start();
    fleet_beacon(0, ROLE_LEADER, 7);
    fleet[0].faults = FAULT_STALL;
    fleet_status(0);
    TEST_ASSERT_EQUAL_UINT16(7, server_look(server, 0)->term);
    server_link(server, 0, false);
    TEST_ASSERT_FALSE(server_look(server, 0)->linked);
    TEST_ASSERT_EQUAL_UINT16(0, server_look(server, 0)->term);
    TEST_ASSERT_EQUAL_UINT8(0, server_look(server, 0)->faults);
}

static void test_before_its_first_beacon_a_robot_has_the_role_it_starts_in(void)
{
    fleet_start();
    TEST_ASSERT_EQUAL_UINT8(ROLE_CANDIDATE, server_look(server, 1)->role);
    TEST_ASSERT_EQUAL_UINT8(ROLE_FOLLOWER, server_look(server, 2)->role);
    server_link(server, 1, false);
    TEST_ASSERT_EQUAL_UINT8(ROLE_FOLLOWER, server_look(server, 1)->role);
    server_link(server, 1, true);
    TEST_ASSERT_EQUAL_UINT8(ROLE_CANDIDATE, server_look(server, 1)->role);
}

/* ---- leader ---------------------------------------------------------------------------- */

static void test_who_says_so_leads(void)
{
    fleet_start();
    TEST_ASSERT_TRUE(server_leader(server) == SERVER_NOBODY);
    fleet_beacon(1, ROLE_LEADER, 1);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT64(1, server_leader(server));
    fleet_beacon(1, ROLE_FOLLOWER, 1);
    fleet_tick();
    TEST_ASSERT_TRUE(server_leader(server) == SERVER_NOBODY);
}

static void test_of_two_leaders_the_later_term_counts_then_the_smaller_id(void)
{
    fleet_start();
    fleet_beacon(0, ROLE_LEADER, 1);
    fleet_beacon(1, ROLE_LEADER, 1);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT64(0, server_leader(server));
    fleet_beacon(1, ROLE_LEADER, 2);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT64(1, server_leader(server));
    fleet_robots[1].id = 5;
    fleet_beacon(0, ROLE_LEADER, 2);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT64(1, server_leader(server));
}

static void test_a_dead_leader_leads_no_more(void)
{
    fleet_start();
    fleet_beacon(0, ROLE_LEADER, 1);
    fleet_tick();
    server_link(server, 0, false);
    fleet_tick();
    TEST_ASSERT_TRUE(server_leader(server) == SERVER_NOBODY);
}

/* ---- counts ---------------------------------------------------------------------------- */

static void test_frames_and_bytes_of_both_ways_are_counted(void)
{
    fleet_start();
    for (unsigned i = 0; i < 100; i++) {
        fleet_beacon(i % 3, ROLE_FOLLOWER, 0);
        fleet_tick();
    }
    struct server_counters counters = server_count(server);
    TEST_ASSERT_EQUAL_UINT64(fleet_bytes, counters.bytes);
    TEST_ASSERT_EQUAL_UINT64(fleet_frames, counters.frames);
    TEST_ASSERT_EQUAL_UINT64(0, counters.dropped);
    TEST_ASSERT_EQUAL_UINT64(0, counters.bad_frames);
}

static void test_a_beacon_that_gives_way_is_counted(void)
{
    fleet_start();
    fleet_beacon(0, ROLE_FOLLOWER, 1);
    fleet_beacon(0, ROLE_FOLLOWER, 2);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(1, fleet[1].beacons);
    TEST_ASSERT_EQUAL_UINT16(2, fleet[1].beacon[0].term);
    TEST_ASSERT_EQUAL_UINT64(1, server_count(server).dropped);
}

/* ---- bad links ------------------------------------------------------------------------- */

static void test_garbage_is_counted_and_does_no_harm(void)
{
    uint8_t bytes[257];
    uint32_t state = 1;

    fleet_start();
    for (unsigned i = 0; i < 3000; i++) {
        for (size_t j = 0; j < sizeof bytes; j++)
            bytes[j] = (uint8_t)(random_next(&state) >> 24);
        server_receive(server, i % 3, bytes, sizeof bytes);
    }
    TEST_ASSERT_TRUE(server_count(server).bad_frames > 1000);
    server_receive(server, 0, (const uint8_t[]){0}, 1);
    fleet_beacon(0, ROLE_LEADER, 3);
    fleet_tick();
    TEST_ASSERT_TRUE(fleet_hears(1, 0));
}

/* Good frames with a byte changed: none gets through. */
static void test_a_changed_frame_is_counted_and_not_heard(void)
{
    struct message message = {.type = MESSAGE_BEACON,
                              .beacon = {.id = 10, .role = ROLE_LEADER, .term = 9}};
    uint8_t payload[FRAME_PAYLOAD_MAX], frame[FRAME_BYTES_MAX];
    uint8_t length = frame_encode(frame, payload, message_write(payload, &message));

    fleet_start();
    for (uint8_t i = 0; i + 1 < length; i++) {
        frame[i] ^= 0x55;
        server_receive(server, 0, frame, length);
        frame[i] ^= 0x55;
        TEST_ASSERT_TRUE(server_count(server).bad_frames > i);
    }
    TEST_ASSERT_EQUAL_UINT16(0, server_look(server, 0)->term);
}

static void test_a_message_out_of_range_is_a_bad_frame(void)
{
    static const uint8_t short_beacon[] = {MESSAGE_BEACON, 10, 0, 0};

    fleet_start();
    fleet_say_payload(0, short_beacon, sizeof short_beacon);
    TEST_ASSERT_EQUAL_UINT64(1, server_count(server).bad_frames);
}

/* ---- in real time ---------------------------------------------------------------------- */

static void everyone_speaks(void)
{
    for (size_t i = 0; i < fleet_config.robot_count; i++)
        fleet_status(i);
}

static void test_a_server_that_waits_begins_when_told_to(void)
{
    fleet_config.waits = true;
    fleet_power_on();
    everyone_speaks();
    fleet_ticks(500);
    TEST_ASSERT_TRUE(server_waits_for(server) == SERVER_NOBODY);
    TEST_ASSERT_TRUE(server_time(server) <= -10000);
    server_begin(server);
    fleet_tick();
    TEST_ASSERT_EQUAL_INT32(-500, server_time(server));
}

static void test_where_there_is_a_wait_nobody_is_told_anything_before_it_has_spoken(void)
{
    fleet_config.waits = true;
    fleet_power_on();
    fleet_status(1);
    fleet_ticks(10);
    TEST_ASSERT_EQUAL_UINT(0, fleet[0].missions);
    TEST_ASSERT_EQUAL_UINT(1, fleet[1].missions);
}

/* All that another server has told a robot, under the number that this one begins with, is void. */
static void test_a_mission_of_another_server_is_never_taken_for_this_ones(void)
{
    fleet_config.waits = true;
    fleet_config.mission.mission = 9;
    fleet[0].mission.number = 9;
    fleet[0].mission.expected = 2;
    fleet_power_on();
    fleet_status(0);
    fleet_ticks(10);
    TEST_ASSERT_EQUAL_UINT(1, fleet[0].missions);
    TEST_ASSERT_EQUAL_UINT8(10, fleet[0].mission.number);
    TEST_ASSERT_TRUE(server_look(server, 0)->acknowledged);
}

static void test_told_to_begin_it_waits_for_nobody_but_the_first(void)
{
    fleet_config.waits = true;
    for (size_t i = 0; i < 3; i++)
        fleet[i].deaf = true;
    fleet_power_on();
    everyone_speaks();
    server_begin(server);
    fleet_ticks(100);
    TEST_ASSERT_TRUE(server_time(server) <= -10000);
    fleet[1].deaf = false;
    fleet_until(1000);
    TEST_ASSERT_FALSE(server_look(server, 0)->acknowledged);
    TEST_ASSERT_TRUE(server_look(server, 1)->acknowledged);
}

static void test_a_halted_robot_is_told_that_nothing_has_begun(void)
{
    fleet_start();
    fleet_beacon(0, ROLE_LEADER, 1);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT64(0, server_leader(server));
    server_halt(server, 0);
    fleet_tick();
    TEST_ASSERT_TRUE(server_leader(server) == SERVER_NOBODY);
    TEST_ASSERT_EQUAL_UINT(1, fleet[0].frames);
    TEST_ASSERT_EQUAL_UINT(1, fleet[0].keepalives);
    TEST_ASSERT_TRUE(fleet[0].told < -10000);
    TEST_ASSERT_EQUAL_UINT(1, fleet[1].poses);
    fleet_beacon(0, ROLE_LEADER, 1);
    fleet_tick();
    TEST_ASSERT_FALSE(fleet_hears(1, 0));
    TEST_ASSERT_TRUE(server_look(server, 0)->halted);
    TEST_ASSERT_FALSE(server_look(server, 0)->linked);
}

static void test_what_a_halted_robot_says_of_itself_is_heard(void)
{
    fleet_start();
    fleet[0].state = STATE_RUN;
    fleet_status(0);
    server_halt(server, SERVER_NOBODY);
    TEST_ASSERT_EQUAL_UINT8(STATE_RUN, server_look(server, 0)->state);
    fleet[0].state = STATE_READY;
    fleet_status(0);
    TEST_ASSERT_EQUAL_UINT8(STATE_READY, server_look(server, 0)->state);
    for (size_t i = 0; i < 3; i++)
        TEST_ASSERT_TRUE(server_look(server, i)->halted);
}

static void test_a_halt_outlives_the_link(void)
{
    fleet_start();
    server_halt(server, 0);
    server_link(server, 0, false);
    server_link(server, 0, true);
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(0, fleet[0].poses);
    TEST_ASSERT_EQUAL_UINT(1, fleet[0].keepalives);
}

static void test_who_is_resumed_gets_the_mission_anew(void)
{
    fleet_start();
    unsigned missions = fleet[0].missions;
    server_halt(server, 0);
    fleet_ticks(10);
    server_resume(server, 0);
    fleet_ticks(20);
    TEST_ASSERT_EQUAL_UINT(missions + 1, fleet[0].missions);
    TEST_ASSERT_EQUAL_UINT(1, fleet[0].poses);
    TEST_ASSERT_TRUE(server_look(server, 0)->linked);
}

static void test_a_stranger_takes_no_part(void)
{
    fleet_start();
    fleet[1].says_id = 77;
    fleet_status(1);
    fleet_status(1);
    TEST_ASSERT_EQUAL_UINT(0, fleet_reported(REPORT_STRANGER, 20, 77));
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_STRANGER, 20, 77));
    TEST_ASSERT_EQUAL_UINT(0, fleet[1].frames);
    TEST_ASSERT_TRUE(server_look(server, 1)->stranger);
    TEST_ASSERT_EQUAL_UINT16(77, server_look(server, 1)->id);
    TEST_ASSERT_FALSE(server_look(server, 1)->linked);
}

static void test_a_stranger_that_turns_out_to_be_the_one_takes_part(void)
{
    fleet_start();
    fleet[1].says_id = 77;
    fleet_status(1);
    fleet[1].says_id = 0;
    fleet_status(1);
    fleet_ticks(2);
    TEST_ASSERT_TRUE(server_look(server, 1)->linked);
    TEST_ASSERT_EQUAL_UINT(1, fleet[1].poses);
}

static void test_an_emergency_stop_from_outside(void)
{
    fleet_start();
    fleet_tick();
    server_estop(server);
    fleet_listen(2);
    TEST_ASSERT_EQUAL_UINT(1, fleet[2].estops);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_mission_starts_when_all_have_acknowledged_it);
    RUN_TEST(test_t_0_comes_half_a_second_later_and_is_reported);
    RUN_TEST(test_a_robot_without_a_link_is_not_waited_for);
    RUN_TEST(test_with_no_link_at_all_nothing_starts);
    RUN_TEST(test_a_late_robot_is_given_the_mission_while_time_goes_on);
    RUN_TEST(test_a_link_that_comes_back_is_uploaded_to_from_the_start);
    RUN_TEST(test_what_waited_for_a_lost_link_is_gone);
    RUN_TEST(test_of_an_unlinked_robot_nothing_is_known);
    RUN_TEST(test_before_its_first_beacon_a_robot_has_the_role_it_starts_in);
    RUN_TEST(test_who_says_so_leads);
    RUN_TEST(test_of_two_leaders_the_later_term_counts_then_the_smaller_id);
    RUN_TEST(test_a_dead_leader_leads_no_more);
    RUN_TEST(test_a_server_that_waits_begins_when_told_to);
    RUN_TEST(test_where_there_is_a_wait_nobody_is_told_anything_before_it_has_spoken);
    RUN_TEST(test_a_mission_of_another_server_is_never_taken_for_this_ones);
    RUN_TEST(test_told_to_begin_it_waits_for_nobody_but_the_first);
    RUN_TEST(test_a_halted_robot_is_told_that_nothing_has_begun);
    RUN_TEST(test_what_a_halted_robot_says_of_itself_is_heard);
    RUN_TEST(test_a_halt_outlives_the_link);
    RUN_TEST(test_who_is_resumed_gets_the_mission_anew);
    RUN_TEST(test_a_stranger_takes_no_part);
    RUN_TEST(test_a_stranger_that_turns_out_to_be_the_one_takes_part);
    RUN_TEST(test_an_emergency_stop_from_outside);
    RUN_TEST(test_frames_and_bytes_of_both_ways_are_counted);
    RUN_TEST(test_a_beacon_that_gives_way_is_counted);
    RUN_TEST(test_garbage_is_counted_and_does_no_harm);
    RUN_TEST(test_a_changed_frame_is_counted_and_not_heard);
    RUN_TEST(test_a_message_out_of_range_is_a_bad_frame);
    return UNITY_END();
}
