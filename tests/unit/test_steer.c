#include "steer.h"

#include "fake_fleet.h"

#include <stdio.h>
#include <string.h>
#include <unity.h>

static double L[] = {0, 1, 2, 3}, psi[4];
static struct scenario_formation own[] = {
    {.name = "four", .count = 4, .L = L, .psi = psi},
    {.name = "three", .count = 3, .L = L, .psi = psi},
};
static struct scenario_robot robots[20];
static struct scenario scenario;
static struct steer fleet_steer;
static char words[STEER_WORDS_MAX];

static void given_robots(size_t count, uint16_t first, uint16_t apart)
{
    scenario.robot_count = count;
    for (size_t i = 0; i < count; i++)
        robots[i].id = (uint16_t)(first + i * apart);
}

void setUp(void)
{
    scenario = (struct scenario){.robots = robots, .formation_count = 2, .formations = own};
    given_robots(4, 10, 10);
    fleet_reset(4);
    fleet_start();
    fleet_steer = (struct steer){&scenario, server, drawings_new(&scenario)};
    TEST_ASSERT_NOT_NULL(fleet_steer.drawings);
    words[0] = '\0';
}

void tearDown(void)
{
    drawings_free(fleet_steer.drawings);
    fleet_free();
}

static enum steer_end ask(enum act_kind kind, uint16_t robot, const char *name)
{
    struct act act = {.kind = kind, .robot = robot};

    snprintf(act.name, sizeof act.name, "%s", name);
    enum steer_end end = steer(&fleet_steer, &act, words);
    fleet_tick();
    return end;
}

static void assert_done_to_robot(enum act_kind kind, enum event_action action)
{
    TEST_ASSERT_EQUAL_INT(STEER_DONE, ask(kind, 30, ""));
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_EVENT, 30, action));
}

static void test_acts_on_a_robot_are_those_of_a_scenario(void)
{
    assert_done_to_robot(ACT_KILL, EVENT_KILL);
    assert_done_to_robot(ACT_REVIVE, EVENT_REVIVE);
    assert_done_to_robot(ACT_STALL, EVENT_STALL);
    assert_done_to_robot(ACT_DRAIN, EVENT_DRAIN);
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_KILL, 2));
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_REVIVE, 2));
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_STALL, 2));
    TEST_ASSERT_EQUAL_UINT(1, fleet_ordered(EVENT_DRAIN, 2));
}

static void test_a_robot_is_muted_and_heard_again(void)
{
    assert_done_to_robot(ACT_MUTE, EVENT_MUTE);
    TEST_ASSERT_TRUE(server_station(server, 2).muted);
    assert_done_to_robot(ACT_UNMUTE, EVENT_UNMUTE);
    TEST_ASSERT_FALSE(server_station(server, 2).muted);
}

static void test_a_robot_that_there_is_not_is_refused(void)
{
    TEST_ASSERT_EQUAL_INT(STEER_REFUSED, ask(ACT_KILL, 31, ""));
    TEST_ASSERT_EQUAL_STRING("robot 31 is not in this scenario: it has 10, 20, 30, 40", words);
    for (size_t i = 0; i < 4; i++)
        TEST_ASSERT_EQUAL_UINT(0, fleet_ordered(EVENT_KILL, i));
}

/* 0 stands for the leader in a scenario. */
static void test_nobody_is_no_robot(void)
{
    fleet_beacon(0, ROLE_LEADER, 1);
    fleet_tick();
    TEST_ASSERT_EQUAL_INT(STEER_REFUSED, ask(ACT_KILL, 0, ""));
    TEST_ASSERT_EQUAL_UINT(0, fleet_ordered(EVENT_KILL, 0));
}

