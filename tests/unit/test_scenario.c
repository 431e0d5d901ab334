#include "scenario.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

#define VERTICES 128

/* A good file; the tests spoil or extend a line of it. */
static const char *const good[] = {
    "schema: 1",
    "name: fleet",
    "duration: 30",
    "robots:",
    "  - {id: 1, pose: [-2, 1, 0], candidate: true}",
    "  - {id: 2, pose: [2, 1, pi/2], candidate: true}",
    "  - {id: 7, pose: [-2, -1, 0]}",
    "trajectory: {start: [0, 0, -pi], v: 1.5, omega: \"-0.2*tanh(0.1*(t-15))\"}",
    "formations:",
    "  G1: {L: [0, 2, 2], psi: [0, -pi/3, pi/3]}",
    "  G2: {L: [3, 0, -3], psi: [0, 0, pi/2]}",
    "formation: G1",
    "events:",
    "  - {at: 10, kill: leader}",
};

#define GOOD_LINES (sizeof good / sizeof good[0])

static struct scenario *scenario;
static char error[1024];
static char text[8192];

void setUp(void)
{
    scenario = NULL;
    error[0] = '\0';
}

void tearDown(void)
{
    scenario_free(scenario);
}

/* The good file with line `number` (from 1) replaced; 0: as it is. */
static const char *with_line(size_t number, const char *line)
{
    text[0] = '\0';
    for (size_t i = 0; i < GOOD_LINES; i++) {
        strcat(text, i + 1 == number ? line : good[i]);
        strcat(text, "\n");
    }
    return text;
}

static void parse_bytes(const char *bytes, size_t length)
{
    scenario_free(scenario);
    scenario = scenario_parse("f.yaml", bytes, length, NULL, 0, VERTICES, error, sizeof error);
}

static void accept(const char *bytes)
{
    parse_bytes(bytes, strlen(bytes));
    TEST_ASSERT_NOT_NULL_MESSAGE(scenario, error);
}

/* `expected` is the beginning of the error's line. */
static void refuse_bytes(const char *bytes, size_t length, const char *expected)
{
    char begin[sizeof error];

    parse_bytes(bytes, length);
    TEST_ASSERT_NULL(scenario);
    snprintf(begin, strlen(expected) + 1, "%s", error);
    TEST_ASSERT_EQUAL_STRING(expected, begin);
    TEST_ASSERT_NULL_MESSAGE(strchr(error, '\n'), "an error is one line");
}

static void refuse_line(size_t number, const char *line, const char *expected)
{
    with_line(number, line);
    refuse_bytes(text, strlen(text), expected);
}

static void set(const char *setting)
{
    with_line(0, NULL);
    scenario_free(scenario);
    scenario =
        scenario_parse("f.yaml", text, strlen(text), &setting, 1, VERTICES, error, sizeof error);
}

static void accept_setting(const char *setting)
{
    set(setting);
    TEST_ASSERT_NOT_NULL_MESSAGE(scenario, error);
}

static void refuse_setting(const char *setting, const char *expected)
{
    char line[256];

    set(setting);
    TEST_ASSERT_NULL_MESSAGE(scenario, setting);
    snprintf(line, sizeof line, "<--set %s>:%s", setting, expected);
    error[strlen(line) < sizeof error ? strlen(line) : 0] = '\0';
    TEST_ASSERT_EQUAL_STRING(line, error);
}

static void assert_near(double expected, double value)
{
    TEST_ASSERT_TRUE(fabs(value - expected) < 1e-12);
}

static void test_what_a_file_says(void)
{
    accept(with_line(0, NULL));
    TEST_ASSERT_EQUAL_STRING("fleet", scenario->name);
    assert_near(30, scenario->duration);
    TEST_ASSERT_EQUAL_UINT(3, scenario->robot_count);
    TEST_ASSERT_EQUAL_UINT(7, scenario->robots[2].id);
    TEST_ASSERT_TRUE(scenario->robots[1].candidate);
    TEST_ASSERT_FALSE(scenario->robots[2].candidate);
    assert_near(2, scenario->robots[1].x);
    assert_near(1, scenario->robots[1].y);
    assert_near(M_PI / 2, scenario->robots[1].theta);
    assert_near(-M_PI, trajectory_start(scenario->trajectory).theta);
    assert_near(1.5, trajectory_start(scenario->trajectory).v);
    TEST_ASSERT_EQUAL_UINT(2, scenario->formation_count);
    TEST_ASSERT_EQUAL_STRING("G2", scenario->formations[1].name);
    TEST_ASSERT_EQUAL_UINT(3, scenario->formations[1].count);
    assert_near(-3, scenario->formations[1].L[2]);
    assert_near(M_PI / 2, scenario->formations[1].psi[2]);
    TEST_ASSERT_EQUAL_UINT(0, scenario->formation);
    TEST_ASSERT_EQUAL_UINT(1, scenario->event_count);
}

