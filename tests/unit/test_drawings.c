#include "drawings.h"

#include "fake_fleet.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

static double own_L[] = {0, 1, 2, 3}, own_psi[4];
static struct scenario_formation own[] = {
    {.name = "four", .count = 4, .L = own_L, .psi = own_psi},
    {.name = "three", .count = 3, .L = own_L, .psi = own_psi},
};
static const struct scenario scenario = {.robot_count = 4, .formation_count = 2, .formations = own};

static struct drawings *drawings;
static char words[FORMATION_WORDS_MAX];

/* What is drawn next. */
static double L[200], psi[200];
static char name[64];
static struct scenario_formation next;

void setUp(void)
{
    fleet_reset(4);
    fleet_start();
    drawings = drawings_new(&scenario);
    TEST_ASSERT_NOT_NULL(drawings);
    next = (struct scenario_formation){.name = name, .count = 3, .L = L, .psi = psi};
    strcpy(name, "wedge");
    L[0] = 0;
    L[1] = L[2] = 1.5;
    psi[0] = 0;
    psi[1] = M_PI / 4;
    psi[2] = -M_PI / 4;
    words[0] = '\0';
}

void tearDown(void)
{
    drawings_free(drawings);
    fleet_free();
}

static bool draw(void)
{
    return drawings_draw(drawings, server, &next, words);
}

static void assert_refused(const char *expected)
{
    uint16_t before = server_formation(server);

    TEST_ASSERT_FALSE(draw());
    TEST_ASSERT_EQUAL_STRING(expected, words);
    TEST_ASSERT_EQUAL_UINT16(before, server_formation(server));
    TEST_ASSERT_EQUAL_UINT(0, fleet_reported(REPORT_EVENT, 0, EVENT_FORMATION));
}

static void test_what_is_drawn_is_in_force_and_can_be_looked_at(void)
{
    TEST_ASSERT_TRUE_MESSAGE(draw(), words);
    L[1] = 77; /* it is a copy */
    const struct scenario_formation *now = drawings_look(drawings, server_formation(server));
    TEST_ASSERT_EQUAL_STRING("wedge", now->name);
    TEST_ASSERT_EQUAL_UINT64(3, now->count);
    TEST_ASSERT_EQUAL_DOUBLE(1.5, now->L[1]);
    TEST_ASSERT_EQUAL_DOUBLE(-M_PI / 4, now->psi[2]);
    fleet_ticks(2);
    TEST_ASSERT_EQUAL_UINT16(3, fleet[1].mission.formation.total);
    TEST_ASSERT_EQUAL_UINT16(1, fleet[1].mission.formation.leader);
    TEST_ASSERT_INT16_WITHIN(2, (int)(1.5 * M_SQRT1_2 * NARROW_PER_M),
                             fleet[1].mission.formation.vertex[1].y);
}

static void test_the_scenarios_own_are_there(void)
{
    TEST_ASSERT_EQUAL_PTR(&own[1], drawings_look(drawings, 1));
}

static void test_all_are_found_by_name(void)
{
    const char *names[8];
    uint16_t index = 77;

    draw();
    TEST_ASSERT_TRUE(drawings_find(drawings, "three", &index));
    TEST_ASSERT_EQUAL_UINT16(1, index);
    TEST_ASSERT_TRUE(drawings_find(drawings, "wedge", &index));
    TEST_ASSERT_EQUAL_UINT16(server_formation(server), index);
    TEST_ASSERT_FALSE(drawings_find(drawings, "row", &index));
    TEST_ASSERT_EQUAL_UINT64(3, drawings_names(drawings, names, 8));
    TEST_ASSERT_EQUAL_STRING("four", names[0]);
    TEST_ASSERT_EQUAL_STRING("three", names[1]);
    TEST_ASSERT_EQUAL_STRING("wedge", names[2]);
    TEST_ASSERT_EQUAL_UINT64(2, drawings_names(drawings, names, 2));
}

static void test_the_same_name_again_replaces_it(void)
{
    const char *names[8];

    draw();
    next.count = 2;
    L[1] = 3;
    TEST_ASSERT_TRUE(draw());
    TEST_ASSERT_EQUAL_UINT64(3, drawings_names(drawings, names, 8));
    TEST_ASSERT_EQUAL_UINT64(2, drawings_look(drawings, server_formation(server))->count);
    fleet_ticks(2);
    TEST_ASSERT_EQUAL_UINT16(2, fleet[1].mission.formation.total);
}

static void test_of_many_the_oldest_gives_way(void)
{
    const char *names[2 + SERVER_DRAWN_MAX];
    uint16_t index;

    for (int i = 0; i <= SERVER_DRAWN_MAX; i++) {
        snprintf(name, sizeof name, "drawn-%d", i);
        TEST_ASSERT_TRUE(draw());
        fleet_tick();
    }
    TEST_ASSERT_FALSE(drawings_find(drawings, "drawn-0", &index));
    TEST_ASSERT_TRUE(drawings_find(drawings, "drawn-1", &index));
    TEST_ASSERT_EQUAL_UINT64(2 + SERVER_DRAWN_MAX,
                             drawings_names(drawings, names, 2 + SERVER_DRAWN_MAX));
}

static void test_the_scenarios_names_are_its_own(void)
{
    strcpy(name, "three");
    assert_refused("the scenario has a formation three; any other name is allowed");
}

static void test_the_rules_are_those_of_a_scenario(void)
{
    next.count = 0;
    assert_refused("no vertex; the leader's at least is needed");
    next.count = 5;
    assert_refused("more vertices than robots: 5 for 4; as many or fewer are allowed");
    next.count = 3;
    L[0] = 1;
    psi[0] = 1;
    assert_refused("no vertex has L = 0; exactly one, the leader's, does");
    L[0] = L[2] = 0;
    assert_refused("vertices 1 and 3 both have L = 0; one, the leader's, is allowed");
    L[2] = L[1];
    psi[2] = psi[1] + 0.005 / 1.5;
    assert_refused("vertices 2 and 3 of wedge are in one place; more than 10 mm apart is allowed");
}

static void test_numbers_are_within_a_scenarios_range(void)
{
    L[1] = 2000.5;
    assert_refused("vertex 2: L is 2000.5 m and psi 0.785398 rad; within 2000 m and 10000 rad is "
                   "allowed");
    L[1] = NAN;
    TEST_ASSERT_FALSE(draw());
    L[1] = -2000;
    psi[1] = -INFINITY;
    TEST_ASSERT_FALSE(draw());
    psi[1] = 10000;
    TEST_ASSERT_TRUE_MESSAGE(draw(), words);
}

static void test_any_robot_can_hold_it(void)
{
    struct scenario large = scenario;

    large.robot_count = 200;
    drawings_free(drawings);
    drawings = drawings_new(&large);
    for (size_t i = 0; i < 129; i++) {
        L[i] = (double)i;
        psi[i] = 0;
    }
    next.count = 129;
    assert_refused("129 vertices; the robots have room for 128");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_drawn_is_in_force_and_can_be_looked_at);
    RUN_TEST(test_the_scenarios_own_are_there);
    RUN_TEST(test_all_are_found_by_name);
    RUN_TEST(test_the_same_name_again_replaces_it);
    RUN_TEST(test_of_many_the_oldest_gives_way);
    RUN_TEST(test_the_scenarios_names_are_its_own);
    RUN_TEST(test_the_rules_are_those_of_a_scenario);
    RUN_TEST(test_numbers_are_within_a_scenarios_range);
    RUN_TEST(test_any_robot_can_hold_it);
    return UNITY_END();
}