static void test_the_robots_there_are_are_named_in_short(void)
{
    given_robots(4, 1, 1);
    TEST_ASSERT_TRUE(steer_robot(&scenario, 7, words) == SERVER_NOBODY);
    TEST_ASSERT_EQUAL_STRING("robot 7 is not in this scenario: it has 1 to 4", words);
    given_robots(1, 3, 1);
    TEST_ASSERT_TRUE(steer_robot(&scenario, 7, words) == SERVER_NOBODY);
    TEST_ASSERT_EQUAL_STRING("robot 7 is not in this scenario: it has 3", words);
    given_robots(20, 60000, 2);
    TEST_ASSERT_TRUE(steer_robot(&scenario, 7, words) == SERVER_NOBODY);
    TEST_ASSERT_EQUAL_STRING("robot 7 is not in this scenario: it has 60000, 60002, 60004, 60006, "
                             "60008, 60010, 60012, 60014 and 12 more",
                             words);
    TEST_ASSERT_EQUAL_UINT64(19, steer_robot(&scenario, 60038, words));
}

static void test_a_formation_is_taken_by_name(void)
{
    TEST_ASSERT_EQUAL_INT(STEER_DONE, ask(ACT_FORMATION, 0, "three"));
    TEST_ASSERT_EQUAL_UINT16(1, server_formation(server));
    TEST_ASSERT_EQUAL_INT(STEER_REFUSED, ask(ACT_FORMATION, 0, "two"));
    TEST_ASSERT_EQUAL_STRING("no formation is called 'two'", words);
    TEST_ASSERT_EQUAL_UINT16(1, server_formation(server));
}

static void test_a_formation_is_drawn_and_taken_by_its_name(void)
{
    struct act act = {.kind = ACT_DRAW, .name = "pair", .count = 2, .L = {0, 1.5}, .psi = {0, 0.5}};

    TEST_ASSERT_EQUAL_INT(STEER_DONE, steer(&fleet_steer, &act, words));
    uint16_t drawn = server_formation(server);
    TEST_ASSERT_EQUAL_UINT16(2, drawn);
    TEST_ASSERT_EQUAL_INT(STEER_DONE, ask(ACT_FORMATION, 0, "four"));
    TEST_ASSERT_EQUAL_UINT16(0, server_formation(server));
    TEST_ASSERT_EQUAL_INT(STEER_DONE, ask(ACT_FORMATION, 0, "pair"));
    TEST_ASSERT_EQUAL_UINT16(drawn, server_formation(server));
    act.L[1] = 0;
    TEST_ASSERT_EQUAL_INT(STEER_REFUSED, steer(&fleet_steer, &act, words));
    TEST_ASSERT_EQUAL_STRING("vertices 1 and 2 both have L = 0; one, the leader's, is allowed",
                             words);
}

static void test_an_emergency_stop_is_for_all(void)
{
    fleet_tick();
    TEST_ASSERT_EQUAL_INT(STEER_DONE, steer(&fleet_steer, &(struct act){.kind = ACT_ESTOP}, words));
    TEST_ASSERT_TRUE(server_estopped(server));
    for (size_t i = 0; i < 4; i++) {
        fleet_listen(i);
        TEST_ASSERT_EQUAL_UINT(1, fleet[i].estops);
    }
    fleet_tick();
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_EVENT, 0, EVENT_ESTOP));
}

static void test_the_rest_is_for_whoever_runs_the_fleet(void)
{
    static const enum act_kind kinds[] = {ACT_MOVE,   ACT_BEGIN, ACT_END,  ACT_PAUSE,
                                          ACT_RESUME, ACT_STEP,  ACT_SPEED};

    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        TEST_ASSERT_EQUAL_INT(STEER_OTHER, ask(kinds[i], 10, ""));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_acts_on_a_robot_are_those_of_a_scenario);
    RUN_TEST(test_a_robot_is_muted_and_heard_again);
    RUN_TEST(test_a_robot_that_there_is_not_is_refused);
    RUN_TEST(test_nobody_is_no_robot);
    RUN_TEST(test_the_robots_there_are_are_named_in_short);
    RUN_TEST(test_a_formation_is_taken_by_name);
    RUN_TEST(test_a_formation_is_drawn_and_taken_by_its_name);
    RUN_TEST(test_an_emergency_stop_is_for_all);
    RUN_TEST(test_the_rest_is_for_whoever_runs_the_fleet);
    return UNITY_END();
}
