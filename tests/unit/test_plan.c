#include "plan.h"

#include "formation.h"
#include "trajectory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

static const struct plan_robot robot = {.track = 0.1, .wheel_max = 4.5, .latency_ms = 5};

static struct scenario *scenario;
static struct plan *plan;

void setUp(void)
{
    scenario = NULL;
    plan = NULL;
}

void tearDown(void)
{
    plan_free(plan);
    scenario_free(scenario);
}

/* Two robots and their formations; `rest` has the trajectory, the duration and what else. */
static void given(const char *rest)
{
    char text[2048];
    char error[512] = "";

    snprintf(text, sizeof text,
             "schema: 1\nname: test\nrobots:\n"
             "  - {id: 7, pose: [0, 0, 0], candidate: true}\n"
             "  - {id: 300, pose: [1, 0, 0]}\n"
             "formations:\n"
             "  pair: {L: [0, -2.5], psi: [0, pi/2]}\n"
             "  wide: {L: [-100, 0], psi: [-pi/4, 0]}\n"
             "formation: wide\n%s",
             rest);
    scenario = scenario_parse("test", text, strlen(text), NULL, 0, 128, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(scenario, error);
    plan = plan_new(scenario, &robot, 77);
    TEST_ASSERT_NOT_NULL(plan);
}

static void given_trajectory(const char *duration, const char *start, const char *v,
                             const char *omega)
{
    char rest[1024];

    tearDown();
    snprintf(rest, sizeof rest, "duration: %s\ntrajectory: {start: %s, v: \"%s\", omega: \"%s\"}\n",
             duration, start, v, omega);
    given(rest);
}

static void given_motion(const char *motion)
{
    char rest[1024];

    snprintf(rest, sizeof rest, "duration: 1\ntrajectory: {start: [0, 0, 0], v: 0, omega: 0}\n%s\n",
             motion);
    given(rest);
}

/* ---- knots ----------------------------------------------------------------------------- */

/* 1 mm, 2 mrad, 4 mm/s and 4 mrad/s, and the rounding of a knot. */
static void assert_near(const struct reference_state *state, const struct reference *seen)
{
    double turn = seen->pose.theta * 2 * M_PI / ANGLE_TURN - state->theta;

    TEST_ASSERT_DOUBLE_WITHIN(0.0013, state->x, (double)seen->pose.at.x / NARROW_PER_M);
    TEST_ASSERT_DOUBLE_WITHIN(0.0013, state->y, (double)seen->pose.at.y / NARROW_PER_M);
    TEST_ASSERT_DOUBLE_WITHIN(0.0021, 0, remainder(turn, 2 * M_PI));
    TEST_ASSERT_DOUBLE_WITHIN(0.0042, state->v, (double)seen->v / NARROW_PER_M);
    TEST_ASSERT_DOUBLE_WITHIN(0.0046, state->omega, (double)seen->omega / RATE_ONE);
}

/* At every tick the robots' reference, by their own arithmetic, against the scenario's. Where a
 * knot ends more than one tick, the way to it counts as well as the knot. */
static void assert_robots_see_the_reference(void)
{
    const struct knot *knots = plan->config.knots;
    struct reference_state state = trajectory_start(scenario->trajectory);

    for (size_t i = 0; i + 1 < plan->config.knot_count; i++) {
        const struct knot *from = &knots[i], *to = &knots[i + 1];

        for (int32_t time = from->time; time < to->time; time += TICK_MS) {
            struct reference seen = reference_between(from, to, time);

            assert_near(&state, &seen);
            state = trajectory_step(scenario->trajectory, &state);
        }
        struct reference end = reference_between(from, to, to->time);
        if (to->time - from->time > TICK_MS)
            assert_near(&state, &end);
    }
    struct reference last = reference_after(&knots[plan->config.knot_count - 1],
                                            knots[plan->config.knot_count - 1].time);
    assert_near(&state, &last);
}

/* As mission.c wants them: on ticks, the first at 0, the last at the duration. */
static void assert_knots_are_in_order(int32_t duration)
{
    const struct knot *knots = plan->config.knots;
    size_t count = plan->config.knot_count;

    TEST_ASSERT_TRUE(count >= 1);
    TEST_ASSERT_EQUAL_INT32(0, knots[0].time);
    TEST_ASSERT_EQUAL_INT32(duration, knots[count - 1].time);
    for (size_t i = 0; i + 1 < count; i++) {
        TEST_ASSERT_EQUAL_INT32(0, knots[i].time % TICK_MS);
        TEST_ASSERT_TRUE(knots[i + 1].time > knots[i].time);
        TEST_ASSERT_TRUE(knots[i + 1].time - knots[i].time <= KNOT_SPACING_MAX_MS);
    }
}

static void test_robots_see_the_scenarios_reference(void)
{
    static const struct {
        const char *start, *v, *omega;
    } trajectories[] = {
        {"[0, 0, 0]", "0", "0"},
        {"[1, -2, 3]", "1.5", "0"},
        {"[-2000, 2000, -pi]", "0.3", "0.25"},
        {"[0, 0, -pi]", "1.5", "-0.2*tanh(0.1*(t-15))"}, /* the paper's */
        {"[0, 0, 0]", "1 + 0.8*sin(t)", "0.5*cos(2*t)"},
        {"[0, 0, 0]", "t < 5 ? 1 : 0.5", "t < 7.01 ? 0.3 : -0.3"},
        {"[0, 0, 0]", "floor(t) / 4 - 2", "0"},
        {"[0, 0, 0]", "-1", "3*sin(20*t)"},
        {"[0, 0, 0]", "0.01", "0.03*(t-10)^2 - 1"}, /* the heading is what binds */
        {"[0, 0, 0]", "0.2", "20"},
    };

    for (size_t i = 0; i < sizeof trajectories / sizeof trajectories[0]; i++) {
        given_trajectory("20", trajectories[i].start, trajectories[i].v, trajectories[i].omega);
        assert_knots_are_in_order(20000);
        assert_robots_see_the_reference();
    }
}

static void test_knots_are_as_far_apart_as_the_reference_allows(void)
{
    given_trajectory("60", "[0, 0, 0]", "1", "0");
    TEST_ASSERT_EQUAL_UINT64(61, plan->config.knot_count);
    given_trajectory("60", "[0, 0, 0]", "0.3", "0.25");
    TEST_ASSERT_EQUAL_UINT64(61, plan->config.knot_count);
    given_trajectory("60", "[0, 0, -pi]", "1.5", "-0.2*tanh(0.1*(t-15))");
    TEST_ASSERT_LESS_OR_EQUAL_UINT64(90, plan->config.knot_count);
    given_trajectory("60", "[0, 0, 0]", "t < 30.02 ? 1 : 0.5", "0");
    TEST_ASSERT_LESS_OR_EQUAL_UINT64(75, plan->config.knot_count); /* a few more about the jump */
}

static void test_the_last_knot_lies_at_the_duration_or_just_after(void)
{
    given_trajectory("0", "[3, 4, 0]", "1", "0");
    assert_knots_are_in_order(0);
    assert_robots_see_the_reference();
    given_trajectory("0.001", "[0, 0, 0]", "1", "0");
    assert_knots_are_in_order(20);
    given_trajectory("0.02", "[0, 0, 0]", "1", "0");
    assert_knots_are_in_order(20);
    given_trajectory("7.77", "[0, 0, 0]", "1", "0");
    assert_knots_are_in_order(7780);
}

/* ---- the rest -------------------------------------------------------------------------- */

static void test_robots_and_candidates(void)
{
    given_motion("");
    TEST_ASSERT_EQUAL_UINT64(2, plan->config.robot_count);
    TEST_ASSERT_EQUAL_UINT16(7, plan->config.robots[0].id);
    TEST_ASSERT_TRUE(plan->config.robots[0].candidate);
    TEST_ASSERT_EQUAL_UINT16(300, plan->config.robots[1].id);
    TEST_ASSERT_FALSE(plan->config.robots[1].candidate);
}

static void test_formations_in_wire_units_at_the_scale_that_fits(void)
{
    given_motion("");
    const struct server_formation *formations = plan->config.formations;

    TEST_ASSERT_EQUAL_UINT64(2, plan->config.formation_count);
    TEST_ASSERT_EQUAL_UINT16(1, plan->config.formation);
    TEST_ASSERT_EQUAL_UINT16(2, formations[0].count);
    TEST_ASSERT_EQUAL_UINT8(0, formations[0].scale);
    TEST_ASSERT_EQUAL_INT32(0, formations[0].vertex[0].distance);
    TEST_ASSERT_EQUAL_INT32(-10000, formations[0].vertex[1].distance);
    TEST_ASSERT_EQUAL_UINT16(16384, formations[0].vertex[1].psi);
    TEST_ASSERT_EQUAL_UINT8(formation_scale(400000), formations[1].scale);
    TEST_ASSERT_EQUAL_INT32(-400000, formations[1].vertex[0].distance);
    TEST_ASSERT_EQUAL_UINT16(57344, formations[1].vertex[0].psi);
}

static void test_the_mission_in_wire_units(void)
{
    given_motion("motion: {law: kanayama, k: 1.5, k_theta: 2.25, v_max: 2, omega_max: 5}");
    const struct message_mission *mission = &plan->config.mission;

    TEST_ASSERT_EQUAL_UINT8(PROTOCOL_VERSION, mission->version);
    TEST_ASSERT_EQUAL_UINT8(LAW_KANAYAMA, mission->law);
    TEST_ASSERT_EQUAL_UINT16(384, mission->k);
    TEST_ASSERT_EQUAL_UINT16(576, mission->k_theta);
    TEST_ASSERT_EQUAL_INT16(8000, mission->v_max);
    TEST_ASSERT_EQUAL_INT16(5120, mission->omega_max);
    TEST_ASSERT_EQUAL_INT16(400, mission->track);
    TEST_ASSERT_EQUAL_INT16(18000, mission->wheel_max);
    TEST_ASSERT_EQUAL_UINT8(5, mission->latency);
    TEST_ASSERT_EQUAL_UINT64(77, plan->config.seed);
}

/* What a robot would refuse never leaves the host (message_read()). */
static void test_the_slowest_motion_is_still_one_that_robots_accept(void)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];
    struct message message = {.type = MESSAGE_MISSION};

    given_motion("motion: {v_max: 0.00001, omega_max: 0.00001}");
    message.mission = plan->config.mission;
    uint8_t length = message_write(payload, &message);
    TEST_ASSERT_TRUE(message_read(&message, payload, length));
}

