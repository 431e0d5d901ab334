#include "allocation.h"

#include <string.h>
#include <unity.h>

#define SCALE 0

static struct formation formation;
static struct neighbours neighbours;
static struct allocation_state state;
static struct allocation_view view;

/* In these tests everyone stands in the leader's frame already. */
static int8_t compare(const void *context, const struct neighbour *neighbour, uint16_t vertex)
{
    struct vec32 place = {formation.vertex[vertex - 1].x, formation.vertex[vertex - 1].y};
    struct vec32 own = {view.at.x, view.at.y};

    (void)context;
    return vec_compare(vec_sub(neighbour->pose.at, place), vec_sub(own, place));
}

/* Vertex 1 is the leader's; 2, 3, 4 lie on the x axis at 1,000, 2,000 and 3,000 of the pass. */
void setUp(void)
{
    memset(&formation, 0, sizeof formation);
    formation.number = 1;
    formation.total = 4;
    formation.leader = 1;
    for (int i = 1; i < 4; i++)
        formation.vertex[i].x = (int16_t)(1000 * i);
    neighbours.count = 0;
    view = (struct allocation_view){
        .formation = &formation,
        .scale = SCALE,
        .id = 10,
        .leader = 1,
        .neighbours = &neighbours,
        .compare = compare,
    };
    allocation_begin(&state);
    allocation_under(&state, 1, 1);
}

void tearDown(void)
{
}

static void stand(int16_t x)
{
    view.at.x = x;
}

static void meet(uint16_t id, int16_t x, uint16_t vertex)
{
    neighbours.entry[neighbours.count++] = (struct neighbour){
        .id = id, .pose = {{x, 0}, 0}, .role = ROLE_FOLLOWER, .formation = 1, .vertex = vertex};
}

static uint16_t pass(void)
{
    allocation_pass(&state, &view);
    return state.held;
}

static void test_alone_it_takes_the_closest(void)
{
    stand(1400);
    TEST_ASSERT_EQUAL(2, pass());
    stand(1600);
    TEST_ASSERT_EQUAL(3, pass());
    stand(-16000);
    TEST_ASSERT_EQUAL(2, pass());
}

static void test_never_the_leaders_vertex(void)
{
    stand(0);
    TEST_ASSERT_EQUAL(2, pass());
}

static void test_it_yields_to_a_closer_robot_that_holds_the_same(void)
{
    stand(1400);
    meet(20, 1300, 2);
    TEST_ASSERT_EQUAL(3, pass());
}

static void test_it_keeps_its_vertex_against_a_farther_one(void)
{
    stand(1400);
    meet(20, 1500, 2);
    TEST_ASSERT_EQUAL(2, pass());
}

static void test_a_tie_goes_to_the_smaller_id(void)
{
    stand(1400);
    meet(20, 600, 2);
    TEST_ASSERT_EQUAL(2, pass());
    neighbours.entry[0].id = 9;
    TEST_ASSERT_EQUAL(3, pass());
}

static void test_a_closer_robot_that_holds_another_is_no_rival(void)
{
    stand(1400);
    meet(20, 1000, 3);
    TEST_ASSERT_EQUAL(2, pass());
    view.literal = true;
    TEST_ASSERT_EQUAL(3, pass());
}

static void test_neither_the_leader_nor_a_robot_of_another_formation_is_a_rival(void)
{
    stand(1400);
    meet(20, 1000, 2);
    neighbours.entry[0].formation = 2;
    TEST_ASSERT_EQUAL(2, pass());
    neighbours.entry[0].formation = 1;
    neighbours.entry[0].role = ROLE_LEADER;
    TEST_ASSERT_EQUAL(2, pass());
    neighbours.entry[0].role = ROLE_FOLLOWER;
    view.leader = 20;
    TEST_ASSERT_EQUAL(2, pass());
}

