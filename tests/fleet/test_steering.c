/* What those who look on do to a run in virtual time, through a view and by its protocol. */
#include "fleet.h"

#include "viewed.h"

#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

#define TEAM                                                                                       \
    "schema: 1\nname: team\nduration: 15\n"                                                        \
    "robots: {count: 6, pose: [\"-i/2\", \"i/4\", 0], candidates: \"1..2\"}\n"                     \
    "network: {range: 3}\n"                                                                        \
    "trajectory: {start: [0, 0, 0], v: 0.3, omega: 0}\n"                                           \
    "formations:\n"                                                                                \
    "  file: {count: 6, L: \"0.5*(i-1)\", psi: pi}\n"                                              \
    "formation: file\n"

static struct viewed viewed;
static struct client client;
static unsigned asked;

/* What is asked for, in its order, each at the first tick at or after its moment. */
struct wish {
    double t;
    const char *request;
};

static const struct wish *wishes;

void setUp(void)
{
    viewed_open(&viewed, SIM_ACTS);
    viewed_join(&viewed, &client);
    asked = 0;
    wishes = NULL;
}

void tearDown(void)
{
    client_close(&client);
    viewed_close(&viewed);
}

/* It waits until the view has it, so that the run does what is asked for before the next tick. */
static void ask(const char *request)
{
    struct pollfd acts = {.fd = view_descriptor(viewed.view), .events = POLLIN};

    viewed_ask(&viewed, &client, ++asked, request);
    TEST_ASSERT_EQUAL_INT(1, poll(&acts, 1, 20000));
}

static void wish(void *watcher, const struct sim_tick *tick)
{
    (void)watcher;
    for (; wishes != NULL && wishes->request != NULL && tick->t >= wishes->t - 1e-9; wishes++)
        ask(wishes->request);
}

static struct fleet_result run_to(const char *out, const struct wish *those, enum sim_end end)
{
    wishes = those;
    return fleet_run(&(struct fleet_run){.text = TEAM,
                                         .robots = SIM_NATIVE,
                                         .out = out,
                                         .view = viewed.view,
                                         .watch = wish,
                                         .end = end});
}

static struct fleet_result run(const char *out, const struct wish *those)
{
    return run_to(out, those, SIM_DONE);
}

/* The answer to the next request: NULL or words of its refusal. */
static void expect_answer(unsigned number, const char *refusal)
{
    char begin[64], text[1024];

    snprintf(begin, sizeof begin, "{\"answer\":{\"number\":%u,\"refused\":%s", number,
             refusal == NULL ? "null" : "\"");
    do
        viewed_text(&client, text, sizeof text);
    while (strncmp(text, "{\"answer\"", 9) != 0);
    TEST_ASSERT_EQUAL_INT_MESSAGE(0, strncmp(text, begin, strlen(begin)), text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, refusal == NULL ? "null" : refusal), text);
}

/* Sooner or later. */
static void expect_status(const char *words)
{
    char text[1024];

    do
        viewed_text(&client, text, sizeof text);
    while (strncmp(text, "{\"status\"", 9) != 0 || strstr(text, words) == NULL);
}

static bool logged(const char *out, const char *row)
{
    char path[256], line[256];
    bool found = false;

    snprintf(path, sizeof path, "%s/events.csv", out);
    FILE *events = fopen(path, "r");
    TEST_ASSERT_NOT_NULL(events);
    while (fgets(line, sizeof line, events) != NULL)
        found |= strstr(line, row) != NULL;
    fclose(events);
    return found;
}

static void looking_on_changes_nothing(void)
{
    fleet_run(&(struct fleet_run){.text = TEAM, .robots = SIM_NATIVE, .out = "alone"});
    run("looked_at", NULL);
    fleet_same_files("alone", "looked_at");
}

static void a_pause_changes_nothing(void)
{
    static const struct wish those[] = {
        {5, "\"pause\""},
        {5, "\"step\""},
        {5.02, "\"step\""},
        {5.04, "\"speed\",\"speed\":500"},
        {5.04, "\"resume\""},
        {8, "\"speed\",\"speed\":0"},
        {0, NULL},
    };

    fleet_run(&(struct fleet_run){.text = TEAM, .robots = SIM_NATIVE, .out = "alone"});
    run("paused", those);
    fleet_same_files("alone", "paused");
    for (unsigned number = 1; number <= 6; number++)
        expect_answer(number, NULL);
}

