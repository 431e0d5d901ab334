#include "fake_fleet.h"

#include <unity.h>

#define AT_TICK 50
#define AT_MS (AT_TICK * TICK_MS)

void setUp(void)
{
    fleet_reset(4);
}

void tearDown(void)
{
    fleet_free();
}

static void given(size_t count, const struct event *events)
{
    fleet_config.event_count = count;
    fleet_config.events = events;
}

/* Does the other hear it in the tick after this one? */
static bool passes(size_t sender, size_t receiver)
{
    fleet_beacon(sender, ROLE_FOLLOWER, 0);
    fleet_tick();
    return fleet_hears(receiver, sender);
}

static void elect(size_t robot)
{
    fleet_beacon(robot, ROLE_LEADER, 1);
}

static void test_an_event_happens_at_its_tick_and_once(void)
{
    struct event event = {.action = EVENT_STALL, .at_tick = AT_TICK, .robot = 30};

    given(1, &event);
    fleet_start();
    fleet_until(AT_MS - TICK_MS);
    TEST_ASSERT_EQUAL_UINT(0, fleet_ordered(EVENT_STALL, 2));
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_STALL, 2));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_EVENT, 30, EVENT_STALL));
    fleet_ticks(200);
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_STALL, 2));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_EVENT, 30, EVENT_STALL));
}

static void test_an_event_at_0_does_not_wait_nor_hurry(void)
{
    struct event event = {.action = EVENT_KILL, .robot = 30};

    given(1, &event);
    fleet_start();
    TEST_ASSERT_EQUAL_INT32(0, server_time(server));
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_KILL, 2));

    fleet_free();
    fleet_reset(4);
    given(1, &event);
    fleet_power_on();
    fleet_until(-TICK_MS);
    TEST_ASSERT_EQUAL_UINT(0, fleet_ordered(EVENT_KILL, 2));
}

static void test_power_and_wheels_are_orders_for_the_robot_named(void)
{
    struct event events[] = {{.action = EVENT_KILL, .robot = 10},
                             {.action = EVENT_REVIVE, .robot = 20},
                             {.action = EVENT_DRAIN, .robot = 30},
                             {.action = EVENT_STALL, .robot = 40}};

    given(4, events);
    fleet_start();
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_KILL, 0));
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_REVIVE, 1));
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_DRAIN, 2));
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_STALL, 3));
}

static void assert_waits_for_a_leader(enum event_action action)
{
    struct event event = {.action = action, .at_tick = AT_TICK, .robot = EVENT_LEADER};

    given(1, &event);
    fleet_start();
    fleet_until(3 * AT_MS);
    for (size_t i = 0; i < 4; i++)
        TEST_ASSERT_EQUAL_UINT(0, fleet_ordered(action, i));
    elect(1);
    fleet_ticks(20);
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(action, 1));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_EVENT, 20, action));
}

static void test_the_leaders_death_waits_for_a_leader(void)
{
    assert_waits_for_a_leader(EVENT_KILL);
}

static void test_the_leaders_empty_battery_waits_for_a_leader(void)
{
    assert_waits_for_a_leader(EVENT_DRAIN);
}

/* Holds once the leader has come as far as the context says. */
static bool beyond(const void *condition, const struct event_view *view)
{
    return view->x >= *(const double *)condition;
}

static void test_a_condition_is_about_the_leader_and_holds_once(void)
{
    static const double limit = 5;
    struct event event = {
        .action = EVENT_FORMATION, .formation = 1, .when = beyond, .condition = &limit};

    given(1, &event);
    fleet_start();
    fleet_poses[0].x = fleet_poses[1].x = fleet_poses[2].x = 9;
    fleet_ticks(10);
    TEST_ASSERT_EQUAL_UINT16(0, server_formation(server)); /* nobody leads */
    fleet_poses[1].x = 4.9;
    elect(1);
    fleet_ticks(10);
    TEST_ASSERT_EQUAL_UINT16(0, server_formation(server));
    fleet_poses[1].x = 5;
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT16(1, server_formation(server));
    fleet_ticks(10);
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_EVENT, 0, EVENT_FORMATION));
}

