#include "metrics.h"

#include "limits.h"
#include "random.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define ROBOTS_MAX 40
#define SQUARE 0 /* the leader's vertex and three at 2 m: left, right, behind */
#define PAIR 1   /* the leader's vertex is the second */
#define ALONE 2

static double square_L[] = {0, 2, 2, -2};
static double square_psi[] = {0, M_PI / 2, -M_PI / 2, 0};
static double pair_L[] = {1, 0}, pair_psi[] = {M_PI, 0};
static double alone_L[] = {0}, alone_psi[] = {0};
static struct scenario_formation formations[] = {
    {.count = 4, .L = square_L, .psi = square_psi},
    {.count = 2, .L = pair_L, .psi = pair_psi},
    {.count = 1, .L = alone_L, .psi = alone_psi},
};

static struct scenario_robot robots[ROBOTS_MAX];
static struct scenario scenario;
static struct metrics *metrics;

/* What the next tick shows. */
static struct sample now[ROBOTS_MAX];
static struct reference_state reference;
static size_t leader;
static size_t formation;
static int ticks;

/* Robots with ids from 1 on, the first two of them candidates, all followers at the origin. */
static void given(size_t count)
{
    metrics_free(metrics);
    memset(now, 0, sizeof now);
    for (size_t i = 0; i < count; i++) {
        robots[i] = (struct scenario_robot){.id = (uint16_t)(i + 1), .candidate = i < 2};
        now[i].role = ROLE_FOLLOWER;
        now[i].alive = true;
    }
    scenario = (struct scenario){
        .robot_count = count, .robots = robots, .formation_count = 3, .formations = formations};
    reference = (struct reference_state){0};
    leader = SERVER_NOBODY;
    formation = SQUARE;
    ticks = 0;
    metrics = metrics_new(&scenario);
    TEST_ASSERT_NOT_NULL(metrics);
}

void setUp(void)
{
    given(4);
}

void tearDown(void)
{
    metrics_free(metrics);
    metrics = NULL;
}

static void place(size_t robot, double x, double y, double theta)
{
    now[robot].x = x;
    now[robot].y = y;
    now[robot].theta = theta;
}

static void lead(size_t robot)
{
    if (leader != SERVER_NOBODY)
        now[leader].role = ROLE_FOLLOWER;
    leader = robot;
    if (leader != SERVER_NOBODY)
        now[leader].role = ROLE_LEADER;
}

static void tick_with(bool event)
{
    metrics_tick(metrics, ticks++ * TICK_MS / 1000.0, now, leader, &formations[formation],
                 &reference, event);
}

static void tick(void)
{
    tick_with(false);
}

static void assert_error(double expected, size_t robot)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected, now[robot].distance_error);
}

/* ---- distance error -------------------------------------------------------------------- */

static void test_a_held_vertex_is_placed_by_the_leaders_true_pose(void)
{
    place(0, 10, 20, M_PI / 2); /* facing up: its left is -x */
    lead(0);
    now[1].vertex = 2;
    place(1, 8, 20, 0);
    now[2].vertex = 3;
    place(2, 12, 21.5, 0);
    now[3].vertex = 4;
    place(3, 13, 22, 0); /* should be 2 m behind: (10, 18) */
    tick();
    assert_error(0, 1);
    assert_error(1.5, 2);
    assert_error(5, 3);
}

static void test_the_leaders_error_is_to_the_reference(void)
{
    reference.x = 3;
    reference.y = 4;
    now[0].vertex = 1;
    lead(0);
    tick();
    assert_error(5, 0);
}

static void test_who_holds_none_is_measured_to_the_closest_vertex(void)
{
    lead(0);
    place(1, 0.5, 2, 0);  /* closest to vertex 2 at (0, 2) */
    place(2, 0.5, -3, 0); /* vertex 3 at (0, -2) */
    place(3, -2, 0, 0);   /* vertex 4 */
    tick();
    assert_error(0.5, 1);
    assert_error(hypot(0.5, 1), 2);
    assert_error(0, 3);
}

static void test_the_closest_vertex_may_be_the_leaders(void)
{
    lead(0);
    place(1, 0.1, 0, 0);
    tick();
    assert_error(0.1, 1);
}

static void test_a_vertex_that_the_formation_has_not_counts_as_none(void)
{
    lead(0);
    formation = PAIR;
    place(1, -1, 0.25, 0);
    now[1].vertex = 3;
    tick();
    assert_error(0.25, 1);
}

static void test_in_a_formation_of_one_all_others_are_measured_to_the_leader(void)
{
    lead(0);
    formation = ALONE;
    place(0, 1, 0, 0);
    place(1, 1, 7, 0);
    tick();
    assert_error(7, 1);
}