static void test_what_it_leaves_out(void)
{
    accept(with_line(0, NULL));
    TEST_ASSERT_EQUAL_INT(BODY_IDEAL, scenario->body);
    assert_near(0, scenario->scatter);
    assert_near(1, scenario->range);
    assert_near(0, scenario->loss);
    assert_near(0, scenario->delay);
    TEST_ASSERT_EQUAL_INT(ASSIGN_CPA, scenario->allocation);
    TEST_ASSERT_EQUAL_INT(LAW_FL, scenario->law);
    assert_near(1, scenario->k);
    assert_near(3, scenario->k_theta);
    assert_near(4, scenario->v_max);
    assert_near(10, scenario->omega_max);
}

static void test_choices(void)
{
    accept_setting("allocation=optimal");
    TEST_ASSERT_EQUAL_INT(ASSIGN_OPTIMAL, scenario->allocation);
    accept_setting("allocation=cpa-literal");
    TEST_ASSERT_EQUAL_INT(ASSIGN_CPA_LITERAL, scenario->allocation);
    accept_setting("allocation=rigid");
    TEST_ASSERT_EQUAL_INT(ASSIGN_RIGID, scenario->allocation);
    accept_setting("motion.law=pid");
    TEST_ASSERT_EQUAL_INT(LAW_PID, scenario->law);
    accept_setting("motion.law=kanayama");
    TEST_ASSERT_EQUAL_INT(LAW_KANAYAMA, scenario->law);
    accept_setting("body=small");
    TEST_ASSERT_EQUAL_INT(BODY_SMALL, scenario->body);
    assert_near(0.1, scenario->scatter);
}

/* Also where the file has it before the body. */
static void test_scatter_is_the_small_bodys(void)
{
    accept(with_line(2, "name: fleet\nscatter: 0\nbody: small"));
    assert_near(0, scenario->scatter);
    accept(with_line(2, "name: fleet\nscatter: 0.3\nbody: small"));
    assert_near(0.3, scenario->scatter);
    accept(with_line(2, "name: fleet\nscatter: 0"));
    assert_near(0, scenario->scatter);
    refuse_line(2, "name: fleet\nscatter: 0.1",
                "f.yaml:3:10: error: scatter is 0.1, but ideal robots are all alike; 0 is allowed");
}

static void test_every_number_may_be_an_expression(void)
{
    accept_setting("duration=2*15+0.5");
    assert_near(30.5, scenario->duration);
    accept_setting("robots.2.id=1e2+i");
    TEST_ASSERT_EQUAL_UINT(103, scenario->robots[2].id);
    accept_setting("robots.1.pose.0=i^2");
    assert_near(4, scenario->robots[1].x);
    accept_setting("formations.G1.L.2=1.5*i");
    assert_near(4.5, scenario->formations[0].L[2]);
    accept_setting("events.0.at=min(7, 9)");
    TEST_ASSERT_EQUAL_INT(350, scenario->events[0].at_tick);
}

static const char rules[] =
    "schema: 1\n"
    "name: wide\n"
    "duration: 60\n"
    "robots: {count: 100, pose: [i-50, 0, pi/2], candidates: \"45..55\"}\n"
    "trajectory: {start: [0, 5.45, pi/2], v: 0.5, omega: 0}\n"
    "formations:\n"
    "  wide: {count: 100, L: 1.004*abs(i-50), psi: \"i<=50 ? 37*pi/70 : -37*pi/70\"}\n"
    "formation: wide\n";

static void test_rules(void)
{
    accept(rules);
    TEST_ASSERT_EQUAL_UINT(100, scenario->robot_count);
    for (size_t i = 0; i < 100; i++) {
        TEST_ASSERT_EQUAL_UINT(i + 1, scenario->robots[i].id);
        TEST_ASSERT_EQUAL_INT(i + 1 >= 45 && i + 1 <= 55, scenario->robots[i].candidate);
        assert_near((double)i - 49, scenario->robots[i].x);
        assert_near(M_PI / 2, scenario->robots[i].theta);
    }
    assert_near(1.004 * 49, scenario->formations[0].L[0]);
    assert_near(0, scenario->formations[0].L[49]);
    assert_near(37 * M_PI / 70, scenario->formations[0].psi[49]);
    assert_near(-37 * M_PI / 70, scenario->formations[0].psi[50]);
}