static bool sees_time_and_pose(const void *condition, const struct event_view *view)
{
    (void)condition;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, server_time(server) / 1000.0, view->t);
    TEST_ASSERT_DOUBLE_WITHIN(0, fleet_poses[1].x, view->x);
    TEST_ASSERT_DOUBLE_WITHIN(0, fleet_poses[1].y, view->y);
    TEST_ASSERT_DOUBLE_WITHIN(0, fleet_poses[1].theta, view->theta);
    return view->t > 1;
}

static void test_a_condition_sees_mission_time_and_the_leaders_pose(void)
{
    struct event event = {.action = EVENT_ESTOP, .when = sees_time_and_pose};

    given(1, &event);
    fleet_start();
    fleet_poses[1] = (struct server_pose){1.25, -7, 0.5, true, 0};
    elect(1);
    fleet_until(2000);
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_EVENT, 0, EVENT_ESTOP));
}

static void test_a_formation_reaches_every_robot(void)
{
    struct event event = {.action = EVENT_FORMATION, .at_tick = AT_TICK, .formation = 1};

    given(1, &event);
    fleet_start();
    fleet_until(AT_MS - TICK_MS);
    TEST_ASSERT_EQUAL_UINT16(0, server_formation(server));
    uint8_t before = fleet[3].mission.formation.number;
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT16(1, server_formation(server));
    for (size_t i = 0; i < 4; i++) {
        TEST_ASSERT_EQUAL_UINT16(3, fleet[i].mission.formation.total);
        TEST_ASSERT_EQUAL_UINT16(3, fleet[i].mission.formation.leader);
        TEST_ASSERT_TRUE(fleet[i].mission.formation.number != before);
    }
}

/* Formations have numbers from 1 to 255 on the wire. */
static void test_300_formations_in_300_ticks(void)
{
    struct event events[300];

    for (uint16_t i = 0; i < 300; i++)
        events[i] = (struct event){.action = EVENT_FORMATION, .at_tick = i, .formation = i % 2};
    given(300, events);
    fleet_start();
    for (uint16_t i = 0; i < 300; i++) {
        TEST_ASSERT_EQUAL_UINT16(i % 2, server_formation(server));
        TEST_ASSERT_EQUAL_UINT16(i % 2 ? 3 : 4, fleet[2].mission.formation.total);
        TEST_ASSERT_TRUE(fleet[2].mission.formation.number != 0);
        fleet_tick();
    }
}

static void test_muted_beacons_are_lost_both_ways_and_poses_are_not(void)
{
    struct event events[] = {{.action = EVENT_MUTE, .robot = 20},
                             {.action = EVENT_UNMUTE, .at_tick = AT_TICK, .robot = 20}};

    given(2, events);
    fleet_start();
    TEST_ASSERT_FALSE(passes(1, 0));
    TEST_ASSERT_FALSE(passes(0, 1));
    TEST_ASSERT_TRUE(passes(2, 3));
    TEST_ASSERT_EQUAL_UINT(1, fleet[1].poses);
    fleet_until(AT_MS);
    TEST_ASSERT_TRUE(passes(1, 0));
    TEST_ASSERT_TRUE(passes(0, 1));
}

static void test_beacons_pass_within_a_part_until_it_is_healed(void)
{
    static const uint16_t groups[] = {1, 1, 2, 2};
    struct event events[] = {{.action = EVENT_PARTITION, .groups = groups},
                             {.action = EVENT_HEAL, .at_tick = AT_TICK}};

    given(2, events);
    fleet_start();
    TEST_ASSERT_TRUE(passes(0, 1));
    TEST_ASSERT_FALSE(passes(1, 2));
    TEST_ASSERT_FALSE(passes(2, 1));
    TEST_ASSERT_TRUE(passes(3, 2));
    fleet_until(AT_MS);
    TEST_ASSERT_TRUE(passes(1, 2));
}

static void test_loss_takes_effect(void)
{
    struct event events[] = {{.action = EVENT_LOSS, .value = 1},
                             {.action = EVENT_LOSS, .at_tick = AT_TICK, .value = 0}};

    given(2, events);
    fleet_start();
    TEST_ASSERT_FALSE(passes(0, 1));
    TEST_ASSERT_EQUAL_UINT(1, fleet[1].poses);
    fleet_until(AT_MS);
    TEST_ASSERT_TRUE(passes(0, 1));
}