static void test_the_dead_have_no_error_and_are_not_in_the_mean(void)
{
    lead(0);
    place(1, 9, 9, 0);
    now[1].alive = false;
    now[2].vertex = 3;
    place(2, 0, -2.3, 0);
    now[3].alive = false;
    tick();
    assert_error(0, 1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3 / 2, metrics_result(metrics).error_final);
}

static void test_with_all_dead_the_mean_is_0(void)
{
    for (size_t i = 0; i < 4; i++)
        now[i].alive = false;
    tick();
    TEST_ASSERT_TRUE(metrics_result(metrics).error_final == 0);
}

static void test_without_a_leader_vertices_stay_about_its_last_pose(void)
{
    place(0, 5, 0, 0);
    lead(0);
    now[1].vertex = 2;
    place(1, 5, 2, 0);
    tick();
    assert_error(0, 1);
    lead(SERVER_NOBODY);
    now[0].alive = false;
    place(0, 100, 0, 0);
    tick();
    assert_error(0, 1);
    lead(3);
    tick();
    assert_error(5, 1);
}

static void test_before_the_first_leader_it_is_the_candidate_nearest_the_reference(void)
{
    reference.x = 10;
    place(0, 6, 0, 0);
    place(1, 13, 0, 0);
    place(2, 10, 0, 0); /* nearest, no candidate */
    now[2].vertex = 2;
    tick();
    assert_error(hypot(3, 2), 2);
    now[1].alive = false;
    tick();
    assert_error(hypot(4, 2), 2);
    now[0].alive = false;
    tick();
    assert_error(2, 2); /* no candidate lives: about the reference */
}

static void test_of_two_candidates_as_near_the_smaller_id_counts(void)
{
    place(0, -1, 0, 0);
    place(1, 1, 0, 0);
    now[2].vertex = 2;
    place(2, -1, 2, 0);
    robots[1].id = 40;
    tick();
    assert_error(0, 2);
    robots[0].id = 50;
    tick();
    assert_error(2, 2);
}

static void test_final_peak_and_integral_of_the_mean(void)
{
    static const double errors[] = {0.4, 2.8, 1.2, 0.8};

    lead(0);
    for (size_t i = 1; i < 4; i++)
        now[i].vertex = (uint16_t)(i + 1);
    for (size_t i = 0; i < 4; i++) {
        place(1, 0, 2 + errors[i], 0);
        place(2, 0, -2, 0);
        place(3, -2, 0, 0);
        tick();
    }
    struct metrics_result result = metrics_result(metrics);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, result.error_final);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.7, result.error_peak);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.02 * 5.2 / 4, result.error_integral);
}

/* ---- completeness ---------------------------------------------------------------------- */

static bool complete_after_a_tick(void)
{
    tick();
    return metrics_result(metrics).complete;
}

/* Robot 0 leads, the others hold a vertex each. */
static void given_complete(void)
{
    lead(0);
    for (size_t i = 1; i < scenario.robot_count; i++)
        now[i].vertex = (uint16_t)(i + 1);
}

static void test_complete_is_every_live_follower_on_a_vertex_of_its_own(void)
{
    given_complete();
    TEST_ASSERT_TRUE(complete_after_a_tick());
    now[3].vertex = 0;
    TEST_ASSERT_FALSE(complete_after_a_tick());
    now[3].vertex = 3;
    TEST_ASSERT_FALSE(complete_after_a_tick());
    now[3].alive = false;
    TEST_ASSERT_TRUE(complete_after_a_tick());
}

static void test_complete_needs_one_live_leader(void)
{
    given_complete();
    lead(SERVER_NOBODY);
    TEST_ASSERT_FALSE(complete_after_a_tick());
    now[0].role = now[1].role = ROLE_LEADER;
    TEST_ASSERT_FALSE(complete_after_a_tick());
    now[0].alive = false;
    TEST_ASSERT_TRUE(complete_after_a_tick());
    now[1].alive = false;
    TEST_ASSERT_FALSE(complete_after_a_tick());
}

static void test_complete_allows_spares_when_all_vertices_are_held(void)
{
    given(6);
    given_complete();
    now[4].vertex = now[5].vertex = 0;
    TEST_ASSERT_TRUE(complete_after_a_tick());
    now[2].vertex = 0;
    TEST_ASSERT_FALSE(complete_after_a_tick());
    now[5].vertex = 3;
    TEST_ASSERT_TRUE(complete_after_a_tick());
}

