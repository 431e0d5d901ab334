#include "rotation.h"

#include <math.h>
#include <unity.h>

#define HALF_SQUARE 0.70710678118654752

void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_turn(const double expected[4], const double turn[4])
{
    double sign = expected[0] * turn[0] + expected[1] * turn[1] + expected[2] * turn[2] +
                              expected[3] * turn[3] <
                          0
                      ? -1
                      : 1;

    for (int i = 0; i < 4; i++)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, expected[i], sign * turn[i]);
}

/* v turned by the quaternion. */
static void turn_by(const double q[4], const double v[3], double out[3])
{
    double t[3] = {2 * (q[1] * v[2] - q[2] * v[1]), 2 * (q[2] * v[0] - q[0] * v[2]),
                   2 * (q[0] * v[1] - q[1] * v[0])};

    out[0] = v[0] + q[3] * t[0] + q[1] * t[2] - q[2] * t[1];
    out[1] = v[1] + q[3] * t[1] + q[2] * t[0] - q[0] * t[2];
    out[2] = v[2] + q[3] * t[2] + q[0] * t[1] - q[1] * t[0];
}

static void test_quaternions(void)
{
    double turn[4];

    TEST_ASSERT_TRUE(rotation_of_quaternion((double[]){0, 0, 0.606, 0.808}, turn));
    assert_turn((double[]){0, 0, 0.6, 0.8}, turn);
    TEST_ASSERT_FALSE(rotation_of_quaternion((double[]){0, 0, 0, 0}, turn));
    assert_turn((double[]){0, 0, 0, 1}, turn);
    TEST_ASSERT_FALSE(rotation_of_quaternion((double[]){0, 0, 0, 1.1}, turn));
    TEST_ASSERT_FALSE(rotation_of_quaternion((double[]){0, NAN, 0, 1}, turn));
    TEST_ASSERT_FALSE(rotation_of_quaternion((double[]){0, INFINITY, 0, 1}, turn));
}

static void test_columns(void)
{
    double turn[4];

    /* x to y, y to -x: a quarter turn to the left. */
    TEST_ASSERT_TRUE(rotation_of_columns((double[]){0, 1, 0, -1, 0, 0, 0, 0, 1}, turn));
    assert_turn((double[]){0, 0, HALF_SQUARE, HALF_SQUARE}, turn);

    /* Half a turn about each axis, where w is 0. */
    TEST_ASSERT_TRUE(rotation_of_columns((double[]){1, 0, 0, 0, -1, 0, 0, 0, -1}, turn));
    assert_turn((double[]){1, 0, 0, 0}, turn);
    TEST_ASSERT_TRUE(rotation_of_columns((double[]){-1, 0, 0, 0, 1, 0, 0, 0, -1}, turn));
    assert_turn((double[]){0, 1, 0, 0}, turn);
    TEST_ASSERT_TRUE(rotation_of_columns((double[]){-1, 0, 0, 0, -1, 0, 0, 0, 1}, turn));
    assert_turn((double[]){0, 0, 1, 0}, turn);
}

static void test_no_rotations(void)
{
    double turn[4];

    TEST_ASSERT_FALSE(
        rotation_of_columns((double[]){1, 0, 0, 0, 1, 0, 0, 0, -1}, turn)); /* mirror */
    TEST_ASSERT_FALSE(rotation_of_columns((double[]){1, 0, 0, 1, 0, 0, 0, 0, 1}, turn));
    TEST_ASSERT_FALSE(rotation_of_columns((double[]){1.1, 0, 0, 0, 1, 0, 0, 0, 1}, turn));
    TEST_ASSERT_FALSE(rotation_of_columns((double[]){0, 0, 0, 0, 0, 0, 0, 0, 0}, turn));
    TEST_ASSERT_FALSE(rotation_of_columns((double[]){1, 0, 0, 0, NAN, 0, 0, 0, 1}, turn));
}

/* Turned by the quaternion, each axis is the matrix's column. */
static void test_columns_of_any_turn(void)
{
    for (int i = 0; i < 1000; i++) {
        double q[4] = {sin(i), sin(2.3 * i + 1), sin(3.7 * i + 2), sin(5.1 * i + 3)}, turn[4];
        double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        double columns[9];

        for (int k = 0; k < 4; k++)
            q[k] /= length;
        for (int k = 0; k < 3; k++)
            turn_by(q, (double[]){k == 0, k == 1, k == 2}, columns + 3 * k);
        TEST_ASSERT_TRUE(rotation_of_columns(columns, turn));
        assert_turn(q, turn);
    }
}

/* About x first, then about the body's new y, then about its newest z. */
static void test_angles(void)
{
    double turn[4], out[3];

    TEST_ASSERT_TRUE(rotation_of_angles((double[]){0, 0, M_PI / 2}, turn));
    assert_turn((double[]){0, 0, HALF_SQUARE, HALF_SQUARE}, turn);
    TEST_ASSERT_TRUE(rotation_of_angles((double[]){M_PI / 2, 0, M_PI / 2}, turn));
    turn_by(turn, (double[]){1, 0, 0}, out); /* to its y by the second, which the first put up */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, out[2]);
    TEST_ASSERT_TRUE(rotation_of_angles((double[]){M_PI / 2, M_PI / 2, 0}, turn));
    turn_by(turn, (double[]){0, 0, 1}, out); /* to its x by the second, which the first left */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1, out[0]);
    TEST_ASSERT_FALSE(rotation_of_angles((double[]){0, NAN, 0}, turn));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_quaternions);
    RUN_TEST(test_columns);
    RUN_TEST(test_no_rotations);
    RUN_TEST(test_columns_of_any_turn);
    RUN_TEST(test_angles);
    return UNITY_END();
}
