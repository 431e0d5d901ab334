#include "directory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <unity.h>

static char dir[] = "/tmp/muster-directory-XXXXXX";
static char error[256];

static const char *in_dir(const char *name)
{
    static char path[256];

    snprintf(path, sizeof path, "%s/%s", dir, name);
    return path;
}

void setUp(void)
{
    strcpy(dir + strlen(dir) - 6, "XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(dir));
    error[0] = '\0';
}

void tearDown(void)
{
    unlink(in_dir("notes.txt"));
    rmdir(in_dir("runs/of/today"));
    rmdir(in_dir("runs/of"));
    rmdir(in_dir("runs"));
    rmdir(dir);
}

static void put(const char *name)
{
    FILE *file = fopen(in_dir(name), "w");

    TEST_ASSERT_NOT_NULL(file);
    fclose(file);
}

static bool is_there(const char *name)
{
    return access(in_dir(name), F_OK) == 0;
}

static void test_those_above_are_made_too(void)
{
    TEST_ASSERT_TRUE_MESSAGE(directory_prepare(in_dir("runs/of/today"), error, sizeof error),
                             error);
    TEST_ASSERT_TRUE(is_there("runs/of/today/."));
    TEST_ASSERT_TRUE(directory_prepare(in_dir("runs/of/today/"), error, sizeof error));
}

static void test_an_earlier_run_is_removed_and_nothing_else(void)
{
    static const char *const names[] = {"trace.csv",          "run.mcap",     "routes.svg",
                                        "routes.png",         "summary.json", "distance_error.svg",
                                        "distance_error.png", "report.html"};

    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        put(names[i]);
    put("notes.txt");
    TEST_ASSERT_TRUE_MESSAGE(directory_prepare(dir, error, sizeof error), error);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        TEST_ASSERT_FALSE_MESSAGE(is_there(names[i]), names[i]);
    TEST_ASSERT_TRUE(is_there("notes.txt"));
}

static void test_a_file_in_the_way_gives_words(void)
{
    put("notes.txt");
    TEST_ASSERT_FALSE(directory_prepare(in_dir("notes.txt/run"), error, sizeof error));
    TEST_ASSERT_NOT_NULL(strstr(error, "cannot make the directory"));
    TEST_ASSERT_NOT_NULL(strstr(error, in_dir("notes.txt/run")));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_those_above_are_made_too);
    RUN_TEST(test_an_earlier_run_is_removed_and_nothing_else);
    RUN_TEST(test_a_file_in_the_way_gives_words);
    return UNITY_END();
}
