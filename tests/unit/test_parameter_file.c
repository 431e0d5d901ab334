#include "parameter_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

#define GIVEN(symbol) (UINT32_C(1) << PARAMETER_##symbol)

static struct parameter_file *file;
static char error[1024];
static char path[] = "/tmp/muster-parameters-XXXXXX";

void setUp(void)
{
    file = NULL;
    error[0] = '\0';
}

void tearDown(void)
{
    parameter_file_free(file);
}

static void parse(const char *text)
{
    parameter_file_free(file);
    file = parameter_file_parse("p.yaml", text, strlen(text), error, sizeof error);
}

static void accept(const char *text)
{
    parse(text);
    TEST_ASSERT_NOT_NULL_MESSAGE(file, error);
}

/* `expected` is the beginning of the error's line. */
static void refuse(const char *text, const char *expected)
{
    parse(text);
    TEST_ASSERT_NULL(file);
    TEST_ASSERT_EQUAL_STRING_LEN(expected, error, strlen(expected));
    TEST_ASSERT_NULL_MESSAGE(strchr(error, '\n'), "an error is one line");
}

static void test_what_is_given_and_what_is_not(void)
{
    accept("schema: 1\n"
           "robots:\n"
           "  - {id: 7, left_gain: 0.953, right_dead_band: 0.031}\n"
           "  - id: 3\n"
           "    battery_critical: 6.2/2\n");
    TEST_ASSERT_EQUAL_UINT(2, file->count);
    TEST_ASSERT_EQUAL_HEX32(GIVEN(ID) | GIVEN(LEFT_GAIN) | GIVEN(RIGHT_DEAD_BAND),
                            file->robots[0].given);
    TEST_ASSERT_EQUAL_UINT(7, file->robots[0].parameters.value[PARAMETER_ID]);
    TEST_ASSERT_EQUAL_UINT(15614, file->robots[0].parameters.value[PARAMETER_LEFT_GAIN]);
    TEST_ASSERT_EQUAL_UINT(16384, file->robots[0].parameters.value[PARAMETER_RIGHT_GAIN]);
    TEST_ASSERT_EQUAL_UINT(508, file->robots[0].parameters.value[PARAMETER_RIGHT_DEAD_BAND]);
    TEST_ASSERT_EQUAL_HEX32(GIVEN(ID) | GIVEN(BATTERY_CRITICAL), file->robots[1].given);
    TEST_ASSERT_EQUAL_UINT(3100, file->robots[1].parameters.value[PARAMETER_BATTERY_CRITICAL]);
}

static void test_robots_are_found_by_their_ids(void)
{
    accept("schema: 1\nrobots: [{id: 7}, {id: 3, track: 0.081}]\n");
    TEST_ASSERT_EQUAL_PTR(&file->robots[1], parameter_file_find(file, 3));
    TEST_ASSERT_EQUAL_PTR(&file->robots[0], parameter_file_find(file, 7));
    TEST_ASSERT_NULL(parameter_file_find(file, 4));
}

static void test_refusals(void)
{
    refuse("robots: [{id: 7}]", "p.yaml:1:1: error: the key 'schema' is missing;");
    refuse("schema: 2\nrobots: [{id: 7}]", "p.yaml:1:9: error: schema is 2; 1 is allowed");
    refuse("schema: 1", "p.yaml:1:1: error: the key 'robots' is missing;");
    refuse("schema: 1\nrobots: []", "p.yaml:2:9: error: 0 robots; 1 to 65534 are allowed");
    refuse("schema: 1\nrobots: {id: 7}", "p.yaml:2:9: error: robots is a mapping of keys; a list");
    refuse("schema: 1\nrobots:\n  - left_gain: 1", "p.yaml:3:5: error: the key 'id' is missing;");
    refuse("schema: 1\nrobots: [{id: 0}]", "p.yaml:2:15: error: id is 0; a whole number from 1");
    refuse("schema: 1\nrobots: [{id: 65535}]", "p.yaml:2:15: error: id is 65535; a whole number");
    refuse("schema: 1\nrobots: [{id: 7}, {id: 7}]",
           "p.yaml:2:24: error: two robots with the id 7; each has its own");
    refuse("schema: 1\nrobots:\n  - {id: 7, left_gian: 1}",
           "p.yaml:3:13: error: unknown key 'left_gian', perhaps 'left_gain';");
    refuse("schema: 1\nrobots:\n  - {id: 7, image: 1}", "p.yaml:3:13: error: unknown key 'image'");
    refuse("schema: 1\nrobots:\n  - {id: 7, track: 0.08, track: 0.08}",
           "p.yaml:3:26: error: 'track' stands here twice, first in line 3;");
    refuse("schema: 1\nrobots:\n  - {id: 7, left_gain: 1.6}",
           "p.yaml:3:24: error: left_gain is 1.6; a number from 0.5 to 1.5 is allowed");
    refuse("schema: 1\nrobots:\n  - {id: 7, track: -0.001}",
           "p.yaml:3:20: error: track is -0.001; a number from 0 to 2 m is allowed");
    refuse("schema: 1\nrobots:\n  - {id: 7, track: [1]}", "p.yaml:3:20: error: track is a list");
    refuse("schema: 1\nrobots:\n  - {id: 7, track: }", "p.yaml:3:");
}