static void assert_candidates(const char *candidates, const char *expected)
{
    char setting[64], got[8] = "";

    snprintf(setting, sizeof setting, "robots.candidates=%s", candidates);
    scenario_free(scenario);
    scenario = scenario_parse("f.yaml", rules, sizeof rules - 1, (const char *const[]){setting}, 1,
                              VERTICES, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(scenario, error);
    for (size_t i = 0; i < 6; i++)
        got[i] = scenario->robots[i].candidate ? 'x' : '-';
    TEST_ASSERT_EQUAL_STRING(expected, got);
}

static void test_sets_of_candidates(void)
{
    assert_candidates("2", "-x----");
    assert_candidates("1, 3..5", "x-xxx-");
    assert_candidates("2..2, 6", "-x---x");
    assert_candidates("2*2 .. 5", "---xx-");
}

static void test_fewer_vertices_than_robots(void)
{
    accept(with_line(10, "  G1: {L: [0], psi: [0]}"));
    TEST_ASSERT_EQUAL_UINT(1, scenario->formations[0].count);
}

static void test_actions(void)
{
    accept(with_line(14, "  - {at: 1, revive: 7}\n"
                         "  - {at: 2, stall: 1}\n"
                         "  - {at: 3, mute: leader}\n"
                         "  - {at: 4, unmute: 2}\n"
                         "  - {at: 5, formation: G2}\n"
                         "  - {at: 6, loss: 0.2}\n"
                         "  - {at: 7, delay: 0.05}\n"
                         "  - {at: 8, range: 3}\n"
                         "  - {at: 9, partition: [[1, 7]]}\n"
                         "  - {at: 10, heal: true}\n"
                         "  - {at: 11, estop: }\n"
                         "  - {at: 12, drain: 2}\n"));
    static const enum event_action actions[] = {
        EVENT_REVIVE, EVENT_STALL, EVENT_MUTE,      EVENT_UNMUTE, EVENT_FORMATION, EVENT_LOSS,
        EVENT_DELAY,  EVENT_RANGE, EVENT_PARTITION, EVENT_HEAL,   EVENT_ESTOP,     EVENT_DRAIN,
    };
    const struct event *events = scenario->events;

    TEST_ASSERT_EQUAL_UINT(12, scenario->event_count);
    for (size_t i = 0; i < 12; i++) {
        TEST_ASSERT_EQUAL_INT(actions[i], events[i].action);
        TEST_ASSERT_EQUAL_INT(50 * (i + 1), events[i].at_tick);
        TEST_ASSERT_TRUE(events[i].when == NULL);
    }
    TEST_ASSERT_EQUAL_UINT(7, events[0].robot);
    TEST_ASSERT_EQUAL_UINT(EVENT_LEADER, events[2].robot);
    TEST_ASSERT_EQUAL_UINT(1, events[4].formation);
    assert_near(0.2, events[5].value);
    assert_near(3, events[7].value);
}

static void test_groups_of_a_partition(void)
{
    accept(with_line(14, "  - {at: 1, partition: [[7], [1]]}\n"
                         "  - {at: 2, partition: [\"1..2\"]}\n"));
    const uint16_t *groups = scenario->events[0].groups;

    TEST_ASSERT_EQUAL_UINT(2, groups[0]);
    TEST_ASSERT_EQUAL_UINT(0, groups[1]);
    TEST_ASSERT_EQUAL_UINT(1, groups[2]);
    groups = scenario->events[1].groups;
    TEST_ASSERT_EQUAL_UINT(1, groups[0]);
    TEST_ASSERT_EQUAL_UINT(1, groups[1]);
    TEST_ASSERT_EQUAL_UINT(0, groups[2]);
}

static void test_event_waits_for_a_tick(void)
{
    static const struct {
        const char *setting;
        int tick;
    } cases[] = {
        {"events.0.at=0", 0},     {"events.0.at=0.001", 1},    {"events.0.at=0.02", 1},
        {"events.0.at=0.021", 2}, {"events.0.at=0.3", 15},     {"events.0.at=1.1", 55},
        {"events.0.at=30", 1500}, {"events.0.at=0.1+0.2", 15},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        accept_setting(cases[i].setting);
        TEST_ASSERT_EQUAL_INT_MESSAGE(cases[i].tick, scenario->events[0].at_tick, cases[i].setting);
    }
}

static bool holds(double t, double x, double y, double theta)
{
    const struct event *event = &scenario->events[0];
    const struct event_view view = {t, x, y, theta};

    return event->when(event->condition, &view);
}

static void test_conditions(void)
{
    accept(with_line(14, "  - {when: \"leader.y >= 1\", formation: G2}"));
    TEST_ASSERT_FALSE(holds(0, 5, 0.999, 0));
    TEST_ASSERT_TRUE(holds(0, 0, 1, 0));
    accept(with_line(14, "  - {when: \"t > 3 && leader.x < leader.theta\", formation: G2}"));
    TEST_ASSERT_FALSE(holds(3, 0, 0, 1));
    TEST_ASSERT_TRUE(holds(3.02, 0, 0, 1));
    TEST_ASSERT_FALSE(holds(3.02, 1, 0, 1));
}

static void test_condition_without_a_value_does_not_hold(void)
{
    accept(with_line(14, "  - {when: \"1/leader.x\", formation: G2}"));
    TEST_ASSERT_FALSE(holds(0, 0, 0, 0));
    TEST_ASSERT_TRUE(holds(0, 2, 0, 0));
    accept(with_line(14, "  - {when: \"sqrt(leader.x)\", formation: G2}"));
    TEST_ASSERT_FALSE(holds(0, -1, 0, 0));
    refuse_line(14, "  - {when: 1/0, formation: G2}", "f.yaml:14:12: error: when is inf;");
}

/* What issue and contract name: file, line, column and reason. */
static void test_unknown_keys(void)
{
    refuse_line(3, "duratoin: 30",
                "f.yaml:3:1: error: unknown key 'duratoin', perhaps 'duration'; schema, name,");
    refuse_line(7, "  - {id: 7, poes: [-2, -1, 0]}",
                "f.yaml:7:13: error: unknown key 'poes', perhaps 'pose'; id, pose, candidate are");
    refuse_line(8, "trajectory: {start: [0, 0, 0], v: 1, omega: 0, w: 1}",
                "f.yaml:8:48: error: unknown key 'w'; start, v, omega are allowed");
    refuse_line(14, "  - {at: 10, kil: leader}",
                "f.yaml:14:14: error: unknown key 'kil', perhaps 'kill'; at, when, kill, revive");
    refuse_line(14, "  - {at: 10, explode: leader}",
                "f.yaml:14:14: error: unknown key 'explode'; at, when, kill,");
}

static void test_duplicate_keys(void)
{
    refuse_line(3, "duration: 30\nduration: 31",
                "f.yaml:4:1: error: 'duration' stands here twice, first in line 3;");
    refuse_line(11, "  G1: {L: [0], psi: [0]}", "f.yaml:11:3: error: 'G1' stands here twice,");
}

static void test_missing_keys(void)
{
    static const struct {
        size_t line;
        const char *expected;
    } cases[] = {
        {1, "f.yaml:2:1: error: the key 'schema' is missing;"},
        {2, "f.yaml:1:1: error: the key 'name' is missing;"},
        {3, "f.yaml:1:1: error: the key 'duration' is missing;"},
        {8, "f.yaml:1:1: error: the key 'trajectory' is missing;"},
        {12, "f.yaml:1:1: error: the key 'formation' is missing;"},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        refuse_line(cases[i].line, "", cases[i].expected);
    refuse_line(5, "  - {pose: [0, 0, 0]}", "f.yaml:5:5: error: the key 'id' is missing;");
    refuse_line(5, "  - {id: 1}", "f.yaml:5:5: error: the key 'pose' is missing;");
    refuse_line(8, "trajectory: {v: 1, omega: 0}",
                "f.yaml:8:13: error: the key 'start' is missing; start, v, omega are allowed");
    refuse_line(10, "  G1: {L: [0]}", "f.yaml:10:7: error: the key 'psi' is missing;");
}

static void test_two_vertices_in_one_place(void)
{
    refuse_line(10, "  G1: {L: [0, 2, 2], psi: [0, pi, -pi]}",
                "f.yaml:10:7: error: vertices 2 and 3 of G1 are in one place; more than 10 mm");
    refuse_line(11, "  G2: {L: [0, 2, -2.009], psi: [0, 0, pi]}",
                "f.yaml:11:7: error: vertices 2 and 3 of G2 are in one place;");
    refuse_line(11, "  G2: {L: [0.01, 0, 2], psi: [0, 0, pi]}",
                "f.yaml:11:7: error: vertices 1 and 2 of G2 are in one place;");
    accept(with_line(10, "  G1: {L: [0, 2, 2.0101], psi: [0, 0, 0]}"));
}

static void test_one_vertex_is_the_leaders(void)
{
    refuse_line(10, "  G1: {L: [1, 2, 3], psi: [0, 0, 0]}",
                "f.yaml:10:7: error: no vertex has L = 0; exactly one,");
    refuse_line(10, "  G1: {L: [1, 0, 0], psi: [0, 0, 0]}",
                "f.yaml:10:7: error: vertices 2 and 3 both have L = 0;");
}

static void test_more_vertices_than_robots(void)
{
    refuse_line(10, "  G1: {L: [0, 1, 2, 3], psi: [0, 0, 0, 0]}",
                "f.yaml:10:11: error: more vertices than robots: 4 for 3;");
    refuse_line(10, "  G1: {count: 4, L: i-1, psi: 0}",
                "f.yaml:10:15: error: more vertices than robots: 4 for 3;");
}

static void test_more_vertices_than_fit(void)
{
    with_line(0, NULL);
    scenario = scenario_parse("f.yaml", text, strlen(text), NULL, 0, 2, error, sizeof error);
    TEST_ASSERT_NULL(scenario);
    TEST_ASSERT_EQUAL_STRING("f.yaml:10:11: error: 3 vertices; the robots have room for 2", error);
}

static void test_lists_of_unequal_length(void)
{
    refuse_line(10, "  G1: {L: [0, 2, 2], psi: [0, 1]}",
                "f.yaml:10:27: error: psi holds 2 numbers; 3 are allowed");
    refuse_line(5, "  - {id: 1, pose: [0, 0], candidate: true}",
                "f.yaml:5:19: error: pose holds 2 numbers; [x, y, theta] is allowed");
}

static void test_robot_twice(void)
{
    refuse_line(7, "  - {id: 2, pose: [-2, -1, 0]}",
                "f.yaml:7:10: error: two robots with the id 2;");
}

static void test_no_candidate(void)
{
    static const char list[] = "schema: 1\n"
                               "name: fleet\n"
                               "duration: 30\n"
                               "robots:\n"
                               "  - {id: 1, pose: [0, 0, 0]}\n"
                               "  - {id: 2, pose: [1, 0, 0], candidate: false}\n"
                               "trajectory: {start: [0, 0, 0], v: 0, omega: 0}\n"
                               "formations: {G1: {L: [0], psi: [0]}}\n"
                               "formation: G1\n";

    refuse_bytes(list, sizeof list - 1, "f.yaml:5:3: error: no robot may lead; at least one");
}

static void test_values_out_of_range(void)
{
    refuse_line(3, "duration: -1",
                "f.yaml:3:11: error: duration is -1; a number from 0 to 86400 s is allowed");
    refuse_setting("duration=86400.1", "1:10: error: duration is 86400.1; a number");
    refuse_setting("robots.0.id=0", "1:13: error: id is 0; a whole number from 1 to 65534");
    refuse_setting("robots.0.id=65535", "1:13: error: id is 65535;");
    refuse_setting("robots.0.id=1.5", "1:13: error: id is 1.5;");
    refuse_setting("robots.0.id=100abc", "1:13: error: id is '100abc', no number");
    refuse_setting("robots.0.pose.0=2098", "1:17: error: the value is 2098;");
    refuse_setting("robots.0.pose.2=10001", "1:17: error: the value is 10001;");
    refuse_setting("formations.G1.L.1=2001", "1:19: error: the value is 2001;");
    refuse_setting("network.loss=1.01", "1:14: error: loss is 1.01; a number from 0 to 1 is");
    refuse_setting("network.delay=11", "1:15: error: delay is 11;");
    refuse_setting("network.range=-1", "1:15: error: range is -1;");
    refuse_setting("motion.k=0", "1:10: error: k is 0; a number above 0 up to 255 1/s");
    refuse_setting("motion.k_theta=256", "1:16: error: k_theta is 256;");
    refuse_setting("motion.v_max=6.1", "1:14: error: v_max is 6.1;");
    refuse_setting("motion.omega_max=30.1", "1:18: error: omega_max is 30.1;");
    refuse_setting("events.0.at=86401", "1:13: error: at is 86401; a number from 0 to 8640");
    refuse_setting("network.loss=1/0", "1:14: error: loss is inf;");
    refuse_setting("network.loss=sqrt(-1)", "1:14: error: loss is undefined;");
    refuse_line(2, "name: fleet\nbody: small\nscatter: 0.31",
                "f.yaml:4:10: error: scatter is 0.31; a number from 0 to 0.3 is allowed");
    refuse_setting("schema=2", "1:8: error: schema is 2; 1 is allowed");
}

static void test_values_of_the_wrong_kind(void)
{
    refuse_setting("network.loss=", "1:14: error: loss is empty;");
    refuse_setting("robots.0.candidate=yes",
                   "1:20: error: candidate is 'yes'; allowed: false, true");
    refuse_setting("body=large", "1:6: error: body is 'large'; allowed: ideal, small");
    refuse_setting("allocation=greedy", "1:12: error: allocation is 'greedy'; allowed: cpa, cpa-l");
    refuse_setting("motion.law=lqr", "1:12: error: law is 'lqr'; allowed: fl, kanayama, pid");
    refuse_setting("formation=G3", "1:11: error: no formation is called 'G3'; allowed: G1, G2");
    refuse_setting("robots=4", "1:8: error: robots is a single value; a list of {id,");
    refuse_line(3, "duration: [30]", "f.yaml:3:11: error: duration is a list [...]; a single");
    refuse_line(8, "trajectory:", "f.yaml:8:1: error: trajectory is empty; a mapping");
    refuse_line(10, "  G1: {L: i-1, psi: 0}", "f.yaml:10:11: error: L is no list, and there is no");
}

static void test_names_are_fit_for_a_directory(void)
{
    accept_setting("name=a_B-1.2");
    refuse_setting("name=", "1:6: error: name is ''; 1 to 100 letters,");
    refuse_setting("name=..", "1:6: error: name is '..';");
    refuse_setting("name=a/b", "1:6: error: name is 'a/b';");
    refuse_setting("name=-x", "1:6: error: name is '-x';");
    refuse_setting("name=a b", "1:6: error: name is 'a b';");
}

static void test_expressions_that_are_none(void)
{
    refuse_setting("trajectory.v=t=5", "1:14: error: v is 't=5', no number or expression: an as");
    refuse_setting("trajectory.v=1,2", "1:14: error: v is '1,2', no number or expression: a com");
    refuse_setting("trajectory.v=i", "1:14: error: v is 'i', no number or expression: 'i' has");
    refuse_setting("network.loss=t", "1:14: error: loss is 't',");
    refuse_setting("robots.0.pose.0=t", "1:17: error: the value is 't',");
    refuse_line(14, "  - {when: leader.z > 1, heal: true}",
                "f.yaml:14:12: error: when is 'leader.z > 1', no number or expression: 'leader.z'");
}

static void test_trajectories_that_leave_the_wire(void)
{
    accept_setting("trajectory.v=8.19");
    refuse_setting("trajectory.v=8.2", "1:14: error: v is 8.2 at t = 0 s; a number from -8.19");
    refuse_setting("trajectory.v=t/3", "1:14: error: v is 8.193333333 at t = 24.58 s;");
    refuse_setting("trajectory.v=0*1/(t-20)", "1:14: error: v is undefined at t = 20 s;");
    refuse_setting("trajectory.omega=1/(t-30)", "1:18: error: omega is -50 at t = 29.98 s;");
    refuse_setting("trajectory.omega=t < 30 ? 0 : 1/0", "1:18: error: omega is inf at t = 30 s;");
    refuse_setting("trajectory.v=sqrt(29-t)", "1:14: error: v is undefined at t = 29.02 s;");
    refuse_line(8, "trajectory: {start: [2090.51, 0, 0], v: 1, omega: 0}",
                "f.yaml:8:13: error: the reference is at (2097.01, 0) m at t = 6.5 s;");
    /* Between two ticks, where the integration looks as well. */
    refuse_line(8, "trajectory: {start: [0, 0, 0], v: 1e-6/abs(t-0.01), omega: 0}",
                "f.yaml:8:13: error: the reference is at (");
}

static void test_duration_of_nothing(void)
{
    accept(with_line(14, "  - {at: 0, kill: leader}"));
    with_line(3, "duration: 0");
    strcpy(strstr(text, "events:"), "");
    accept(text);
    assert_near(0, scenario->duration);
}

static void test_events_that_are_none(void)
{
    refuse_line(14, "  - {kill: leader}",
                "f.yaml:14:5: error: neither 'at' nor 'when' in one event;");
    refuse_line(14, "  - {at: 1, when: t > 1, kill: 1}",
                "f.yaml:14:5: error: both 'at' and 'when'");
    refuse_line(14, "  - {at: 1}", "f.yaml:14:5: error: nothing happens;");
    refuse_line(14, "  - {at: 1, kill: 1, stall: 2}",
                "f.yaml:14:22: error: 'stall' beside 'kill' in one event;");
    refuse_line(14, "  - {at: 1, kill: 3}", "f.yaml:14:19: error: no robot has the id 3;");
    refuse_line(14, "  - {at: 1, kill: all}", "f.yaml:14:19: error: kill is 'all', no number");
    refuse_line(14, "  - {at: 1, formation: G9}",
                "f.yaml:14:24: error: no formation is called 'G9'");
    refuse_line(14, "  - {at: 1, loss: 2}", "f.yaml:14:19: error: loss is 2;");
    refuse_line(14, "  - {at: 1, estop: false}", "f.yaml:14:20: error: estop takes no value;");
    refuse_line(14, "  - {at: 1, partition: [[1, 2], [2]]}",
                "f.yaml:14:34: error: robot 2 is named twice;");
    refuse_line(14, "  - {at: 1, partition: [[1, 3]]}",
                "f.yaml:14:29: error: no robot has the id 3");
    refuse_line(14, "  - {at: 1, partition: []}", "f.yaml:14:24: error: no group;");
}

static void test_candidates_that_are_none(void)
{
    static const struct {
        const char *setting, *expected;
    } cases[] = {
        {"robots.candidates=101", "candidates is 101; a whole number from 1 to 100"},
        {"robots.candidates=5..4", "5..4 runs backwards;"},
        {"robots.candidates=1,1", "robot 1 is named twice;"},
        {"robots.candidates=", "candidates is empty;"},
        {"robots.candidates=1..", "candidates is empty;"},
        {"robots.count=0", "count is 0; a whole number from 1 to 65534"},
    };

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        scenario = scenario_parse("f.yaml", rules, sizeof rules - 1, &cases[i].setting, 1, VERTICES,
                                  error, sizeof error);
        TEST_ASSERT_NULL(scenario);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, cases[i].expected), error);
    }
}