static void test_range_takes_effect(void)
{
    struct event event = {.action = EVENT_RANGE, .at_tick = AT_TICK, .value = 2};

    given(1, &event);
    fleet_start();
    TEST_ASSERT_FALSE(passes(0, 2));
    fleet_until(AT_MS);
    TEST_ASSERT_TRUE(passes(0, 2));
    TEST_ASSERT_FALSE(passes(0, 3));
}

static void test_delay_takes_effect(void)
{
    struct event event = {.action = EVENT_DELAY, .at_tick = AT_TICK, .value = 0.1};

    given(1, &event);
    fleet_start();
    TEST_ASSERT_TRUE(passes(0, 1));
    fleet_until(AT_MS);
    TEST_ASSERT_FALSE(passes(0, 1));
    fleet_ticks(4);
    TEST_ASSERT_FALSE(fleet_hears(1, 0));
    fleet_tick();
    TEST_ASSERT_TRUE(fleet_hears(1, 0));
}

/* 5 s at 20 Hz from every robot, all in the air at once. */
static void test_a_long_delay_finds_room_for_every_beacon(void)
{
    struct event event = {.action = EVENT_DELAY, .value = 5};

    given(1, &event);
    fleet_start();
    for (unsigned tick = 0; tick < 250; tick++) {
        for (size_t i = 0; i < 4 && tick % 2 == 0; i++)
            fleet_beacon(i, ROLE_FOLLOWER, (uint16_t)tick);
        fleet_tick();
        TEST_ASSERT_EQUAL_UINT(0, fleet[1].beacons);
    }
    for (unsigned tick = 0; tick < 250; tick++) {
        fleet_tick();
        if (tick % 2 == 0) {
            TEST_ASSERT_TRUE(fleet_hears(1, 0));
            TEST_ASSERT_EQUAL_UINT16(tick, fleet[1].beacon[0].term);
        }
    }
    TEST_ASSERT_EQUAL_UINT64(0, server_count(server).dropped);
}

/* ---- told to ----------------------------------------------------------------------------- */

static void test_what_is_told_to_happen_happens_now(void)
{
    struct event kill = {.action = EVENT_KILL, .at_tick = 1000000, .robot = 30};

    fleet_start();
    TEST_ASSERT_TRUE(server_act(server, &kill));
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_KILL, 2));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_EVENT, 30, EVENT_KILL));
}

static void test_what_names_nobody_is_not_done(void)
{
    fleet_start();
    TEST_ASSERT_FALSE(server_act(server, &(struct event){.action = EVENT_KILL, .robot = 77}));
    TEST_ASSERT_FALSE(server_act(server, &(struct event){.action = EVENT_MUTE, .robot = 0}));
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(0, fleet_reported(REPORT_EVENT, 0, EVENT_KILL));
    TEST_ASSERT_EQUAL_UINT(0, fleet_reported(REPORT_EVENT, 0, EVENT_MUTE));
    elect(1);
    fleet_tick();
    TEST_ASSERT_TRUE(server_act(server, &(struct event){.action = EVENT_MUTE, .robot = 0}));
    TEST_ASSERT_TRUE(server_station(server, 1).muted);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_event_happens_at_its_tick_and_once);
    RUN_TEST(test_an_event_at_0_does_not_wait_nor_hurry);
    RUN_TEST(test_power_and_wheels_are_orders_for_the_robot_named);
    RUN_TEST(test_the_leaders_death_waits_for_a_leader);
    RUN_TEST(test_the_leaders_empty_battery_waits_for_a_leader);
    RUN_TEST(test_a_condition_is_about_the_leader_and_holds_once);
    RUN_TEST(test_a_condition_sees_mission_time_and_the_leaders_pose);
    RUN_TEST(test_a_formation_reaches_every_robot);
    RUN_TEST(test_300_formations_in_300_ticks);
    RUN_TEST(test_muted_beacons_are_lost_both_ways_and_poses_are_not);
    RUN_TEST(test_beacons_pass_within_a_part_until_it_is_healed);
    RUN_TEST(test_loss_takes_effect);
    RUN_TEST(test_range_takes_effect);
    RUN_TEST(test_delay_takes_effect);
    RUN_TEST(test_a_long_delay_finds_room_for_every_beacon);
    RUN_TEST(test_what_is_told_to_happen_happens_now);
    RUN_TEST(test_what_names_nobody_is_not_done);
    return UNITY_END();
}
