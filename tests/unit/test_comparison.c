#include "comparison.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

#define RUNS 9

static struct archive runs[RUNS];
static struct archive *archives[RUNS];
static char dir[] = "/tmp/muster-comparison-XXXXXX";
static char error[256];
static char path[64];

/* One robot, whose error is 0, 7, 5, 3, 1, 8, 6, 4 or 2 m; run k goes on for k + 1 s. */
static void given_run(size_t k)
{
    static char names[RUNS][32];
    struct history *history = &runs[k].history;

    snprintf(names[k], sizeof names[k], k == 0 ? "it's \"$(run)\"" : "run %zu", k);
    runs[k] = (struct archive){.path = names[k], .name = names[k]};
    archives[k] = &runs[k];
    TEST_ASSERT_TRUE(history_begin(history, 1, 1));
    TEST_ASSERT_NOT_NULL(history_add_shape(history, "", 0));
    for (int tick = 0; tick <= 50 * ((int)k + 1); tick++) {
        struct glimpse *glimpse = history_add(history);

        TEST_ASSERT_NOT_NULL(glimpse);
        *glimpse = (struct glimpse){.error = (float)(7 * k % RUNS), .alive = true};
        history->moments[tick] = (struct moment){.time_ms = 20 * tick};
    }
}

void setUp(void)
{
    strcpy(dir + strlen(dir) - 6, "XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(dir));
    for (size_t k = 0; k < RUNS; k++)
        given_run(k);
}

void tearDown(void)
{
    for (size_t k = 0; k < RUNS; k++)
        history_free(&runs[k].history);
    rmdir(dir);
}

static void the_median_is_of_those_that_go_on(void)
{
    TEST_ASSERT_TRUE(comparison_median(archives, RUNS, 0) == 4);
    TEST_ASSERT_TRUE(comparison_median(archives, 8, 0) == 4.5);
    TEST_ASSERT_TRUE(comparison_median(archives, RUNS, 4) == 3.5);
    TEST_ASSERT_TRUE(comparison_median(archives, RUNS, 4.5) == 4);
    TEST_ASSERT_TRUE(comparison_median(archives, RUNS, 9) == 2);
    TEST_ASSERT_TRUE(isnan(comparison_median(archives, RUNS, 9.1)));
}

static void a_format_is_known_by_its_end(void)
{
    static const char *const known[] = {"plot.svg", "a.svg.png", "/a.b/c.pdf"};
    static const char *const others[] = {".svg", "plot.jpg", "plotsvg", "plot.svg.gz", "plot"};

    for (size_t i = 0; i < 3; i++)
        TEST_ASSERT_TRUE_MESSAGE(comparison_knows(known[i]), known[i]);
    for (size_t i = 0; i < 5; i++)
        TEST_ASSERT_FALSE_MESSAGE(comparison_knows(others[i]), others[i]);
}

/* The file's text, to be freed. */
static char *drawn(size_t count, const char *name)
{
    char *text = calloc(1, 1 << 20);

    snprintf(path, sizeof path, "%s/%s", dir, name);
    TEST_ASSERT_NOT_NULL(text);
    TEST_ASSERT_TRUE_MESSAGE(comparison_draw(archives, count, dir, name, error, sizeof error),
                             error);
    FILE *file = fopen(path, "r");
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_TRUE(fread(text, 1, (1 << 20) - 1, file) > 1000);
    fclose(file);
    unlink(path);
    return text;
}

static void a_few_runs_have_a_line_each(void)
{
    char *svg = drawn(8, "it's.svg");

    TEST_ASSERT_NOT_NULL(strstr(svg, "it's \"$(run)\"<"));
    TEST_ASSERT_NOT_NULL(strstr(svg, ">run 7<"));
    TEST_ASSERT_NULL(strstr(svg, "median"));
    free(svg);
}

static void many_have_a_median(void)
{
    char *svg = drawn(9, "plot.svg");

    TEST_ASSERT_NOT_NULL(strstr(svg, "each of 9 runs"));
    TEST_ASSERT_NOT_NULL(strstr(svg, "their median"));
    TEST_ASSERT_NULL(strstr(svg, ">run 7<"));
    free(svg);
}

static void one_run_has_its_events(void)
{
    struct incident incidents[] = {{500, 1, "kill", ""}, {520, 2, "role", "L"}};

    runs[0].incidents = incidents;
    runs[0].incident_count = 2;
    char *svg = drawn(1, "plot.svg");
    TEST_ASSERT_NOT_NULL(strstr(svg, "robot 1 is lost"));
    TEST_ASSERT_NOT_NULL(strstr(svg, "robot 2 leads"));
    free(svg);
    svg = drawn(2, "plot.svg");
    TEST_ASSERT_NULL(strstr(svg, "robot 1 is lost"));
    free(svg);
}

static void where_it_cannot_be_written_it_says_so(void)
{
    TEST_ASSERT_FALSE(comparison_draw(archives, 1, "/nowhere", "plot.svg", error, sizeof error));
    TEST_ASSERT_EQUAL_STRING("No such file or directory", error);
}

static void the_table_has_final_peak_and_integral(void)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    TEST_ASSERT_NOT_NULL(out);
    runs[1].cut = true;
    comparison_print(archives, 3, out);
    fclose(out);
    TEST_ASSERT_NOT_NULL(strstr(text, "run 2                     3.00          5.0000     5.000  "
                                      "         15.10\n"));
    TEST_ASSERT_NOT_NULL(strstr(text, "cut short"));
    free(text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_median_is_of_those_that_go_on);
    RUN_TEST(a_format_is_known_by_its_end);
    RUN_TEST(a_few_runs_have_a_line_each);
    RUN_TEST(many_have_a_median);
    RUN_TEST(one_run_has_its_events);
    RUN_TEST(where_it_cannot_be_written_it_says_so);
    RUN_TEST(the_table_has_final_peak_and_integral);
    return UNITY_END();
}