static void test_settings(void)
{
    accept_setting("network.loss=0.2");
    assert_near(0.2, scenario->loss);
    assert_near(1, scenario->range);
    accept_setting("motion.k=2");
    assert_near(2, scenario->k);
    accept_setting("formation=G2");
    TEST_ASSERT_EQUAL_UINT(1, scenario->formation);
    accept_setting("trajectory.v=0.5+t/100");
    assert_near(0.5, trajectory_start(scenario->trajectory).v);
    accept_setting("robots.2.candidate=true");
    TEST_ASSERT_TRUE(scenario->robots[2].candidate);
    accept_setting("events.0.at=5");
    TEST_ASSERT_EQUAL_INT(250, scenario->events[0].at_tick);
}

static void test_later_settings_win(void)
{
    const char *const settings[] = {"duration=5", "duration=40"};

    with_line(0, NULL);
    scenario =
        scenario_parse("f.yaml", text, strlen(text), settings, 2, VERTICES, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(scenario, error);
    assert_near(40, scenario->duration);
}

static void test_settings_that_are_none(void)
{
    refuse_setting("duration", "1:1: error: no '=' in it; KEY.PATH=VALUE is allowed");
    refuse_setting("=5", "1:1: error: an empty key;");
    refuse_setting("network.=5", "1:9: error: an empty key;");
    refuse_setting("network.los=1", "1:9: error: unknown key 'los', perhaps 'loss'; range, loss,");
    refuse_setting("network=5", "1:9: error: network is a single value; a mapping of keys");
    refuse_setting("duration.x=5", "1:10: error: 'x' in what is a single value");
    refuse_setting("robots.3.id=5", "1:8: error: '3' in a list; an index from 0 to 2 is allowed");
    refuse_setting("robots.x.id=5", "1:8: error: 'x' in a list;");
    refuse_setting("robots.-1.id=5", "1:8: error: '-1' in a list;");
}

static void test_setting_that_is_no_text(void)
{
    set("duration=\x01");
    TEST_ASSERT_NULL(scenario);
    TEST_ASSERT_EQUAL_STRING("<--set duration= >:1:1: error: not text; UTF-8 is allowed", error);
}

static void test_yaml_that_is_none(void)
{
    refuse_line(7, "  - {id: 7, pose: [-2, -1, 0}", "f.yaml:");
    refuse_line(3, "duration: \"30", "f.yaml:");
    refuse_line(3, "duration: a: b", "f.yaml:3:");
    refuse_line(3, "\tduration: 30", "f.yaml:");
    refuse_line(3, "duration: &d 30", "f.yaml:3:14: error: anchors and aliases are not allowed");
    refuse_line(3, "duration: *d", "f.yaml:3:11: error: anchors and aliases are not allowed");
    refuse_line(3, "duration: !!int 30", "f.yaml:3:17: error: tags are not allowed");
    refuse_line(3, "[a, b]: 30", "f.yaml:3:1: error: a key is a single word");
    refuse_line(3, "duration: \"\\0\"", "f.yaml:3:11: error: a control character;");
    refuse_line(3, "duration: 30\n---\nschema: 1", "f.yaml:");
    refuse_line(3, "x: [[[[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]]]",
                "f.yaml:3:19: error: nested too deep; 16 levels are allowed");
}

static void test_files_that_are_no_scenario(void)
{
    static char large[1024 * 1024 + 1];

    refuse_bytes("", 0, "f.yaml:1:1: error: nothing in it;");
    refuse_bytes("# nothing\n", 10, "f.yaml:2:1: error: nothing in it;");
    refuse_bytes("42", 2, "f.yaml:1:1: error: the value is a single value; a mapping");
    refuse_bytes("[1, 2]", 6, "f.yaml:1:1: error: the value is a list [...]; a mapping");
    refuse_bytes("\x7F"
                 "ELF\2\1\1\0\0\0",
                 10, "f.yaml:1:1: error: not text: byte 0x7F;");
    refuse_bytes("a: 1\nb: \0", 9, "f.yaml:2:4: error: not text: byte 0x00;");
    refuse_bytes("a: \xFF\xFE", 5, "f.yaml:1:4: error: not text: byte 0xFF;");
    memset(large, ' ', sizeof large);
    refuse_bytes(large, sizeof large, "f.yaml:1:1: error: longer than the 1048576 bytes allowed");
}

static void test_files_that_cannot_be_read(void)
{
    scenario = scenario_read("/no/such/file.yaml", NULL, 0, VERTICES, error, sizeof error);
    TEST_ASSERT_NULL(scenario);
    TEST_ASSERT_EQUAL_STRING("/no/such/file.yaml:1:1: error: cannot be opened: No such file or "
                             "directory",
                             error);
    scenario = scenario_read("/", NULL, 0, VERTICES, error, sizeof error);
    TEST_ASSERT_NULL(scenario);
    TEST_ASSERT_EQUAL_STRING("/:1:1: error: cannot be read: Is a directory", error);
}

static void test_file_on_disk(void)
{
    char path[] = "/tmp/muster-scenario-XXXXXX";
    int file = mkstemp(path);
    const char *bytes = with_line(0, NULL);

    TEST_ASSERT_TRUE(file >= 0);
    TEST_ASSERT_TRUE(write(file, bytes, strlen(bytes)) == (ssize_t)strlen(bytes));
    close(file);
    scenario = scenario_read(path, NULL, 0, VERTICES, error, sizeof error);
    unlink(path);
    TEST_ASSERT_NOT_NULL_MESSAGE(scenario, error);
}

/* The last bytes of a text are where parsers trip. */
static void test_files_cut_short(void)
{
    with_line(0, NULL);
    size_t length = strlen(text);

    for (size_t cut = 0; cut < length; cut++) {
        char *copy = malloc(cut + 1);
        TEST_ASSERT_NOT_NULL(copy);
        memcpy(copy, text, cut);
        parse_bytes(copy, cut);
        free(copy);
        TEST_ASSERT_TRUE(scenario != NULL || strncmp(error, "f.yaml:", 7) == 0);
    }
}

static void test_short_room_for_the_error(void)
{
    char room[12] = "untouched";

    scenario = scenario_parse("f.yaml", "", 0, NULL, 0, VERTICES, room, sizeof room);
    TEST_ASSERT_NULL(scenario);
    TEST_ASSERT_EQUAL_STRING("f.yaml:1:1:", room);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_a_file_says);
    RUN_TEST(test_what_it_leaves_out);
    RUN_TEST(test_choices);
    RUN_TEST(test_scatter_is_the_small_bodys);
    RUN_TEST(test_every_number_may_be_an_expression);
    RUN_TEST(test_rules);
    RUN_TEST(test_sets_of_candidates);
    RUN_TEST(test_fewer_vertices_than_robots);
    RUN_TEST(test_actions);
    RUN_TEST(test_groups_of_a_partition);
    RUN_TEST(test_event_waits_for_a_tick);
    RUN_TEST(test_conditions);
    RUN_TEST(test_condition_without_a_value_does_not_hold);
    RUN_TEST(test_unknown_keys);
    RUN_TEST(test_duplicate_keys);
    RUN_TEST(test_missing_keys);
    RUN_TEST(test_two_vertices_in_one_place);
    RUN_TEST(test_one_vertex_is_the_leaders);
    RUN_TEST(test_more_vertices_than_robots);
    RUN_TEST(test_more_vertices_than_fit);
    RUN_TEST(test_lists_of_unequal_length);
    RUN_TEST(test_robot_twice);
    RUN_TEST(test_no_candidate);
    RUN_TEST(test_values_out_of_range);
    RUN_TEST(test_values_of_the_wrong_kind);
    RUN_TEST(test_names_are_fit_for_a_directory);
    RUN_TEST(test_expressions_that_are_none);
    RUN_TEST(test_trajectories_that_leave_the_wire);
    RUN_TEST(test_duration_of_nothing);
    RUN_TEST(test_events_that_are_none);
    RUN_TEST(test_candidates_that_are_none);
    RUN_TEST(test_settings);
    RUN_TEST(test_later_settings_win);
    RUN_TEST(test_settings_that_are_none);
    RUN_TEST(test_setting_that_is_no_text);
    RUN_TEST(test_yaml_that_is_none);
    RUN_TEST(test_files_that_are_no_scenario);
    RUN_TEST(test_files_that_cannot_be_read);
    RUN_TEST(test_file_on_disk);
    RUN_TEST(test_files_cut_short);
    RUN_TEST(test_short_room_for_the_error);
    return UNITY_END();
}
