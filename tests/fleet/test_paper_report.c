/* muster paper as a whole, on native robots: what it writes is well-formed, complete, and what
 * docs/paper.md says. */
#include "paper.h"

#include <libfyaml.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

static const volatile bool go = false;

static struct paper_options native(const char *out)
{
    return (struct paper_options){
        .robots = SIM_NATIVE,
        .scenarios = SCENARIOS,
        .out = out,
        .threads = 1,
        .quiet = true,
    };
}

static char *report, *summary, *markdown;

/* All of a file, to be freed. */
static char *text_of(const char *path)
{
    FILE *file = fopen(path, "r");
    char *text = NULL;
    size_t length = 0;

    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    TEST_ASSERT_TRUE(getdelim(&text, &length, '\0', file) > 0);
    fclose(file);
    return text;
}

void setUp(void)
{
}
void tearDown(void)
{
}

static void all_figures_are_made(void)
{
    struct paper_options options = native("all");
    char error[512] = "";

    TEST_ASSERT_EQUAL_INT_MESSAGE(SIM_DONE, paper_write(&options, &go, error, sizeof error), error);
    report = text_of("all/report.html");
    summary = text_of("all/summary.json");
    markdown = text_of("all/paper.md");
}

static void every_figure_has_a_heading_and_a_verdict(void)
{
    static const int figures[] = {1, 5, 6, 7, 8, 9, 10, 11, 14, 15, 16, 17, 18, 19};
    char words[32];

    for (size_t i = 0; i < sizeof figures / sizeof figures[0]; i++) {
        snprintf(words, sizeof words, "<h2>Figure %d: ", figures[i]);
        const char *section = strstr(report, words);
        TEST_ASSERT_NOT_NULL_MESSAGE(section, words);
        const char *end = strstr(section, "</section>");
        TEST_ASSERT_TRUE(strstr(section, "class=\"verdict") < end);
        TEST_ASSERT_TRUE(strstr(section, "<svg") < end);
        TEST_ASSERT_TRUE(strstr(section, "<table") < end);
        snprintf(words, sizeof words, "\n## Figure %d: ", figures[i]);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(markdown, words), words);
    }
}

static void the_report_refers_to_nothing_outside(void)
{
    static const char *const outside[] = {"http",  "src=",    "url(",    "@import",
                                          "<link", "<script", "<iframe", "xlink"};

    for (size_t i = 0; i < sizeof outside / sizeof outside[0]; i++)
        TEST_ASSERT_NULL_MESSAGE(strstr(report, outside[i]), outside[i]);
}

static void no_number_is_missing(void)
{
    static const char *const broken[] = {"nan", "-inf", ">inf", "\"inf", " inf ", "(null)"};

    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++) {
        TEST_ASSERT_NULL_MESSAGE(strstr(report, broken[i]), broken[i]);
        TEST_ASSERT_NULL_MESSAGE(strstr(markdown, broken[i]), broken[i]);
    }
}

/* The name of the tag that begins at `tag`. */
static size_t name_length(const char *tag)
{
    return strcspn(tag, " />\n");
}

static void every_tag_is_closed_in_its_turn(void)
{
    const char *open[32];
    size_t depth = 0;

    for (const char *at = strchr(report, '<'); at != NULL; at = strchr(at + 1, '<')) {
        const char *end = strchr(at, '>');

        TEST_ASSERT_NOT_NULL(end);
        TEST_ASSERT_TRUE_MESSAGE(memchr(at + 1, '<', (size_t)(end - at) - 1) == NULL, "< in a tag");
        if (at[1] == '!' || end[-1] == '/')
            continue;
        if (at[1] != '/') {
            TEST_ASSERT_TRUE(depth < 32);
            open[depth++] = at + 1;
            continue;
        }
        TEST_ASSERT_TRUE_MESSAGE(depth > 0, "a tag too many is closed");
        depth--;
        TEST_ASSERT_EQUAL_UINT(name_length(open[depth]), name_length(at + 2));
        TEST_ASSERT_EQUAL_STRING_LEN(open[depth], at + 2, name_length(at + 2));
    }
    TEST_ASSERT_EQUAL_UINT_MESSAGE(0, depth, "a tag is not closed");
}

static struct fy_node *at(struct fy_node *root, const char *path)
{
    struct fy_node *node = fy_node_by_path(root, path, FY_NT, FYNWF_DONT_FOLLOW);

