#include "fake_fleet.h"

#include "random.h"

#include <math.h>
#include <unity.h>

static uint32_t state;

void setUp(void)
{
    fleet_reset(4);
    state = 1;
}

void tearDown(void)
{
    fleet_free();
}

/* The vertices of the fleet's first formation, in the leader's frame, m; the first is its own. */
static const double places[4][2] = {{0, 0}, {2, 0}, {0, 2}, {-2, 0}};

/* Starts with `leader` leading; every robot has been told where to go. */
static void led_by(size_t leader)
{
    fleet_start();
    fleet_beacon(leader, ROLE_LEADER, 1);
    fleet_ticks(2);
}

static void assert_assigned(const uint16_t *vertices)
{
    for (size_t i = 0; i < fleet_config.robot_count; i++)
        TEST_ASSERT_EQUAL_UINT16(vertices[i], fleet[i].mission.assigned);
}

/* ---- rigid ----------------------------------------------------------------------------- */

static void test_without_a_leader_nobody_is_assigned(void)
{
    fleet_config.allocation = SERVER_RIGID;
    fleet_start();
    assert_assigned((uint16_t[]){0, 0, 0, 0});
}

static void test_robots_that_allocate_are_assigned_nothing(void)
{
    led_by(1);
    assert_assigned((uint16_t[]){0, 0, 0, 0});
}

static void test_rigid_gives_the_kth_vertex_to_the_kth_robot(void)
{
    fleet_config.allocation = SERVER_RIGID;
    led_by(0);
    assert_assigned((uint16_t[]){1, 2, 3, 4});
}

static void test_rigid_swaps_with_the_leaders_vertex(void)
{
    fleet_config.allocation = SERVER_RIGID;
    led_by(1);
    assert_assigned((uint16_t[]){2, 1, 3, 4});
}

static void test_rigid_gives_a_spare_nothing(void)
{
    fleet_reset(6);
    fleet_config.allocation = SERVER_RIGID;
    led_by(1);
    assert_assigned((uint16_t[]){2, 1, 3, 4, 0, 0});
}

static void test_rigid_makes_a_spare_of_whom_a_leading_spare_replaces(void)
{
    fleet_reset(6);
    fleet_robots[5].candidate = true;
    fleet_config.allocation = SERVER_RIGID;
    led_by(5);
    assert_assigned((uint16_t[]){0, 2, 3, 4, 0, 1});
}

static void test_rigid_follows_leader_and_formation(void)
{
    struct event event = {.action = EVENT_FORMATION, .at_tick = 50, .formation = 1};

    fleet_config.event_count = 1;
    fleet_config.events = &event;
    fleet_config.allocation = SERVER_RIGID;
    led_by(0);
    fleet_until(1000);
    fleet_tick();
    assert_assigned((uint16_t[]){3, 2, 1, 0}); /* three vertices, the last one the leader's */
    fleet_beacon(1, ROLE_LEADER, 2);
    fleet_ticks(2);
    assert_assigned((uint16_t[]){1, 3, 2, 0});
}

/* ---- optimal --------------------------------------------------------------------------- */

static double draw(double limit)
{
    return (random_next(&state) / (double)UINT32_MAX * 2 - 1) * limit;
}

static double distance(size_t robot, size_t leader, size_t vertex)
{
    const struct server_pose *about = &fleet_poses[leader];
    double c = cos(about->theta), s = sin(about->theta);

    return hypot(about->x + c * places[vertex][0] - s * places[vertex][1] - fleet_poses[robot].x,
                 about->y + s * places[vertex][0] + c * places[vertex][1] - fleet_poses[robot].y);
}

/* The least sum of distances from `robot` on, when `left` more robots are to have a vertex. */
static double least(size_t robot, size_t leader, size_t left, unsigned taken)
{
    double best = INFINITY;

    if (left == 0)
        return 0;
    if (robot == fleet_config.robot_count)
        return INFINITY;
    if (robot != leader)
        for (size_t vertex = 1; vertex < 4; vertex++)
            if (!(taken >> vertex & 1))
                best = fmin(best, distance(robot, leader, vertex) +
                                      least(robot + 1, leader, left - 1, taken | 1u << vertex));
    return fmin(best, least(robot + 1, leader, left, taken));
}

static void assert_optimal(size_t leader)
{
    size_t followers = fleet_config.robot_count - 1;
    size_t given = 0;
    unsigned taken = 0;
    double sum = 0;

    TEST_ASSERT_EQUAL_UINT16(1, fleet[leader].mission.assigned);
    for (size_t i = 0; i < fleet_config.robot_count; i++) {
        uint16_t vertex = fleet[i].mission.assigned;

        if (i == leader || vertex == 0)
            continue;
        TEST_ASSERT_TRUE(vertex >= 2 && vertex <= 4);
        TEST_ASSERT_EQUAL_UINT(0, taken >> vertex & 1);
        taken |= 1u << vertex;
        sum += distance(i, leader, vertex - 1u);
        given++;
    }
    TEST_ASSERT_EQUAL_UINT64(followers < 3 ? followers : 3, given);
    TEST_ASSERT_DOUBLE_WITHIN(0.005, least(0, leader, given, 0), sum);
}

