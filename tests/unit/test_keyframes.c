#include "keyframes.h"

#include <math.h>
#include <stdint.h>
#include <unity.h>

#define POINTS 1200

static struct keyframes_point points[POINTS];
static size_t picked[POINTS];
static uint32_t state;

void setUp(void)
{
    state = 1;
}

void tearDown(void)
{
}

/* -1 to 1 */
static double chance(void)
{
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 8388608.0 - 1;
}

/* A walk whose course changes at every point, and that leaps now and then. */
static void given_walk(size_t count, double leaps)
{
    double x = 0, y = 0, course = 0, t = 0;

    for (size_t i = 0; i < count; i++) {
        course += chance() / 5;
        x += cos(course) + (chance() > 1 - leaps ? 50 * chance() : 0);
        y += sin(course);
        t += 0.02 + 0.01 * chance();
        points[i] = (struct keyframes_point){t, {x, y}};
    }
}

/* The largest distance of any point from the straight way between the keyframes about it. */
static double worst(size_t keys)
{
    double off = 0;

    for (size_t k = 0; k + 1 < keys; k++) {
        const struct keyframes_point *a = &points[picked[k]], *b = &points[picked[k + 1]];
        for (size_t i = picked[k]; i <= picked[k + 1]; i++) {
            double share = (points[i].t - a->t) / (b->t - a->t);
            double dx = a->at[0] + share * (b->at[0] - a->at[0]) - points[i].at[0];
            double dy = a->at[1] + share * (b->at[1] - a->at[1]) - points[i].at[1];
            off = fmax(off, hypot(dx, dy));
        }
    }
    return off;
}

static void no_point_is_farther_off_than_allowed(void)
{
    static const double errors[] = {0.01, 0.3, 2, 20};

    for (int walk = 0; walk < 50; walk++) {
        given_walk(POINTS, walk % 5 / 100.0);
        for (size_t e = 0; e < 4; e++) {
            size_t keys = keyframes_pick(points, POINTS, errors[e], picked);

            TEST_ASSERT_TRUE(keys >= 2 && keys <= POINTS);
            TEST_ASSERT_EQUAL_UINT(0, picked[0]);
            TEST_ASSERT_EQUAL_UINT(POINTS - 1, picked[keys - 1]);
            for (size_t k = 1; k < keys; k++)
                TEST_ASSERT_TRUE(picked[k] > picked[k - 1]);
            TEST_ASSERT_TRUE(worst(keys) <= errors[e]);
        }
    }
}

static void a_steady_drive_has_two_keyframes_and_a_change_of_pace_a_third(void)
{
    for (size_t i = 0; i < 100; i++)
        points[i] = (struct keyframes_point){0.02 * (double)i, {3.0 * (double)i, 4.0 * (double)i}};
    TEST_ASSERT_EQUAL_UINT(2, keyframes_pick(points, 100, 0.1, picked));

    /* On the same line, but slower. */
    for (size_t i = 50; i < 100; i++)
        points[i].at[0] = 147 + (points[i].at[0] - 147) / 2,
        points[i].at[1] = 196 + (points[i].at[1] - 196) / 2;
    TEST_ASSERT_EQUAL_UINT(3, keyframes_pick(points, 100, 0.1, picked));
    TEST_ASSERT_EQUAL_UINT(49, picked[1]);
}

static void less_error_takes_more_keyframes(void)
{
    given_walk(POINTS, 0);
    size_t fine = keyframes_pick(points, POINTS, 0.05, picked);
    size_t coarse = keyframes_pick(points, POINTS, 1, picked);

    TEST_ASSERT_TRUE(coarse * 2 < fine);
}

static void one_point_is_one_keyframe(void)
{
    points[0] = (struct keyframes_point){3, {1, 2}};
    TEST_ASSERT_EQUAL_UINT(1, keyframes_pick(points, 1, 0.1, picked));
    TEST_ASSERT_EQUAL_UINT(0, picked[0]);
}

/* A recording may have two ticks of one time. */
static void points_of_one_time_do_not_divide_by_nothing(void)
{
    for (size_t i = 0; i < 10; i++)
        points[i] = (struct keyframes_point){i < 5 ? 0.1 : 0.2, {(double)i, 0}};
    size_t keys = keyframes_pick(points, 10, 0.1, picked);
    TEST_ASSERT_TRUE(keys >= 2 && keys <= 10);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(no_point_is_farther_off_than_allowed);
    RUN_TEST(a_steady_drive_has_two_keyframes_and_a_change_of_pace_a_third);
    RUN_TEST(less_error_takes_more_keyframes);
    RUN_TEST(one_point_is_one_keyframe);
    RUN_TEST(points_of_one_time_do_not_divide_by_nothing);
    return UNITY_END();
}
