#include "mocap.h"

#include "limits.h"

#include <math.h>
#include <unity.h>

#define SEED 5

static const struct body body = {.x = 1.25, .y = -0.5, .theta = 3};
static struct mocap mocap;

void setUp(void)
{
    mocap = mocap_of(&(struct scenario){.body = BODY_SMALL}, SEED);
}

void tearDown(void)
{
}

static struct server_pose pose_at(const struct mocap *by, uint64_t tick, uint16_t robot)
{
    struct mocap_sample sample = mocap_newest(by, tick);

    return mocap_pose(by, &sample, robot, &body);
}

static void test_an_ideal_robot_is_seen_as_it_is_and_at_once(void)
{
    struct mocap ideal = mocap_of(&(struct scenario){.body = BODY_IDEAL}, SEED);

    for (uint64_t tick = 0; tick < 1000; tick++) {
        struct server_pose pose = pose_at(&ideal, tick, 1);

        TEST_ASSERT_TRUE(mocap_newest(&ideal, tick).age == 0);
        TEST_ASSERT_EQUAL_UINT16(0, pose.age_ms);
        TEST_ASSERT_TRUE(pose.x == body.x && pose.y == body.y && pose.theta == body.theta);
        TEST_ASSERT_TRUE(pose.tracked);
    }
}

/* Twelve samples go into five ticks. */
static void test_samples_come_at_120_hz(void)
{
    static const unsigned ms[] = {0, 3, 7, 2, 5};

    for (uint64_t tick = 0; tick < 1000; tick++) {
        struct mocap_sample newest = mocap_newest(&mocap, tick);
        double at = (double)tick / TICKS_PER_S - newest.age;
        double samples = at * 120;

        TEST_ASSERT_TRUE(newest.age >= 0 && newest.age < 1 / 120.0);
        TEST_ASSERT_EQUAL_UINT64(lround(samples), newest.number);
        TEST_ASSERT_TRUE(fabs(samples - round(samples)) < 1e-6);
        TEST_ASSERT_EQUAL_UINT16(ms[tick % 5], pose_at(&mocap, tick, 1).age_ms);
    }
}

/* One coordinate's errors over many samples. */
struct errors {
    double sum, squares, largest;
};

#define SAMPLES 20000

static void add(struct errors *errors, double error)
{
    errors->sum += error;
    errors->squares += error * error;
    errors->largest = fmax(errors->largest, fabs(error));
}

static void are_noise(const struct errors *errors, double deviation)
{
    double measured = sqrt(errors->squares / SAMPLES);

    TEST_ASSERT_TRUE(fabs(errors->sum / SAMPLES) < 4 * deviation / sqrt(SAMPLES));
    TEST_ASSERT_TRUE(measured > 0.97 * deviation && measured < 1.03 * deviation);
    TEST_ASSERT_TRUE(errors->largest < 3.5 * deviation);
    TEST_ASSERT_TRUE(errors->largest > 3 * deviation);
}

static void test_the_noise_is_that_of_an_arena(void)
{
    struct errors x = {0}, y = {0}, theta = {0};

    for (uint64_t tick = 0; tick < SAMPLES; tick++) {
        struct server_pose pose = pose_at(&mocap, tick, 1);

        add(&x, pose.x - body.x);
        add(&y, pose.y - body.y);
        add(&theta, pose.theta - body.theta);
    }
    are_noise(&x, 0.0003);
    are_noise(&y, 0.0003);
    are_noise(&theta, 0.2 * M_PI / 180);
}

static double error_of(const struct mocap *by, uint64_t tick, uint16_t robot)
{
    return pose_at(by, tick, robot).x - body.x;
}

/* Products of errors that have nothing to do with one another come to nothing. */
static void test_robots_axes_samples_and_seeds_share_no_noise(void)
{
    struct mocap other = mocap_of(&(struct scenario){.body = BODY_SMALL}, SEED + 1);
    double robots = 0, samples = 0, seeds = 0, y = 0, theta = 0;
    double limit = 4 * 0.0003 * 0.0003 * sqrt(SAMPLES);

    for (uint64_t tick = 0; tick < SAMPLES; tick++) {
        struct server_pose pose = pose_at(&mocap, tick, 1);
        double x = pose.x - body.x;

        robots += x * error_of(&mocap, tick, 2);
        samples += x * error_of(&mocap, tick + 1, 1);
        seeds += x * error_of(&other, tick, 1);
        y += x * (pose.y - body.y);
        theta += x * (pose.theta - body.theta);
    }
    TEST_ASSERT_TRUE(fabs(robots) < limit);
    TEST_ASSERT_TRUE(fabs(samples) < limit);
    TEST_ASSERT_TRUE(fabs(seeds) < limit);
    TEST_ASSERT_TRUE(fabs(y) < limit);
    TEST_ASSERT_TRUE(fabs(theta) < 4 * 0.0003 * 0.0035 * sqrt(SAMPLES));
}

static void test_a_sample_is_what_it_is_whoever_asks_and_when(void)
{
    double late = error_of(&mocap, 999, 3);

    error_of(&mocap, 0, 3);
    TEST_ASSERT_TRUE(late == error_of(&mocap, 999, 3));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_ideal_robot_is_seen_as_it_is_and_at_once);
    RUN_TEST(test_samples_come_at_120_hz);
    RUN_TEST(test_the_noise_is_that_of_an_arena);
    RUN_TEST(test_robots_axes_samples_and_seeds_share_no_noise);
    RUN_TEST(test_a_sample_is_what_it_is_whoever_asks_and_when);
    return UNITY_END();
}