static void test_the_taboo_list_lives_on(void)
{
    stand(1400);
    meet(20, 1000, 2);
    TEST_ASSERT_EQUAL(3, pass());
    neighbours.count = 0;
    TEST_ASSERT_EQUAL(3, pass());
}

static void test_a_new_leader_or_formation_clears_it(void)
{
    stand(1400);
    meet(20, 1000, 2);
    pass();
    neighbours.count = 0;
    allocation_under(&state, 1, 1);
    TEST_ASSERT_EQUAL(3, pass());
    allocation_under(&state, 2, 1);
    TEST_ASSERT_EQUAL(2, pass());

    meet(20, 1000, 2);
    pass();
    neighbours.count = 0;
    formation.number = 2;
    allocation_under(&state, 2, 2);
    TEST_ASSERT_EQUAL(0, state.held);
    TEST_ASSERT_EQUAL(2, pass());
}

static void test_with_every_vertex_marked_it_starts_anew(void)
{
    stand(1400);
    meet(20, 1000, 2);
    meet(21, 2000, 3);
    TEST_ASSERT_EQUAL(4, pass());
    meet(22, 3000, 4);
    neighbours.entry[0].vertex = 0;
    TEST_ASSERT_EQUAL(2, pass());
}

static void test_with_every_vertex_lost_it_holds_none(void)
{
    stand(1400);
    meet(20, 1000, 2);
    meet(21, 2000, 3);
    meet(22, 3000, 4);
    TEST_ASSERT_EQUAL(0, pass());
    TEST_ASSERT_EQUAL(0, pass());
    neighbours.count = 2;
    TEST_ASSERT_EQUAL(4, pass());
}

static void test_a_long_pass_goes_on_in_the_next_tick(void)
{
    enum { MANY = 3 * ALLOCATION_TRIES };

    formation.total = MANY + 2;
    for (uint16_t i = 1; i <= MANY + 1; i++)
        formation.vertex[i].x = (int16_t)(100 * i);
    stand(200);
    TEST_ASSERT_EQUAL(3, pass());
    for (uint16_t i = 1; i <= MANY; i++)
        meet(20 + i, (int16_t)(100 * i), i + 1);
    stand(90);
    for (int part = 1; part <= 3; part++) {
        TEST_ASSERT_EQUAL(3, pass());
        TEST_ASSERT_NOT_EQUAL(0, state.tried);
    }
    TEST_ASSERT_EQUAL(MANY + 2, pass());
    TEST_ASSERT_EQUAL(0, state.tried);
    meet(99, 100 * (MANY + 1), MANY + 2);
    for (int part = 1; part <= 3; part++)
        pass();
    TEST_ASSERT_EQUAL(0, pass());
}

static void test_coarser_passes_choose_alike(void)
{
    for (view.scale = SCALE; view.scale < SCALE + 6; view.scale++) {
        stand((int16_t)(1400 >> view.scale));
        TEST_ASSERT_EQUAL(2, pass());
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_alone_it_takes_the_closest);
    RUN_TEST(test_never_the_leaders_vertex);
    RUN_TEST(test_it_yields_to_a_closer_robot_that_holds_the_same);
    RUN_TEST(test_it_keeps_its_vertex_against_a_farther_one);
    RUN_TEST(test_a_tie_goes_to_the_smaller_id);
    RUN_TEST(test_a_closer_robot_that_holds_another_is_no_rival);
    RUN_TEST(test_neither_the_leader_nor_a_robot_of_another_formation_is_a_rival);
    RUN_TEST(test_the_taboo_list_lives_on);
    RUN_TEST(test_a_new_leader_or_formation_clears_it);
    RUN_TEST(test_with_every_vertex_marked_it_starts_anew);
    RUN_TEST(test_with_every_vertex_lost_it_holds_none);
    RUN_TEST(test_a_long_pass_goes_on_in_the_next_tick);
    RUN_TEST(test_coarser_passes_choose_alike);
    return UNITY_END();
}