static void test_allocation_network_and_events(void)
{
    static const struct {
        const char *word;
        enum server_allocation expected;
    } allocations[] = {{"cpa", SERVER_CPA},
                       {"cpa-literal", SERVER_CPA_LITERAL},
                       {"rigid", SERVER_RIGID},
                       {"optimal", SERVER_OPTIMAL}};
    char rest[256];

    for (size_t i = 0; i < sizeof allocations / sizeof allocations[0]; i++) {
        tearDown();
        snprintf(rest, sizeof rest,
                 "allocation: %s\nnetwork: {range: 2, loss: 0.25, delay: 0.5}\n"
                 "events: [{at: 1, kill: 7}, {at: 0.5, estop: true}]",
                 allocations[i].word);
        given_motion(rest);
        TEST_ASSERT_EQUAL_UINT(allocations[i].expected, plan->config.allocation);
        TEST_ASSERT_DOUBLE_WITHIN(0, 2, plan->config.range);
        TEST_ASSERT_DOUBLE_WITHIN(0, 0.25, plan->config.loss);
        TEST_ASSERT_DOUBLE_WITHIN(0, 0.5, plan->config.delay);
        TEST_ASSERT_EQUAL_UINT64(2, plan->config.event_count);
        TEST_ASSERT_EQUAL_UINT(EVENT_KILL, plan->config.events[0].action);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_robots_see_the_scenarios_reference);
    RUN_TEST(test_knots_are_as_far_apart_as_the_reference_allows);
    RUN_TEST(test_the_last_knot_lies_at_the_duration_or_just_after);
    RUN_TEST(test_robots_and_candidates);
    RUN_TEST(test_formations_in_wire_units_at_the_scale_that_fits);
    RUN_TEST(test_the_mission_in_wire_units);
    RUN_TEST(test_the_slowest_motion_is_still_one_that_robots_accept);
    RUN_TEST(test_allocation_network_and_events);
    return UNITY_END();
}