static void a_drawn_formation_is_taken(void)
{
    static const struct wish those[] = {
        {5, "\"draw\",\"name\":\"wedge\",\"L\":[0.7,0.7,0,1.4,1.4],"
            "\"psi\":[2.4,-2.4,0,2.4,-2.4]"},
        {0, NULL},
    };
    struct fleet_result result = run("drawn", those);

    expect_answer(1, NULL);
    expect_status("\"over\":true,\"speed\":0.0,\"formations\":[\"file\",\"wedge\"]");
    TEST_ASSERT_TRUE(logged("drawn", "5.00,0,draw,wedge"));
    TEST_ASSERT_TRUE(logged("drawn", "5.00,0,formation,"));
    TEST_ASSERT_TRUE(result.summary.metrics.complete);
    TEST_ASSERT_TRUE(result.summary.metrics.time_to_complete < 5);
    /* One is a spare, and keeps its place; the others' errors are of millimetres. */
    TEST_ASSERT_TRUE(result.summary.metrics.error_final < 0.5);
    FILE *trace = fleet_trace("drawn");
    struct fleet_row row;
    unsigned held = 0;
    while (fleet_next(trace, &row)) {
        if (row.t < 15)
            continue;
        held += row.vertex != 0;
        TEST_ASSERT_TRUE(row.vertex <= 5);
        TEST_ASSERT_TRUE(row.role != 'L' || row.vertex == 3);
        if (row.vertex != 0)
            TEST_ASSERT_DOUBLE_WITHIN(0.01, 0, row.error);
    }
    TEST_ASSERT_EQUAL_UINT(5, held);
}

static void a_leader_that_is_killed_is_replaced_within_a_second(void)
{
    static const struct wish those[] = {
        {5, "\"kill\",\"robot\":1"}, {9, "\"revive\",\"robot\":1"}, {0, NULL}};

    run("killed", those);
    TEST_ASSERT_EQUAL_DOUBLE(0, fleet_leads_at("killed", 1, 0));
    TEST_ASSERT_TRUE(logged("killed", "5.00,1,kill,"));
    TEST_ASSERT_TRUE(logged("killed", "9.00,1,revive,"));
    double led = fleet_leads_at("killed", 2, 5);
    TEST_ASSERT_TRUE(led > 5 && led < 6);
}

static void a_robot_that_is_dragged_off_comes_back(void)
{
    static const struct wish those[] = {
        {5, "\"move\",\"robot\":5,\"x\":3,\"y\":2.5,\"theta\":4"},
        {6, "\"move\",\"robot\":5,\"x\":2050,\"y\":0,\"theta\":0"},
        {7, "\"move\",\"robot\":9,\"x\":0,\"y\":0,\"theta\":0"},
        {0, NULL},
    };
    struct fleet_result result = run("dragged", those);
    struct fleet_row row;
    FILE *trace = fleet_trace("dragged");

    expect_answer(1, NULL);
    expect_answer(2, "2000 m");
    expect_answer(3, "robot 9 is not in this scenario: it has 1 to 6");
    while (fleet_next(trace, &row)) {
        if (row.robot != 5 || row.t < 5.01 || row.t > 5.03)
            continue;
        TEST_ASSERT_DOUBLE_WITHIN(0.1, 3, row.x);
        TEST_ASSERT_DOUBLE_WITHIN(0.1, 2.5, row.y);
    }
    TEST_ASSERT_TRUE(logged("dragged", "5.00,5,move,to 3.000 m 2.500 m -2.283 rad"));
    TEST_ASSERT_TRUE(result.summary.metrics.complete);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0, result.summary.metrics.error_final);
}

static void an_end_leaves_files_that_are_whole(void)
{
    static const struct wish those[] = {{5, "\"end\""}, {0, NULL}};
    struct fleet_result result = run_to("ended", those, SIM_INTERRUPTED);

    TEST_ASSERT_EQUAL_DOUBLE(5, result.summary.duration);
    TEST_ASSERT_TRUE(logged("ended", "5.00,0,stop,"));
    struct fleet_row row = {0};
    FILE *trace = fleet_trace("ended");
    while (fleet_next(trace, &row))
        ;
    TEST_ASSERT_EQUAL_DOUBLE(5, row.t);
    TEST_ASSERT_EQUAL_UINT(6, row.robot);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(looking_on_changes_nothing);
    RUN_TEST(a_pause_changes_nothing);
    RUN_TEST(a_drawn_formation_is_taken);
    RUN_TEST(a_leader_that_is_killed_is_replaced_within_a_second);
    RUN_TEST(a_robot_that_is_dragged_off_comes_back);
    RUN_TEST(an_end_leaves_files_that_are_whole);
    return UNITY_END();
}
