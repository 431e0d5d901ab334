#include "summary.h"

#include "yaml.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

static char dir[] = "/tmp/muster-summary-XXXXXX";
static char error[256];
static struct summary summary;
static struct node *root;

static struct scenario_robot robots[] = {{.id = 7}, {.id = 12}};
static struct scenario scenario = {.name = "two", .robot_count = 2, .robots = robots};

static const char *file_path(void)
{
    static char path[256];

    snprintf(path, sizeof path, "%s/summary.json", dir);
    return path;
}

void setUp(void)
{
    strcpy(dir + strlen(dir) - 6, "XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(dir));
    root = NULL;
    scenario.allocation = ASSIGN_CPA;
    summary = (struct summary){
        .scenario = &scenario,
        .seed = 18446744073709551615u,
        .avr = true,
        .duration = 30,
        .wall = 4,
        .metrics = {.leader = 1,
                    .complete = true,
                    .time_to_complete = 0.58,
                    .switches = 3,
                    .elections = 2,
                    .error_final = 0.003084,
                    .error_peak = 2.303518,
                    .error_integral = 6.358452,
                    .path_length = 154.8111,
                    .min_separation = 1.25},
        .link = {.frames = 12345, .bytes = 5000000000, .dropped = 3, .bad_frames = 1},
        .load_max_pct = 12.5,
        .tick_cycles_max = 54321,
        .stack_free_min = 1812,
    };
}

void tearDown(void)
{
    tree_free(root);
    unlink(file_path());
    rmdir(dir);
}

/* The file, read again: JSON is YAML, and the reader refuses a key that comes twice. */
static void write_and_read(void)
{
    char text[4096];
    struct refusal refusal = {error, sizeof error};

    TEST_ASSERT_TRUE_MESSAGE(summary_write(&summary, dir, error, sizeof error), error);
    FILE *file = fopen(file_path(), "r");
    TEST_ASSERT_NOT_NULL(file);
    size_t length = fread(text, 1, sizeof text, file);
    fclose(file);
    root = yaml_parse("summary.json", text, length, &refusal);
    TEST_ASSERT_NOT_NULL_MESSAGE(root, error);
}

/* The scalar at `key`, or at `part` of the mapping there. */
static void assert_value(const char *expected, const char *key, const char *part)
{
    struct node *node = tree_find(root, key);

    TEST_ASSERT_NOT_NULL_MESSAGE(node, key);
    if (part != NULL)
        node = tree_find(node, part);
    TEST_ASSERT_NOT_NULL_MESSAGE(node, part);
    TEST_ASSERT_EQUAL_STRING_MESSAGE(expected, node->text, key);
}

static void test_everything_is_in_the_file(void)
{
    write_and_read();
    assert_value("two", "scenario", NULL);
    assert_value("2", "robots", NULL);
    assert_value("avr", "robot_kind", NULL);
    assert_value("18446744073709551615", "seed", NULL);
    assert_value("30.00", "duration", NULL);
    assert_value("4.000", "wall_s", NULL);
    assert_value("7.50", "realtime_factor", NULL);
    assert_value("12", "final_leader", NULL);
    assert_value("2", "elections", NULL);
    assert_value("cpa", "allocation", "method");
    assert_value("true", "allocation", "complete");
    assert_value("0.58", "allocation", "time_to_complete_s");
    assert_value("3", "allocation", "switches");
    assert_value("0.003084", "mean_distance_error_m", "final");
    assert_value("2.303518", "mean_distance_error_m", "peak");
    assert_value("6.358452", "mean_distance_error_m", "integral");
    assert_value("154.8111", "path_length_m", NULL);
    assert_value("1.2500", "min_separation_m", NULL);
    assert_value("12345", "link", "frames");
    assert_value("5000000000", "link", "bytes");
    assert_value("3", "link", "dropped");
    assert_value("1", "link", "crc_errors");
    assert_value("12.50", "cpu", "load_max_pct");
    assert_value("54321", "cpu", "tick_cycles_max");
    assert_value("1812", "cpu", "stack_free_min_bytes");
}

static void test_native_robots_have_no_processor(void)
{
    summary.avr = false;
    write_and_read();
    assert_value("native", "robot_kind", NULL);
    TEST_ASSERT_NULL(tree_find(root, "cpu"));
}

static void test_what_is_not_known_is_null(void)
{
    summary.metrics.leader = SERVER_NOBODY;
    summary.metrics.complete = false;
    summary.metrics.time_to_complete = -1;
    summary.metrics.min_separation = INFINITY;
    write_and_read();
    assert_value("null", "final_leader", NULL);
    assert_value("false", "allocation", "complete");
    assert_value("null", "allocation", "time_to_complete_s");
    assert_value("null", "min_separation_m", NULL);
}

static void test_a_run_of_no_time_has_a_factor(void)
{
    summary.wall = 0;
    write_and_read();
    assert_value("0.00", "realtime_factor", NULL);
}

static void test_allocations_have_the_scenarios_names(void)
{
    static const char *const names[] = {[ASSIGN_CPA] = "cpa",
                                        [ASSIGN_CPA_LITERAL] = "cpa-literal",
                                        [ASSIGN_RIGID] = "rigid",
                                        [ASSIGN_OPTIMAL] = "optimal"};

    for (unsigned i = 0; i < sizeof names / sizeof names[0]; i++) {
        scenario.allocation = (enum scenario_allocation)i;
        tree_free(root);
        write_and_read();
        assert_value(names[i], "allocation", "method");
    }
}

static void test_a_directory_that_is_not_there_gives_words(void)
{
    TEST_ASSERT_FALSE(summary_write(&summary, "/nowhere/at/all", error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, "cannot write /nowhere/at/all/summary.json"));
}

static void test_a_full_disk_gives_words(void)
{
    TEST_ASSERT_EQUAL_INT(0, symlink("/dev/full", file_path()));
    TEST_ASSERT_FALSE(summary_write(&summary, dir, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, file_path()));
}

static void assert_printed(const char *words)
{
    static char text[4096];
    FILE *out = tmpfile();

    TEST_ASSERT_NOT_NULL(out);
    summary_print(&summary, "runs/two-1", out);
    rewind(out);
    text[fread(text, 1, sizeof text - 1, out)] = '\0';
    fclose(out);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, words), text);
}

static void test_a_person_reads_the_same(void)
{
    assert_printed("two: 2 ATmega128 robots, 30.00 s simulated in 4.00 s (7.5 times real time)\n");
    assert_printed("robot 12 at the end, 2 elections\n");
    assert_printed("complete 0.58 s after the last event, 3 vertex switches\n");
    assert_printed("closest approach 1.25 m\n");
    assert_printed("1812 bytes of stack never used\n");
    assert_printed("runs/two-1/\n");
    summary.metrics.leader = SERVER_NOBODY;
    summary.metrics.complete = false;
    assert_printed("none at the end\n");
    assert_printed("not complete, ");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_everything_is_in_the_file);
    RUN_TEST(test_native_robots_have_no_processor);
    RUN_TEST(test_what_is_not_known_is_null);
    RUN_TEST(test_a_run_of_no_time_has_a_factor);
    RUN_TEST(test_allocations_have_the_scenarios_names);
    RUN_TEST(test_a_directory_that_is_not_there_gives_words);
    RUN_TEST(test_a_full_disk_gives_words);
    RUN_TEST(test_a_person_reads_the_same);
    return UNITY_END();
}
