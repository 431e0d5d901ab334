#include "snapshot.h"

#include "fake_fleet.h"
#include "limits.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static double L[] = {0, 2, 2}, psi[] = {0, M_PI / 2, -M_PI / 2};
static struct scenario_formation formation = {.name = "row", .count = 3, .L = L, .psi = psi};
static struct scenario_robot robots[] = {
    {.id = 10, .candidate = true}, {.id = 20, .candidate = true}, {.id = 30}};
static const struct scenario scenario = {
    .robot_count = 3, .robots = robots, .formation_count = 1, .formations = &formation};

static struct metrics *metrics;
static struct sample samples[3];
static struct reference_state reference;
static struct scene_robot seen[3];
static struct scene scene;

void setUp(void)
{
    fleet_reset(3);
    fleet_start();
    metrics = metrics_new(&scenario);
    TEST_ASSERT_NOT_NULL(metrics);
    memset(samples, 0, sizeof samples);
    memset(seen, 0, sizeof seen);
    for (size_t i = 0; i < 3; i++)
        samples[i].alive = true;
    reference = (struct reference_state){.x = 3, .y = 4, .theta = 0.5};
    scene = (struct scene){.robots = seen};
}

void tearDown(void)
{
    metrics_free(metrics);
    fleet_free();
}

static void take(void)
{
    struct snapshot_of of = {&scenario, server, metrics, samples, &formation, &reference};

    metrics_tick(metrics, server_time(server) / 1000.0, samples, server_leader(server), &formation,
                 &reference, false);
    snapshot_take(&scene, &of);
}

static void test_it_has_what_the_trace_has(void)
{
    samples[2] = (struct sample){.x = 1,
                                 .y = 2,
                                 .theta = 3,
                                 .v = 4,
                                 .omega = 5,
                                 .role = ROLE_FOLLOWER,
                                 .vertex = 2,
                                 .alive = true};
    take();
    TEST_ASSERT_EQUAL_UINT64(3, scene.robot_count);
    TEST_ASSERT_EQUAL_UINT16(30, seen[2].id);
    TEST_ASSERT_EQUAL_DOUBLE(1, seen[2].x);
    TEST_ASSERT_EQUAL_DOUBLE(2, seen[2].y);
    TEST_ASSERT_EQUAL_DOUBLE(3, seen[2].theta);
    TEST_ASSERT_EQUAL_DOUBLE(4, seen[2].v);
    TEST_ASSERT_EQUAL_DOUBLE(5, seen[2].omega);
    TEST_ASSERT_EQUAL_UINT8(ROLE_FOLLOWER, seen[2].role);
    TEST_ASSERT_EQUAL_UINT16(2, seen[2].vertex);
    TEST_ASSERT_TRUE(seen[2].alive);
    TEST_ASSERT_FALSE(seen[2].candidate);
    TEST_ASSERT_TRUE(seen[1].candidate);
    TEST_ASSERT_EQUAL_DOUBLE(samples[2].distance_error, seen[2].distance_error);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, seen[2].distance_error); /* vertex 2 is at (0, 2) */
}

static void test_it_has_what_the_server_knows_of_the_fleet(void)
{
    fleet_until(1000);
    fleet_beacon(1, ROLE_LEADER, 3);
    fleet_tick();
    take();
    TEST_ASSERT_EQUAL_INT32(1020, scene.time_ms);
    TEST_ASSERT_EQUAL_UINT16(20, scene.leader);
    TEST_ASSERT_EQUAL_UINT16(3, seen[1].term);
    TEST_ASSERT_EQUAL_STRING("row", scene.formation);
    TEST_ASSERT_FALSE(scene.estopped);
    TEST_ASSERT_EQUAL_DOUBLE(fleet_config.range, scene.range);
    TEST_ASSERT_EQUAL_DOUBLE(fleet_config.loss, scene.loss);
    TEST_ASSERT_EQUAL_DOUBLE(0, scene.delay);
    TEST_ASSERT_EQUAL_DOUBLE(3, scene.reference.x);
    TEST_ASSERT_EQUAL_DOUBLE(4, scene.reference.y);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, scene.reference.theta);
}

