#include "fake_fleet.h"

#include <unity.h>

#define VERTICES 4

static struct polar_vertex vertices[VERTICES];

void setUp(void)
{
    fleet_reset(4);
}

void tearDown(void)
{
    fleet_free();
}

/* One whose vertices tell by their distances which one it is; the leader's is its last. */
static uint16_t draw(uint16_t count, int32_t distance)
{
    struct server_formation formation = {count, 0, vertices};

    for (uint16_t i = 0; i < count; i++)
        vertices[i] = (struct polar_vertex){i + 1 == count ? 0 : distance + i, 0};
    return server_draw(server, &formation);
}

static void assert_holds(size_t robot, uint16_t count, int32_t distance)
{
    const struct formation *formation = &fleet[robot].mission.formation;

    TEST_ASSERT_TRUE(formation->number != 0);
    TEST_ASSERT_EQUAL_UINT16(count, formation->total);
    TEST_ASSERT_EQUAL_UINT16(count, formation->leader);
    for (uint16_t i = 0; i + 1 < count; i++)
        TEST_ASSERT_INT16_WITHIN(1, distance + i, formation->vertex[i].x);
}

static void test_a_drawn_formation_takes_effect_at_once(void)
{
    fleet_start();
    uint16_t index = draw(3, 1000);
    TEST_ASSERT_EQUAL_UINT16(2, index); /* the configuration has two */
    TEST_ASSERT_EQUAL_UINT16(index, server_formation(server));
    fleet_ticks(2);
    TEST_ASSERT_EQUAL_UINT(1, fleet_reported(REPORT_EVENT, 0, EVENT_FORMATION));
    for (size_t i = 0; i < 4; i++)
        assert_holds(i, 3, 1000);
}

static void test_who_comes_later_is_given_it_too(void)
{
    fleet_start();
    draw(3, 1000);
    fleet_ticks(10);
    fleet_reset_robot(2);
    fleet_status(2);
    fleet_ticks(10);
    assert_holds(2, 3, 1000);
}

static void test_it_can_be_taken_again_as_any_other(void)
{
    struct event first = {.action = EVENT_FORMATION, .formation = 0};
    struct event drawn = {.action = EVENT_FORMATION, .formation = 2};

    fleet_start();
    draw(3, 1000);
    fleet_ticks(2);
    TEST_ASSERT_TRUE(server_act(server, &first));
    fleet_ticks(2);
    TEST_ASSERT_EQUAL_UINT16(4, fleet[1].mission.formation.total);
    TEST_ASSERT_TRUE(server_act(server, &drawn));
    fleet_ticks(2);
    assert_holds(1, 3, 1000);
}

static void test_the_one_in_force_never_gives_way(void)
{
    bool seen[2 + SERVER_DRAWN_MAX] = {false};

    fleet_start();
    for (int i = 0; i < SERVER_DRAWN_MAX; i++) {
        uint16_t index = draw(3, 1000 + 10 * i);

        TEST_ASSERT_TRUE(index >= 2 && index < 2 + SERVER_DRAWN_MAX);
        TEST_ASSERT_FALSE(seen[index]);
        seen[index] = true;
    }
    /* Back to what is the next place's. */
    uint16_t kept = 2;
    TEST_ASSERT_TRUE(
        server_act(server, &(struct event){.action = EVENT_FORMATION, .formation = kept}));
    for (int i = 0; i < 3 * SERVER_DRAWN_MAX; i++) {
        uint16_t before = server_formation(server);

        TEST_ASSERT_TRUE(draw(3, 2000) != before);
    }
}

/* It has the first part of nothing: it takes no order until its place is another one's. */
static void test_a_robot_that_is_still_told_of_one_that_gave_way_is_told_anew(void)
{
    fleet_start();
    fleet_ticks(2);
    unsigned missions = fleet[3].missions;
    fleet[3].deaf = true;
    for (int i = 0; i < 2 * SERVER_DRAWN_MAX; i++) {
        draw((uint16_t)(i % 2 ? 2 : 4), 1000 + 10 * i);
        fleet_ticks(2);
    }
    TEST_ASSERT_EQUAL_UINT(missions, fleet[3].missions);
    fleet[3].deaf = false;
    fleet_ticks(40);
    TEST_ASSERT_EQUAL_UINT(missions + 1, fleet[3].missions);
    TEST_ASSERT_FALSE(fleet[3].mission.refused);
    assert_holds(3, 2, 1000 + 10 * (2 * SERVER_DRAWN_MAX - 1));
    assert_holds(0, 2, 1000 + 10 * (2 * SERVER_DRAWN_MAX - 1));
    TEST_ASSERT_TRUE(server_waits_for(server) == SERVER_NOBODY);
}

static void test_robots_that_keep_up_keep_their_mission(void)
{
    fleet_start();
    fleet_ticks(2);
    unsigned missions = fleet[0].missions;
    for (int i = 0; i < 600; i++) {
        draw((uint16_t)(2 + i % 3), 1000 + i);
        fleet_ticks(2);
        assert_holds(0, (uint16_t)(2 + i % 3), 1000 + i);
    }
    TEST_ASSERT_EQUAL_UINT(missions, fleet[0].missions);
}

static void test_the_host_gives_out_its_vertices(void)
{
    fleet_config.allocation = SERVER_OPTIMAL;
    fleet_start();
    fleet_beacon(0, ROLE_LEADER, 1);
    fleet_ticks(2);
    draw(2, 1000);
    fleet_ticks(10);
    unsigned assigned = 0;
    for (size_t i = 1; i < 4; i++)
        assigned += fleet[i].mission.assigned == 1;
    TEST_ASSERT_EQUAL_UINT16(2, fleet[0].mission.assigned);
    TEST_ASSERT_EQUAL_UINT(1, assigned);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_drawn_formation_takes_effect_at_once);
    RUN_TEST(test_who_comes_later_is_given_it_too);
    RUN_TEST(test_it_can_be_taken_again_as_any_other);
    RUN_TEST(test_the_one_in_force_never_gives_way);
    RUN_TEST(test_a_robot_that_is_still_told_of_one_that_gave_way_is_told_anew);
    RUN_TEST(test_robots_that_keep_up_keep_their_mission);
    RUN_TEST(test_the_host_gives_out_its_vertices);
    return UNITY_END();
}