static void scatter(void)
{
    for (size_t i = 0; i < FLEET_MAX; i++)
        fleet_poses[i] = (struct server_pose){draw(4), draw(4), draw(M_PI), true, 0};
}

static void test_optimal_is_optimal_with_fewer_robots_as_many_and_spares(void)
{
    for (size_t robots = 1; robots <= FLEET_MAX; robots++) {
        for (unsigned i = 0; i < 20; i++) {
            fleet_reset(robots);
            fleet_config.allocation = SERVER_OPTIMAL;
            scatter();
            size_t leader = random_next(&state) % (robots < 2 ? robots : 2);
            led_by(leader);
            assert_optimal(leader);
            fleet_free();
        }
    }
}

static void test_optimal_stands_while_nothing_takes_effect(void)
{
    fleet_config.allocation = SERVER_OPTIMAL;
    fleet_poses[2] = (struct server_pose){2, 0, 0, true, 0};
    fleet_poses[3] = (struct server_pose){-2, 0, 0, true, 0};
    led_by(0);
    uint16_t before = fleet[2].mission.assigned;
    fleet_poses[2].x = -2;
    fleet_poses[3].x = 2;
    fleet_ticks(50);
    TEST_ASSERT_EQUAL_UINT16(before, fleet[2].mission.assigned);
}

static void test_optimal_assigns_anew_when_a_robot_dies_or_returns(void)
{
    fleet_reset(5); /* robot 2 stands behind the leader, robot 4 behind robot 2 */
    fleet_config.allocation = SERVER_OPTIMAL;
    fleet_poses[0] = (struct server_pose){0, 0, 0, true, 0};
    fleet_poses[1] = (struct server_pose){2, 0, 0, true, 0};
    fleet_poses[2] = (struct server_pose){-2, 0, 0, true, 0};
    fleet_poses[3] = (struct server_pose){0, 2, 0, true, 0};
    fleet_poses[4] = (struct server_pose){-3, 0, 0, true, 0};
    led_by(0);
    assert_assigned((uint16_t[]){1, 2, 4, 3, 0});

    server_link(server, 2, false);
    fleet_ticks(2);
    TEST_ASSERT_EQUAL_UINT16(4, fleet[4].mission.assigned);

    fleet_reset_robot(2);
    server_link(server, 2, true);
    fleet_ticks(5);
    assert_assigned((uint16_t[]){1, 2, 4, 3, 0});
}

static void test_optimal_has_no_vertex_for_an_empty_battery(void)
{
    fleet_reset(5);
    fleet_config.allocation = SERVER_OPTIMAL;
    led_by(0);
    size_t spent = 1;
    while (fleet[spent].mission.assigned != 3)
        spent++;
    fleet[spent].faults = FAULT_BATTERY;
    fleet_status(spent);
    fleet_ticks(2);
    unsigned taken = 0;
    for (size_t i = 1; i < 5; i++)
        taken |= 1u << fleet[i].mission.assigned;
    TEST_ASSERT_EQUAL_UINT16(0, fleet[spent].mission.assigned);
    TEST_ASSERT_EQUAL_HEX(1 << 0 | 1 << 2 | 1 << 3 | 1 << 4, taken);
}

static void test_optimal_assigns_anew_when_another_leads(void)
{
    fleet_config.allocation = SERVER_OPTIMAL;
    scatter();
    led_by(0);
    fleet_beacon(1, ROLE_LEADER, 2);
    fleet_ticks(2);
    assert_optimal(1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_without_a_leader_nobody_is_assigned);
    RUN_TEST(test_robots_that_allocate_are_assigned_nothing);
    RUN_TEST(test_rigid_gives_the_kth_vertex_to_the_kth_robot);
    RUN_TEST(test_rigid_swaps_with_the_leaders_vertex);
    RUN_TEST(test_rigid_gives_a_spare_nothing);
    RUN_TEST(test_rigid_makes_a_spare_of_whom_a_leading_spare_replaces);
    RUN_TEST(test_rigid_follows_leader_and_formation);
    RUN_TEST(test_optimal_is_optimal_with_fewer_robots_as_many_and_spares);
    RUN_TEST(test_optimal_stands_while_nothing_takes_effect);
    RUN_TEST(test_optimal_assigns_anew_when_a_robot_dies_or_returns);
    RUN_TEST(test_optimal_has_no_vertex_for_an_empty_battery);
    RUN_TEST(test_optimal_assigns_anew_when_another_leads);
    return UNITY_END();
}