    TEST_ASSERT_NOT_NULL_MESSAGE(node, path);
    return node;
}

static void the_summary_is_json_with_the_same_verdicts(void)
{
    static const struct fy_parse_cfg json = {.flags = FYPCF_JSON_FORCE | FYPCF_QUIET};
    struct fy_document *document = fy_document_build_from_string(&json, summary, FY_NT);

    TEST_ASSERT_NOT_NULL(document);
    struct fy_node *root = fy_document_root(document);
    TEST_ASSERT_EQUAL_INT(14, fy_node_mapping_item_count(at(root, "/figures")));
    TEST_ASSERT_EQUAL_INT(38, fy_node_sequence_item_count(at(root, "/runs")));
    TEST_ASSERT_EQUAL_STRING("holds", fy_node_get_scalar0(at(root, "/figures/5/verdict")));
    TEST_ASSERT_EQUAL_STRING("cannot be told from print",
                             fy_node_get_scalar0(at(root, "/figures/11/verdict")));
    TEST_ASSERT_EQUAL_STRING("does not hold",
                             fy_node_get_scalar0(at(root, "/figures/11/claims/1/verdict")));
    TEST_ASSERT_EQUAL_STRING("2", fy_node_get_scalar0(at(root, "/figures/14/tables/0/rows/0/"
                                                               "new_leader")));
    fy_document_destroy(document);
}

/* The next line, ended by '\0'; NULL at the end. What tells of the robots, which here are not those
 * of the documentation, is passed over. */
static const char *next_line(char **text)
{
    const char *line = strsep(text, "\n");

    return line != NULL && strncmp(line, "Robots: ", 8) == 0 ? strsep(text, "\n") : line;
}

static void the_documentation_says_what_comes_out(void)
{
    char *committed = text_of(DOCUMENTATION);
    char *expected = markdown, *found = committed;
    const char *line;

    while ((line = next_line(&expected)) != NULL)
        TEST_ASSERT_EQUAL_STRING_MESSAGE(line, next_line(&found),
                                         "docs/paper.md is out of date: make paper");
    TEST_ASSERT_NULL(next_line(&found));
    free(committed);
}

static void one_figure_can_be_made_alone(void)
{
    struct paper_options options = native("one");
    char error[512] = "";

    options.only = 16;
    TEST_ASSERT_EQUAL_INT_MESSAGE(SIM_DONE, paper_write(&options, &go, error, sizeof error), error);
    char *page = text_of("one/report.html");
    TEST_ASSERT_NOT_NULL(strstr(page, "<h2>Figure 16: "));
    TEST_ASSERT_NULL(strstr(page, "<h2>Figure 15: "));
    free(page);
    TEST_ASSERT_TRUE(paper_has_figure(16));
    TEST_ASSERT_FALSE(paper_has_figure(12));
    TEST_ASSERT_FALSE(paper_has_figure(0));
}

static void without_the_scenarios_there_is_no_report(void)
{
    struct paper_options options = native("none");
    char error[512] = "";

    options.scenarios = "nowhere";
    TEST_ASSERT_EQUAL_INT(SIM_REFUSED, paper_write(&options, &go, error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, "nowhere/paper-law-straight.yaml"));
    TEST_ASSERT_NOT_EQUAL(0, access("none/report.html", F_OK));
}

static void an_interrupted_one_leaves_no_report_nor_an_older_one(void)
{
    static const volatile bool stop = true;
    struct paper_options options = native("one");
    char error[512] = "";

    TEST_ASSERT_EQUAL_INT(SIM_INTERRUPTED, paper_write(&options, &stop, error, sizeof error));
    TEST_ASSERT_NOT_EQUAL(0, access("one/report.html", F_OK));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(all_figures_are_made);
    if (report == NULL)
        return UNITY_END();
    RUN_TEST(every_figure_has_a_heading_and_a_verdict);
    RUN_TEST(the_report_refers_to_nothing_outside);
    RUN_TEST(no_number_is_missing);
    RUN_TEST(every_tag_is_closed_in_its_turn);
    RUN_TEST(the_summary_is_json_with_the_same_verdicts);
    RUN_TEST(the_documentation_says_what_comes_out);
    RUN_TEST(one_figure_can_be_made_alone);
    RUN_TEST(without_the_scenarios_there_is_no_report);
    RUN_TEST(an_interrupted_one_leaves_no_report_nor_an_older_one);
    free(report);
    free(summary);
    free(markdown);
    return UNITY_END();
}
