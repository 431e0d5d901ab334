/* Batteries that run low: a leader that says so and leads on until it is replaced, beside one that
 * dies at the moment at which the other one says it; followers that leave their vertices. */
#include "fleet.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define SEEDS 5

/* From the hand-over on, s. */
#define WINDOW 10

void setUp(void)
{
}
void tearDown(void)
{
}

/* A team whose robot 1 leads. */
struct team {
    const char *title;
    const char *robots; /* lines */
    const char *body, *trajectory, *formation;
};

static const char far_apart[] = "  - {id: 1, pose: [-2, 1, 0], candidate: true}\n"
                                "  - {id: 2, pose: [2, 1, 0], candidate: true}\n"
                                "  - {id: 3, pose: [-2, -1, 0]}\n"
                                "  - {id: 4, pose: [-2, -3, 0]}\n";
static const char near_by[] = "  - {id: 1, pose: [0, 0, 0], candidate: true}\n"
                              "  - {id: 2, pose: [-0.5, 0.6, 0], candidate: true}\n"
                              "  - {id: 3, pose: [-0.4, -0.5, 0]}\n"
                              "  - {id: 4, pose: [-1.1, 0.1, 0]}\n";
static const char curve[] = "{start: [0, 0, -pi], v: 1.5, omega: \"-0.2*tanh(0.1*(t-15))\"}";
static const char circle[] = "{start: [0, 0, 0], v: 0.3, omega: 0.15}";

static const struct team teams[] = {
    {"ideal, G1", far_apart, "ideal", curve, "{L: [0, 2, 2, 2], psi: [0, -pi/3, pi/3, pi]}"},
    {"ideal, G2", far_apart, "ideal", curve, "{L: [0, 3, 3, 3], psi: [0, 0, 2*pi/3, -2*pi/3]}"},
    {"small, Y", near_by, "small", circle, "{L: [0, 0.6, 0.6, 0.6], psi: [0, 0, 2*pi/3, -2*pi/3]}"},
    {"small, diamond", near_by, "small", circle,
     "{L: [0, 0.5, 1, 0.5], psi: [0, pi/2, pi, -pi/2]}"},
};

/* The trace and the events are in "last". */
static void run_team(const struct team *team, const char *event, uint64_t seed)
{
    char text[1024];

    snprintf(text, sizeof text,
             "schema: 1\nname: battery\nduration: 25\nrobots:\n%sbody: %s\nscatter: 0\n"
             "network: {range: 5, loss: 0.1}\ntrajectory: %s\n"
             "formations:\n  F: %s\nformation: F\nevents:\n  - %s\n",
             team->robots, team->body, team->trajectory, team->formation, event);
    fleet_run(&(struct fleet_run){.text = text, .robots = SIM_NATIVE, .seed = seed, .out = "last"});
}

/* When the server first hears that this robot's battery is spent, s; -1: never. */
static double told_at(unsigned robot)
{
    FILE *events = fopen("last/events.csv", "r");
    char line[256];
    double t, found = -1;
    unsigned id;

    TEST_ASSERT_NOT_NULL(events);
    while (found < 0 && fgets(line, sizeof line, events) != NULL)
        if (sscanf(line, "%lf,%u,", &t, &id) == 2 && id == robot &&
            strstr(line, "battery critical") != NULL)
            found = t;
    fclose(events);
    return found;
}

struct errors {
    double peak, integral; /* m, m s: mean of the robots that go on, for WINDOW */
};

static struct errors errors_from(double from)
{
    FILE *trace = fleet_trace("last");
    struct errors errors = {0, 0};
    struct fleet_row row;
    double sum = 0;

    while (fleet_next(trace, &row)) {
        if (row.robot == 1 || row.t < from || row.t >= from + WINDOW)
            continue;
        sum += row.error;
        if (row.robot != 4)
            continue;
        errors.peak = fmax(errors.peak, sum / 3);
        errors.integral += sum / 3 * 0.02;
        sum = 0;
    }
    return errors;
}

/* Both with the same fate up to the moment at which the server hears that the battery is spent. */
static void compare(const struct team *team)
{
    struct errors killed = {0, 0}, drained = {0, 0};

    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        char words[64], kill[64];

        snprintf(words, sizeof words, "%s, seed %u", team->title, (unsigned)seed);
        run_team(team, "{at: 10, drain: leader}", seed);
        double told = told_at(1);
        double taken_over = fleet_leads_at("last", 2, 0);
        struct errors drain = errors_from(told);

        TEST_ASSERT_TRUE_MESSAGE(told > 11 && told <= 11.2001, words);
        TEST_ASSERT_TRUE_MESSAGE(taken_over > 11 && taken_over <= told + 2.9, words);
        snprintf(kill, sizeof kill, "{at: %.2f, kill: leader}", told);
        run_team(team, kill, seed);
        struct errors death = errors_from(told);

        TEST_ASSERT_TRUE_MESSAGE(drain.peak < 0.85 * death.peak, words);
        TEST_ASSERT_TRUE_MESSAGE(drain.integral < 0.75 * death.integral, words);
        killed.peak += death.peak / SEEDS;
        killed.integral += death.integral / SEEDS;
        drained.peak += drain.peak / SEEDS;
        drained.integral += drain.integral / SEEDS;
    }
    printf("%-15s killed %.3f m, %.3f m s; drained %.3f m, %.3f m s\n", team->title, killed.peak,
           killed.integral, drained.peak, drained.integral);
}

static void a_low_battery_costs_the_formation_less_than_a_death(void)
{
    for (size_t i = 0; i < sizeof teams / sizeof teams[0]; i++)
        compare(&teams[i]);
}

