#include "allocation.h"
#include "random.h"

#include <string.h>
#include <unity.h>

static struct formation formation;
static struct neighbours neighbours;
static struct allocation_state state;
static struct allocation_view view;

/* Vertex 1 is the leader's; 2, 3, 4 lie on the x axis at 1,000, 2,000 and 3,000. The leader
 * stands at the origin and looks along the axis. */
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
        .neighbours = &neighbours,
        .id = 10,
        .leader = 1,
        .heading = sincos_of(0),
    };
    allocation_begin(&state);
    allocation_under(&state, 1, 1);
}

void tearDown(void)
{
}

static void stand(int16_t x)
{
    view.own = (struct vec32){x, 0};
}

static void meet(uint16_t id, int16_t x, uint16_t vertex)
{
    neighbours.entry[neighbours.count++] = (struct neighbour){
        .id = id, .pose = {{x, 0}, 0}, .role = ROLE_FOLLOWER, .formation = 1, .vertex = vertex};
}

static uint16_t pass(void)
{
    do
        allocation_pass(&state, &view);
    while (state.unfinished);
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

/* The list is cleared in one tick and gone through again in the next. */
static void test_a_pass_that_starts_anew_goes_on_in_the_next_tick(void)
{
    stand(1400);
    meet(20, 1000, 2);
    meet(21, 2000, 3);
    TEST_ASSERT_EQUAL(4, pass());
    meet(22, 3000, 4);
    allocation_pass(&state, &view);
    TEST_ASSERT_TRUE(state.unfinished);
    TEST_ASSERT_EQUAL(4, state.held);
    allocation_pass(&state, &view);
    TEST_ASSERT_FALSE(state.unfinished);
    TEST_ASSERT_EQUAL(0, state.held);
}

static void test_coarser_passes_choose_alike(void)
{
    for (uint8_t scale = 0; scale <= FORMATION_SCALE_MAX; scale++) {
        int32_t unit = (int32_t)1 << scale;

        formation.scale = scale;
        allocation_begin(&state);
        allocation_under(&state, 1, 1);
        neighbours.count = 0;
        view.own = (struct vec32){1400 * unit, 0};
        TEST_ASSERT_EQUAL(2, pass());
        meet(20, 0, 2);
        neighbours.entry[0].pose.at.x = 1100 * unit;
        TEST_ASSERT_EQUAL(3, pass());
    }
}

static void test_one_far_from_the_formation_sees_it_coarsely(void)
{
    struct place place;

    view.own = (struct vec32){-4000 * 500, 0};
    place = allocation_place(&view);
    TEST_ASSERT_EQUAL(7, place.scale);
    TEST_ASSERT_INT16_WITHIN(1, -15625, place.at.x);
    TEST_ASSERT_EQUAL_INT16(0, place.at.y);
    TEST_ASSERT_EQUAL(2, pass());
}

static void test_it_stands_turned_with_the_leader(void)
{
    view.origin = (struct vec32){50000, -70000};
    view.heading = sincos_of(ANGLE_QUARTER);
    view.own = (struct vec32){50000, -70000 + 1400};
    TEST_ASSERT_EQUAL(2, pass());
    TEST_ASSERT_INT16_WITHIN(1, 1400, allocation_place(&view).at.x);
    meet(20, 0, 2);
    neighbours.entry[0].pose.at = (struct vec32){50000, -70000 + 1300};
    TEST_ASSERT_EQUAL(3, pass());
}

static void test_a_rival_is_taken_where_it_has_gone_meanwhile(void)
{
    stand(1400);
    meet(20, 500, 2);
    neighbours.entry[0].time = 1000;
    neighbours.entry[0].drift.x = 1000;
    view.now = 1050;
    TEST_ASSERT_EQUAL(2, pass());
    view.now = 1300;
    TEST_ASSERT_EQUAL(3, pass());
}

/* Algorithm 1 as it is printed, one vertex at a time. */

static int64_t distance(uint16_t vertex, int32_t x, int32_t y)
{
    int64_t dx = x - formation.vertex[vertex - 1].x;
    int64_t dy = y - formation.vertex[vertex - 1].y;

    return dx * dx + dy * dy;
}

static bool lost(uint16_t vertex)
{
    for (uint8_t i = 0; i < neighbours.count; i++) {
        const struct neighbour *n = &neighbours.entry[i];
        int64_t its = distance(vertex, n->pose.at.x, n->pose.at.y);
        int64_t own = distance(vertex, view.own.x, view.own.y);

        if (n->role != ROLE_LEADER && (view.literal || n->vertex == vertex) &&
            (its < own || (its == own && n->id < view.id)))
            return true;
    }
    return false;
}

static uint16_t closest_unmarked(const bool *marked)
{
    uint16_t best = 0;

    for (uint16_t v = 1; v <= formation.total; v++)
        if (!marked[v] && v != formation.leader &&
            (best == 0 ||
             distance(v, view.own.x, view.own.y) < distance(best, view.own.x, view.own.y)))
            best = v;
    return best;
}

static uint16_t as_printed(bool *marked)
{
    bool cleared = false;

    for (;;) {
        uint16_t vertex = closest_unmarked(marked);

        if (vertex != 0 && !lost(vertex))
            return vertex;
        if (vertex != 0)
            marked[vertex] = true;
        else if (cleared)
            return 0;
        else
            memset(marked, false, VERTICES_MAX + 1);
        cleared |= vertex == 0;
    }
}

static uint32_t random_state = 1;

static uint16_t draw_below(uint16_t end)
{
    return (uint16_t)((random_next(&random_state) >> 8) % end);
}

/* On a coarse grid, so that ties are common. */
static int16_t draw_part(void)
{
    return (int16_t)(100 * draw_below(40) - 2000);
}

static void draw_world(void)
{
    formation.total = 1 + draw_below(40);
    formation.leader = draw_below(formation.total + 1);
    for (uint16_t i = 0; i < formation.total; i++)
        formation.vertex[i] = (struct vec16){draw_part(), draw_part()};
    view.own = (struct vec32){draw_part(), draw_part()};
}

static void draw_neighbours(void)
{
    neighbours.count = 0;
    for (uint16_t i = draw_below(NEIGHBOURS_MAX + 1); i > 0; i--) {
        meet(2 + 2 * i, draw_part(), draw_below(formation.total + 2));
        neighbours.entry[neighbours.count - 1].pose.at.y = draw_part();
    }
}

static void assert_same_list(const bool *marked)
{
    for (uint16_t v = 1; v <= formation.total; v++)
        TEST_ASSERT_EQUAL(marked[v], (state.taboo[(v - 1) / 8] >> (v - 1) % 8) & 1);
}

static void test_a_pass_comes_to_what_the_algorithm_comes_to(void)
{
    for (unsigned world = 0; world < 20000; world++) {
        bool marked[VERTICES_MAX + 1] = {false};

        view.literal = world % 8 == 0;
        draw_world();
        allocation_begin(&state);
        allocation_under(&state, 1, 1);
        for (unsigned i = 0; i < 5; i++) {
            draw_neighbours();
            uint16_t expected = as_printed(marked);
            TEST_ASSERT_EQUAL(expected, pass());
            if (expected == 0)
                break;
            assert_same_list(marked);
        }
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
    RUN_TEST(test_a_pass_that_starts_anew_goes_on_in_the_next_tick);
    RUN_TEST(test_coarser_passes_choose_alike);
    RUN_TEST(test_one_far_from_the_formation_sees_it_coarsely);
    RUN_TEST(test_it_stands_turned_with_the_leader);
    RUN_TEST(test_a_rival_is_taken_where_it_has_gone_meanwhile);
    RUN_TEST(test_a_pass_comes_to_what_the_algorithm_comes_to);
    return UNITY_END();
}
