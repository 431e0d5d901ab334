#include "figures.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <unity.h>

static const char *const pictures[] = {"routes.svg", "routes.png", "distance_error.svg",
                                       "distance_error.png"};

#define PICTURES (sizeof pictures / sizeof pictures[0])

static char parent[] = "/tmp/muster-figures-XXXXXX";
static char dir[128];

static const char *in_dir(const char *name)
{
    static char path[256];

    snprintf(path, sizeof path, "%s/%s", dir, name);
    return path;
}

void setUp(void)
{
    strcpy(parent + strlen(parent) - 6, "XXXXXX");
    TEST_ASSERT_NOT_NULL(mkdtemp(parent));
    snprintf(dir, sizeof dir, "%s/a 'b' \"c\" $(d);", parent);
    TEST_ASSERT_EQUAL_INT(0, mkdir(dir, 0700));
}

void tearDown(void)
{
    for (size_t i = 0; i < PICTURES; i++)
        unlink(in_dir(pictures[i]));
    unlink(in_dir("trace.csv"));
    unlink(in_dir("events.csv"));
    rmdir(dir);
    rmdir(parent);
}

static void given_file(const char *name, const char *text)
{
    FILE *file = fopen(in_dir(name), "w");

    TEST_ASSERT_NOT_NULL(file);
    fputs(text, file);
    fclose(file);
}

/* Robots abreast on a circle; the first one leads and dies half-way. */
static void given_trace(unsigned robots, int ticks)
{
    FILE *file = fopen(in_dir("trace.csv"), "w");

    TEST_ASSERT_NOT_NULL(file);
    fputs("t,robot,x,y,theta,v,omega,role,vertex,distance_error,alive\n", file);
    for (int tick = 0; tick < ticks; tick++) {
        for (unsigned i = 0; i < robots; i++) {
            double t = tick / 50.0;
            bool alive = i > 0 || 2 * tick < ticks;
            fprintf(file, "%.2f,%u,%.6f,%.6f,0.0,1.0,0.1,%c,%u,%.6f,%d\n", t, i + 1,
                    (2 + i) * cos(t / 5), (2 + i) * sin(t / 5), i == 0 ? 'L' : 'F', i + 1,
                    alive ? exp(-t) * (1 + i) : 0, alive);
        }
    }
    fclose(file);
}

/* The file's bytes, to be freed. */
static char *read_picture(const char *name, size_t *length)
{
    FILE *file = fopen(in_dir(name), "rb");
    char *bytes = malloc(1 << 22);

    TEST_ASSERT_NOT_NULL_MESSAGE(file, name);
    TEST_ASSERT_NOT_NULL(bytes);
    *length = fread(bytes, 1, 1 << 22, file);
    fclose(file);
    return bytes;
}

static void assert_pictures(void)
{
    for (size_t i = 0; i < PICTURES; i++) {
        size_t length;
        char *bytes = read_picture(pictures[i], &length);
        bool png = strstr(pictures[i], ".png") != NULL;
        TEST_ASSERT_TRUE_MESSAGE(length > 2000, pictures[i]);
        TEST_ASSERT_EQUAL_MEMORY(png ? "\x89PNG" : "<?xm", bytes, 4);
        free(bytes);
    }
}

static void test_a_small_team(void)
{
    given_trace(4, 500);
    given_file("events.csv", "t,robot,event,detail\n"
                             "-0.10,1,role,L\n"
                             "5.00,1,kill,\n"
                             "6.00,0,formation,\n");
    TEST_ASSERT_EQUAL_INT(0, figures_write(dir));
    assert_pictures();
}

static void test_what_the_figures_say(void)
{
    size_t length;

    given_trace(4, 500);
    given_file("events.csv", "t,robot,event,detail\n5.00,1,kill,\n7.00,2,role,L\n");
    TEST_ASSERT_EQUAL_INT(0, figures_write(dir));

    char *svg = read_picture("distance_error.svg", &length);
    svg[length] = '\0';
    TEST_ASSERT_NOT_NULL(strstr(svg, "kill 1"));
    TEST_ASSERT_NULL(strstr(svg, "role"));
    TEST_ASSERT_NOT_NULL(strstr(svg, "mean"));
    TEST_ASSERT_NOT_NULL(strstr(svg, "robot 4"));
    free(svg);

    svg = read_picture("routes.svg", &length);
    svg[length] = '\0';
    TEST_ASSERT_NOT_NULL(strstr(svg, "5 s"));
    TEST_ASSERT_NOT_NULL(strstr(svg, "robot 4"));
    free(svg);
}

static void test_same_files_same_pictures(void)
{
    char *first[PICTURES];
    size_t lengths[PICTURES];

    given_trace(3, 200);
    TEST_ASSERT_EQUAL_INT(0, figures_write(dir));
    for (size_t i = 0; i < PICTURES; i++)
        first[i] = read_picture(pictures[i], &lengths[i]);
    TEST_ASSERT_EQUAL_INT(0, figures_write(dir));
    for (size_t i = 0; i < PICTURES; i++) {
        size_t length;
        char *second = read_picture(pictures[i], &length);
        TEST_ASSERT_EQUAL_UINT(lengths[i], length);
        TEST_ASSERT_EQUAL_MEMORY(first[i], second, length);
        free(first[i]);
        free(second);
    }
}

static void test_a_crowd(void)
{
    given_trace(100, 3000);
    TEST_ASSERT_EQUAL_INT(0, figures_write(dir));
    assert_pictures();
}

static void test_one_robot_one_tick(void)
{
    given_trace(1, 1);
    TEST_ASSERT_EQUAL_INT(0, figures_write(dir));
    assert_pictures();
}

static void test_no_trace(void)
{
    TEST_ASSERT_EQUAL_INT(-1, figures_write(dir));
    given_file("trace.csv", "");
    TEST_ASSERT_EQUAL_INT(-1, figures_write(dir));
    given_file("trace.csv", "t,robot\nthis,is,no,row\n");
    TEST_ASSERT_EQUAL_INT(-1, figures_write(dir));
}

static void test_no_gnuplot(void)
{
    char *path = strdup(getenv("PATH"));

    TEST_ASSERT_NOT_NULL(path);
    given_trace(2, 10);
    setenv("PATH", dir, true);
    int result = figures_write(dir);
    setenv("PATH", path, true);
    free(path);
    TEST_ASSERT_EQUAL_INT(-1, result);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_small_team);
    RUN_TEST(test_what_the_figures_say);
    RUN_TEST(test_same_files_same_pictures);
    RUN_TEST(test_a_crowd);
    RUN_TEST(test_one_robot_one_tick);
    RUN_TEST(test_no_trace);
    RUN_TEST(test_no_gnuplot);
    return UNITY_END();
}