static void test_a_vertex_the_formation_has_not_does_not_count(void)
{
    given_complete();
    formation = PAIR; /* two vertices: one follower is enough */
    now[1].vertex = 3;
    now[2].vertex = now[3].vertex = 0;
    TEST_ASSERT_FALSE(complete_after_a_tick());
    now[1].vertex = 1;
    TEST_ASSERT_TRUE(complete_after_a_tick());
}

static void tick_until(double t)
{
    while (ticks * TICK_MS / 1000.0 <= t + 1e-9)
        tick();
}

static void test_time_to_complete_counts_from_the_last_event_to_where_it_stays_complete(void)
{
    lead(0);
    tick_until(0.98);
    given_complete();
    tick_until(3); /* complete since 1.00 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1, metrics_result(metrics).time_to_complete);

    tick_with(true); /* 3.02 */
    now[2].vertex = 0;
    tick_until(3.5);
    TEST_ASSERT_FALSE(metrics_result(metrics).complete);
    TEST_ASSERT_TRUE(metrics_result(metrics).time_to_complete < 0);
    now[2].vertex = 3;
    tick_until(5); /* since 3.52 */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5, metrics_result(metrics).time_to_complete);

    tick_with(true); /* changes nothing */
    tick_until(8);
    TEST_ASSERT_TRUE(metrics_result(metrics).time_to_complete == 0);
}

/* ---- switches and elections ------------------------------------------------------------ */

static void test_a_switch_is_a_follower_that_leaves_a_vertex(void)
{
    static const struct {
        uint16_t vertex;
        uint64_t switches;
    } steps[] = {{0, 0}, {2, 0}, {2, 0}, {3, 1}, {0, 2}, {4, 2}, {2, 3}};

    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        now[2].vertex = steps[i].vertex;
        tick();
        TEST_ASSERT_EQUAL_UINT64(steps[i].switches, metrics_result(metrics).switches);
    }
}

static void test_neither_leaders_nor_the_dead_switch(void)
{
    now[1].vertex = now[2].vertex = 2;
    now[3].vertex = 3;
    tick();
    lead(1); /* takes the leader's vertex */
    now[1].vertex = 1;
    now[2].alive = false; /* dies */
    now[2].vertex = 0;
    tick();
    lead(SERVER_NOBODY); /* gives it up */
    now[1].vertex = 4;
    now[2].alive = true; /* returns */
    now[2].vertex = 3;
    tick();
    TEST_ASSERT_EQUAL_UINT64(0, metrics_result(metrics).switches);
}

static void test_an_election_is_a_robot_that_begins_to_lead(void)
{
    static const struct {
        size_t leader;
        uint64_t elections;
    } steps[] = {{0, 1}, {0, 1}, {1, 2}, {SERVER_NOBODY, 2}, {1, 3}, {0, 4}};

    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        lead(steps[i].leader);
        tick();
        TEST_ASSERT_EQUAL_UINT64(steps[i].elections, metrics_result(metrics).elections);
    }
    TEST_ASSERT_EQUAL_UINT64(0, metrics_result(metrics).leader);
}

/* ---- paths and distances --------------------------------------------------------------- */

static void test_paths_add_up_over_all_robots(void)
{
    for (size_t i = 0; i < 4; i++)
        place(i, (double)i, 5, 0);
    tick();
    TEST_ASSERT_TRUE(metrics_result(metrics).path_length == 0);
    place(0, 3, 9, 0);
    tick();
    place(0, 0, 5, 0);
    place(3, 3, 6, 0);
    tick();
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 11, metrics_result(metrics).path_length);
}

static double draw(uint32_t *state)
{
    return random_next(state) / (double)UINT32_MAX * 20 - 10;
}

static void test_the_least_separation_is_that_of_all_pairs_at_all_ticks(void)
{
    uint32_t state = 1;

    for (int fleet = 0; fleet < 200; fleet++) {
        double least = INFINITY;

        given(2 + random_next(&state) % (ROBOTS_MAX - 1));
        for (int tick_count = 0; tick_count < 20; tick_count++) {
            for (size_t i = 0; i < scenario.robot_count; i++)
                place(i, draw(&state), draw(&state), 0);
            tick();
            for (size_t i = 0; i < scenario.robot_count; i++)
                for (size_t j = 0; j < i; j++)
                    least = fmin(least, hypot(now[i].x - now[j].x, now[i].y - now[j].y));
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, least, metrics_result(metrics).min_separation);
        }
    }
}

static void test_one_robot_is_apart_from_nothing(void)
{
    given(1);
    tick();
    TEST_ASSERT_TRUE(isinf(metrics_result(metrics).min_separation));
}

/* ---- looking on ------------------------------------------------------------------------ */