static void test_without_a_leader_its_id_is_0(void)
{
    take();
    TEST_ASSERT_EQUAL_UINT16(0, scene.leader);
}

static void test_a_leader_that_dies_leads_no_longer(void)
{
    fleet_beacon(1, ROLE_LEADER, 3);
    fleet_tick();
    samples[1].alive = false;
    take();
    TEST_ASSERT_EQUAL_UINT16(0, scene.leader);
}

static void test_it_has_the_vertices_where_they_are(void)
{
    fleet_beacon(1, ROLE_LEADER, 3);
    fleet_tick();
    samples[1].x = 10;
    samples[1].theta = M_PI / 2;
    samples[1].role = ROLE_LEADER;
    take();
    TEST_ASSERT_EQUAL_UINT64(3, scene.vertex_count);
    TEST_ASSERT_EQUAL_DOUBLE(10, scene.about.x);
    TEST_ASSERT_EQUAL_DOUBLE(M_PI / 2, scene.about.theta);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 10, scene.vertices[0].x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 8, scene.vertices[1].x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 12, scene.vertices[2].x);
}

static void test_it_has_how_old_the_poses_are(void)
{
    fleet_poses[0].age_ms = 7;
    fleet_poses[1].age_ms = -4; /* measured after the tick */
    fleet_poses[2].tracked = false;
    fleet_tick();
    take();
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.007f, seen[0].pose_age);
    TEST_ASSERT_EQUAL_FLOAT(0, seen[1].pose_age);
    TEST_ASSERT_TRUE(isnan(seen[2].pose_age));
}

static void test_it_has_what_befalls_the_radio(void)
{
    static const uint16_t groups[] = {0, 1, 1};
    struct event events[] = {
        {.action = EVENT_MUTE, .at_tick = 50, .robot = 30},
        {.action = EVENT_PARTITION, .at_tick = 50, .groups = groups},
        {.action = EVENT_DELAY, .at_tick = 50, .value = 0.5},
        {.action = EVENT_ESTOP, .at_tick = 50},
    };

    tearDown();
    fleet_reset(3);
    fleet_config.event_count = 4;
    fleet_config.events = events;
    fleet_start();
    metrics = metrics_new(&scenario);
    take();
    TEST_ASSERT_FALSE(seen[2].muted);
    fleet_until(1000);
    take();
    TEST_ASSERT_TRUE(seen[2].muted);
    TEST_ASSERT_FALSE(seen[1].muted);
    TEST_ASSERT_EQUAL_UINT16(0, seen[0].group);
    TEST_ASSERT_EQUAL_UINT16(1, seen[2].group);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, scene.delay);
    TEST_ASSERT_TRUE(scene.estopped);
}

static void test_what_only_the_keeper_of_the_robots_knows_stays(void)
{
    seen[1].loss = 0.25f;
    seen[1].load = 0.5f;
    seen[1].stalled = true;
    take();
    TEST_ASSERT_EQUAL_FLOAT(0.25f, seen[1].loss);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, seen[1].load);
    TEST_ASSERT_TRUE(seen[1].stalled);
}

static void test_a_name_that_is_too_long_is_cut(void)
{
    char name[100];

    memset(name, 'a', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    formation.name = name;
    take();
    formation.name = "row";
    TEST_ASSERT_EQUAL_UINT64(SCENE_NAME_MAX - 1, strlen(scene.formation));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_has_what_the_trace_has);
    RUN_TEST(test_it_has_what_the_server_knows_of_the_fleet);
    RUN_TEST(test_without_a_leader_its_id_is_0);
    RUN_TEST(test_a_leader_that_dies_leads_no_longer);
    RUN_TEST(test_it_has_the_vertices_where_they_are);
    RUN_TEST(test_it_has_how_old_the_poses_are);
    RUN_TEST(test_it_has_what_befalls_the_radio);
    RUN_TEST(test_what_only_the_keeper_of_the_robots_knows_stays);
    RUN_TEST(test_a_name_that_is_too_long_is_cut);
    return UNITY_END();
}
