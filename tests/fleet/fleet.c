#include "fleet.h"

#include "limits.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unity.h>

static void path_of(char *path, size_t room, const char *out, const char *name)
{
    snprintf(path, room, "%s%s%s", out, name[0] != '\0' ? "/" : "", name);
}

static struct scenario *read(const struct fleet_run *run)
{
    char path[512];
    char error[1024];
    size_t count = 0;
    size_t vertices = run->robots == SIM_AVR ? VERTICES_MAX_CHIP : VERTICES_MAX;
    struct scenario *scenario;

    while (run->settings[count] != NULL)
        count++;
    if (run->file != NULL) {
        snprintf(path, sizeof path, "%s/%s", FLEET_SCENARIOS, run->file);
        scenario = scenario_read(path, run->settings, count, vertices, error, sizeof error);
    } else {
        scenario = scenario_parse("test", run->text, strlen(run->text), run->settings, count,
                                  vertices, error, sizeof error);
    }
    if (scenario == NULL)
        TEST_FAIL_MESSAGE(error);
    return scenario;
}

/* What is left of the RAM when the stack is as deep as it can become, by the machine code. */
static unsigned least_free(void)
{
    FILE *file = fopen(FLEET_STACK, "r");
    char line[512];
    unsigned bytes;

    TEST_ASSERT_NOT_NULL_MESSAGE(file, FLEET_STACK);
    while (fgets(line, sizeof line, file) != NULL)
        if (sscanf(line, "ram_free_bytes %u", &bytes) == 1) {
            fclose(file);
            return bytes;
        }
    TEST_FAIL_MESSAGE(FLEET_STACK " says no ram_free_bytes");
    return 0;
}

struct fleet_result fleet_run(const struct fleet_run *run)
{
    static const volatile bool stop = false;
    struct fleet_result result = {.leader = 0};
    struct scenario *scenario = read(run);
    char out[512];
    char error[512] = "";

    path_of(out, sizeof out, run->out != NULL ? run->out : "untraced", "");
    struct sim_options options = {
        .robots = run->robots,
        .firmware = FLEET_FIRMWARE,
        .parameters = run->parameters,
        .out = out,
        .seed = run->seed == 0 ? 1 : run->seed,
        .threads = run->threads == 0 ? 1 : run->threads,
        .trace = run->out != NULL,
        .quiet = true,
        .watch_stack = true,
        .view = run->view,
        .watch = run->watch,
        .watcher = run->watcher,
    };
    enum sim_end end = sim_run(scenario, &options, &stop, &result.summary, error, sizeof error);
    if (result.summary.metrics.leader != SERVER_NOBODY)
        result.leader = scenario->robots[result.summary.metrics.leader].id;
    scenario_free(scenario);
    if (end != run->end)
        TEST_FAIL_MESSAGE(error);
    if (run->robots == SIM_AVR) {
        TEST_ASSERT_GREATER_OR_EQUAL_UINT_MESSAGE(least_free(), result.summary.stack_free_min,
                                                  "a stack is deeper than its static bound");
    }
    return result;
}

void fleet_check(const char *file)
{
    struct scenario *scenario = read(&(struct fleet_run){.file = file, .robots = SIM_AVR});
    char named[SCENARIO_NAME_MAX + sizeof ".yaml"];

    snprintf(named, sizeof named, "%s.yaml", scenario->name);
    TEST_ASSERT_EQUAL_STRING(file, named);
    scenario_free(scenario);
}

FILE *fleet_trace(const char *out)
{
    char path[512];
    char header[256];

    path_of(path, sizeof path, out, "trace.csv");
    FILE *trace = fopen(path, "r");
    if (trace == NULL || fgets(header, sizeof header, trace) == NULL)
        TEST_FAIL_MESSAGE("no trace.csv");
    TEST_ASSERT_EQUAL_STRING("t,robot,x,y,theta,v,omega,role,vertex,distance_error,alive\n",
                             header);
    return trace;
}

bool fleet_next(FILE *trace, struct fleet_row *row)
{
    int fields = fscanf(trace, "%lf,%u,%lf,%lf,%lf,%lf,%lf,%c,%u,%lf,%u\n", &row->t, &row->robot,
                        &row->x, &row->y, &row->theta, &row->v, &row->omega, &row->role,
                        &row->vertex, &row->error, &row->alive);

    if (fields == EOF) {
        fclose(trace);
        return false;
    }
    TEST_ASSERT_EQUAL_INT_MESSAGE(11, fields, "a row of trace.csv is not whole");
    return true;
}

static void same_file(const char *out_a, const char *out_b, const char *name)
{
    char path_a[512], path_b[512];
    char line_a[512], line_b[512];
    char words[512];

    path_of(path_a, sizeof path_a, out_a, name);
    path_of(path_b, sizeof path_b, out_b, name);
    FILE *a = fopen(path_a, "r");
    FILE *b = fopen(path_b, "r");
    TEST_ASSERT_NOT_NULL(a);
    TEST_ASSERT_NOT_NULL(b);
    for (unsigned line = 1;; line++) {
        char *got_a = fgets(line_a, sizeof line_a, a);
        char *got_b = fgets(line_b, sizeof line_b, b);

        snprintf(words, sizeof words, "%s/%s, line %u", out_a, name, line);
        TEST_ASSERT_EQUAL_INT_MESSAGE(got_a == NULL, got_b == NULL, words);
        if (got_a == NULL || got_b == NULL)
            break;
        TEST_ASSERT_EQUAL_STRING_MESSAGE(line_a, line_b, words);
    }
    fclose(a);
    fclose(b);
}

void fleet_same_files(const char *out_a, const char *out_b)
{
    same_file(out_a, out_b, "trace.csv");
    same_file(out_a, out_b, "events.csv");
}

double fleet_leads_at(const char *out, unsigned robot, double from)
{
    FILE *trace = fleet_trace(out);
    struct fleet_row row;
    double found = -1;

    while (fleet_next(trace, &row))
        if (found < 0 && row.role == 'L' && row.alive && row.t >= from &&
            (robot == 0 || row.robot == robot))
            found = row.t;
    return found;
}