static void test_what_was_measured_can_be_looked_at(void)
{
    place(0, 10, 20, M_PI / 2);
    lead(0);
    now[1].vertex = 2;
    place(1, 8, 20, 0);
    tick();
    const struct metrics_look *look = metrics_look(metrics);
    TEST_ASSERT_EQUAL_DOUBLE(metrics_result(metrics).error_final, look->mean_distance_error);
    TEST_ASSERT_FALSE(look->complete);
    TEST_ASSERT_EQUAL_DOUBLE(10, look->about.x);
    TEST_ASSERT_EQUAL_DOUBLE(M_PI / 2, look->about.theta);
    TEST_ASSERT_EQUAL_UINT64(4, look->vertex_count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 8, look->vertices[1].x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 20, look->vertices[1].y);
}

static void test_between_two_ticks_nothing_is_counted(void)
{
    lead(0);
    now[1].vertex = 2;
    place(1, 0, 2, 0);
    tick();
    struct metrics_result before = metrics_result(metrics);
    place(1, 50, 2, 0);
    now[1].vertex = 3;
    metrics_place(metrics, now, 0, &formations[PAIR], &reference);
    TEST_ASSERT_EQUAL_UINT64(2, metrics_look(metrics)->vertex_count);
    TEST_ASSERT_TRUE(metrics_look(metrics)->mean_distance_error > 10);
    struct metrics_result after = metrics_result(metrics);
    TEST_ASSERT_EQUAL_DOUBLE(before.error_final, after.error_final);
    TEST_ASSERT_EQUAL_DOUBLE(before.error_peak, after.error_peak);
    TEST_ASSERT_EQUAL_DOUBLE(before.error_integral, after.error_integral);
    TEST_ASSERT_EQUAL_DOUBLE(before.path_length, after.path_length);
    TEST_ASSERT_EQUAL_UINT64(before.switches, after.switches);
    TEST_ASSERT_EQUAL_UINT64(before.elections, after.elections);
}

/* Whoever leads before t = 0 has not led in what is judged. */
static void test_a_look_before_the_first_tick_is_forgotten(void)
{
    place(0, 5, 0, 0);
    metrics_place(metrics, now, 0, &formations[SQUARE], &reference);
    TEST_ASSERT_EQUAL_DOUBLE(5, metrics_look(metrics)->about.x);
    place(0, 9, 0, 0);
    tick();
    TEST_ASSERT_EQUAL_DOUBLE(0, metrics_look(metrics)->about.x); /* robot 2, closest */
    TEST_ASSERT_EQUAL_UINT64(0, metrics_result(metrics).elections);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_held_vertex_is_placed_by_the_leaders_true_pose);
    RUN_TEST(test_the_leaders_error_is_to_the_reference);
    RUN_TEST(test_who_holds_none_is_measured_to_the_closest_vertex);
    RUN_TEST(test_the_closest_vertex_may_be_the_leaders);
    RUN_TEST(test_a_vertex_that_the_formation_has_not_counts_as_none);
    RUN_TEST(test_in_a_formation_of_one_all_others_are_measured_to_the_leader);
    RUN_TEST(test_the_dead_have_no_error_and_are_not_in_the_mean);
    RUN_TEST(test_with_all_dead_the_mean_is_0);
    RUN_TEST(test_without_a_leader_vertices_stay_about_its_last_pose);
    RUN_TEST(test_before_the_first_leader_it_is_the_candidate_nearest_the_reference);
    RUN_TEST(test_of_two_candidates_as_near_the_smaller_id_counts);
    RUN_TEST(test_final_peak_and_integral_of_the_mean);
    RUN_TEST(test_complete_is_every_live_follower_on_a_vertex_of_its_own);
    RUN_TEST(test_complete_needs_one_live_leader);
    RUN_TEST(test_complete_allows_spares_when_all_vertices_are_held);
    RUN_TEST(test_a_vertex_the_formation_has_not_does_not_count);
    RUN_TEST(test_time_to_complete_counts_from_the_last_event_to_where_it_stays_complete);
    RUN_TEST(test_a_switch_is_a_follower_that_leaves_a_vertex);
    RUN_TEST(test_neither_leaders_nor_the_dead_switch);
    RUN_TEST(test_an_election_is_a_robot_that_begins_to_lead);
    RUN_TEST(test_paths_add_up_over_all_robots);
    RUN_TEST(test_the_least_separation_is_that_of_all_pairs_at_all_ticks);
    RUN_TEST(test_one_robot_is_apart_from_nothing);
    RUN_TEST(test_what_was_measured_can_be_looked_at);
    RUN_TEST(test_between_two_ticks_nothing_is_counted);
    RUN_TEST(test_a_look_before_the_first_tick_is_forgotten);
    return UNITY_END();
}