/* Ticks of the run in "last" in which nobody led, from `from` on. */
static unsigned ticks_without_leader(double from)
{
    FILE *trace = fleet_trace("last");
    struct fleet_row row;
    unsigned leaders = 0, ticks = 0;

    while (fleet_next(trace, &row)) {
        leaders += row.alive && row.role == 'L';
        if (row.robot != 4)
            continue;
        ticks += row.t >= from && leaders == 0;
        leaders = 0;
    }
    return ticks;
}

static void somebody_leads_all_the_time(void)
{
    for (size_t i = 0; i < sizeof teams / sizeof teams[0]; i++)
        for (uint64_t seed = 1; seed <= SEEDS; seed++) {
            run_team(&teams[i], "{at: 10, drain: leader}", seed);
            TEST_ASSERT_EQUAL_UINT_MESSAGE(0, ticks_without_leader(10), teams[i].title);
        }
}

/* From `t` on; wheels of small bodies come to rest within their lag. */
static void stands_from(unsigned robot, double t)
{
    FILE *trace = fleet_trace("last");
    struct fleet_row row;

    while (fleet_next(trace, &row))
        if (row.robot == robot && row.t >= t) {
            TEST_ASSERT_TRUE(fabs(row.v) < 1e-3 && fabs(row.omega) < 0.02);
            TEST_ASSERT_TRUE(row.role != 'L' && row.vertex == 0 && !row.alive);
        }
}

static void a_leader_that_was_replaced_stands(void)
{
    for (size_t i = 0; i < sizeof teams / sizeof teams[0]; i++) {
        run_team(&teams[i], "{at: 10, drain: leader}", 1);
        stands_from(1, fleet_leads_at("last", 2, 0) + 0.5);
    }
}

/* Robot 2 alone could, and it is dead. */
static void a_leader_that_no_one_replaces_stops_after_3_s(void)
{
    for (size_t i = 0; i < sizeof teams / sizeof teams[0]; i++) {
        struct fleet_row row;

        run_team(&teams[i], "{at: 5, kill: 2}\n  - {at: 10, drain: 1}", 1);
        double told = told_at(1);
        FILE *trace = fleet_trace("last");
        while (fleet_next(trace, &row)) {
            if (row.robot != 1)
                continue;
            if (row.t >= told && row.t < told + 2.5) {
                TEST_ASSERT_TRUE(row.v > 0.1);
            }
            if (row.t >= told + 3.5) {
                TEST_ASSERT_TRUE(fabs(row.v) < 1e-3);
            }
        }
    }
}

static struct fleet_result run_spare(enum sim_robots robots, uint64_t seed, const char *out)
{
    return fleet_run(
        &(struct fleet_run){.text = "schema: 1\nname: spare\nduration: 25\nrobots:\n"
                                    "  - {id: 1, pose: [0, 0, 0], candidate: true}\n"
                                    "  - {id: 2, pose: [-0.5, 0.6, 0], candidate: true}\n"
                                    "  - {id: 3, pose: [-0.4, -0.5, 0]}\n"
                                    "  - {id: 4, pose: [-1.1, 0.1, 0]}\n"
                                    "  - {id: 5, pose: [-0.8, -0.9, 0]}\n"
                                    "body: small\nscatter: 0\nnetwork: {range: 5, loss: 0.1}\n"
                                    "trajectory: {start: [0, 0, 0], v: 0.3, omega: 0.15}\n"
                                    "formations:\n"
                                    "  Y: {L: [0, 0.6, 0.6, 0.6], psi: [0, 0, 2*pi/3, -2*pi/3]}\n"
                                    "formation: Y\nevents:\n"
                                    "  - {at: 10, drain: 3}\n",
                            .robots = robots,
                            .seed = seed,
                            .out = out});
}

static void a_spare_takes_the_vertex_of_a_drained_follower(void)
{
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        struct fleet_result r = run_spare(SIM_NATIVE, seed, "last");
        double told = told_at(3);

        TEST_ASSERT_TRUE(told > 11 && told <= 11.2001);
        TEST_ASSERT_TRUE(r.summary.metrics.complete);
        TEST_ASSERT_TRUE(r.summary.metrics.error_final <= 0.02);
        TEST_ASSERT_EQUAL_UINT(1, r.leader);
        TEST_ASSERT_EQUAL_UINT(1, r.summary.metrics.elections);
        stands_from(3, told + 0.5);
    }
}

static void chips_leave_the_same_files(void)
{
    run_spare(SIM_AVR, 7, "chips");
    run_spare(SIM_NATIVE, 7, "native");
    fleet_same_files("chips", "native");
}

static void a_full_battery_brings_the_old_leader_back(void)
{
    struct fleet_row row;

    run_team(&teams[2], "{at: 10, drain: 1}\n  - {at: 15, revive: 1}", 1);
    FILE *trace = fleet_trace("last");
    while (fleet_next(trace, &row))
        if (row.robot == 1 && row.t > 24) {
            TEST_ASSERT_TRUE(row.alive && row.role != 'L' && row.vertex != 0 && row.v > 0.1);
            TEST_ASSERT_TRUE(row.error < 0.1);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_low_battery_costs_the_formation_less_than_a_death);
    RUN_TEST(somebody_leads_all_the_time);
    RUN_TEST(a_leader_that_was_replaced_stands);
    RUN_TEST(a_leader_that_no_one_replaces_stops_after_3_s);
    RUN_TEST(a_spare_takes_the_vertex_of_a_drained_follower);
    RUN_TEST(chips_leave_the_same_files);
    RUN_TEST(a_full_battery_brings_the_old_leader_back);
    return UNITY_END();
}