static void write_to(const char *to, const struct parameter_entry *robots, size_t count)
{
    if (!parameter_file_write(to, robots, count, error, sizeof error))
        TEST_FAIL_MESSAGE(error);
}

static void test_the_text_of_a_file(void)
{
    static const struct parameter_entry robots[] = {
        {{{[PARAMETER_ID] = 7, [PARAMETER_LEFT_GAIN] = 15614, [PARAMETER_TRACK] = 323}},
         GIVEN(ID) | GIVEN(LEFT_GAIN) | GIVEN(TRACK)},
        {{{[PARAMETER_ID] = 3, [PARAMETER_LEFT_GAIN] = 8192}}, GIVEN(ID)},
    };
    char text[256] = "";

    write_to(path, robots, 2);
    FILE *in = fopen(path, "r");
    TEST_ASSERT_NOT_NULL(in);
    fread(text, 1, sizeof text - 1, in);
    fclose(in);
    TEST_ASSERT_EQUAL_STRING("schema: 1\n"
                             "robots:\n"
                             "  - id: 7\n"
                             "    left_gain: 0.95300\n"
                             "    track: 0.0808\n"
                             "  - id: 3\n",
                             text);
}

/* Lowest, highest and default values of all. */
static void test_what_is_written_is_read(void)
{
    struct parameter_entry robots[3];

    for (uint8_t i = 0; i < PARAMETERS_STORED_COUNT; i++) {
        robots[0].parameters.value[i] = parameter_line(i)->low;
        robots[1].parameters.value[i] = parameter_line(i)->high;
    }
    parameters_default(&robots[2].parameters);
    for (uint16_t i = 0; i < 3; i++) {
        robots[i].parameters.value[PARAMETER_ID] = i + 1;
        robots[i].given = (UINT32_C(1) << PARAMETERS_STORED_COUNT) - 1;
    }
    write_to(path, robots, 3);
    file = parameter_file_read(path, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(file, error);
    TEST_ASSERT_EQUAL_UINT(3, file->count);
    for (size_t i = 0; i < 3; i++) {
        TEST_ASSERT_EQUAL_HEX32(robots[i].given, file->robots[i].given);
        TEST_ASSERT_EQUAL_MEMORY(&robots[i].parameters, &file->robots[i].parameters,
                                 sizeof robots[i].parameters);
    }
}

static void test_files_that_cannot_be(void)
{
    const struct parameter_entry robot = {.given = GIVEN(ID)};

    TEST_ASSERT_NULL(parameter_file_read("/nowhere/p.yaml", error, sizeof error));
    TEST_ASSERT_EQUAL_STRING(
        "/nowhere/p.yaml:1:1: error: cannot be opened: No such file or directory", error);
    TEST_ASSERT_FALSE(parameter_file_write("/nowhere/p.yaml", &robot, 1, error, sizeof error));
    TEST_ASSERT_EQUAL_STRING("/nowhere/p.yaml: cannot be written: No such file or directory",
                             error);
    TEST_ASSERT_FALSE(parameter_file_write("/dev/full", &robot, 1, error, sizeof error));
    TEST_ASSERT_EQUAL_STRING("/dev/full: cannot be written: No space left on device", error);
}

int main(void)
{
    close(mkstemp(path));
    UNITY_BEGIN();
    RUN_TEST(test_what_is_given_and_what_is_not);
    RUN_TEST(test_robots_are_found_by_their_ids);
    RUN_TEST(test_refusals);
    RUN_TEST(test_the_text_of_a_file);
    RUN_TEST(test_what_is_written_is_read);
    RUN_TEST(test_files_that_cannot_be);
    unlink(path);
    return UNITY_END();
}
