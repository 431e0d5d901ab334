#include "fixed.h"
#include "random.h"

#include <math.h>
#include <stdlib.h>
#include <unity.h>

#define TURN_RAD (2 * M_PI)
#define RAD(angle) ((angle)*TURN_RAD / ANGLE_TURN)

static uint32_t state;

void setUp(void)
{
    state = 1;
}

void tearDown(void)
{
}

static uint32_t draw(void)
{
    return random_next(&state);
}

/* Of any size from a few units up: `bits` are drawn, then shifted down by up to 15. */
static int16_t draw_narrow(void)
{
    return saturate16((int16_t)draw() >> draw() % 16);
}

static double away(double a, double b, double turn)
{
    return fabs(remainder(a - b, turn));
}

static void test_sine_and_cosine_are_within_a_unit_at_every_angle(void)
{
    for (int32_t angle = 0; angle < ANGLE_TURN; angle++) {
        struct sincos got = sincos_of((angle_t)angle);

        TEST_ASSERT_DOUBLE_WITHIN(1.01, fmin(32768 * sin(RAD(angle)), 32767), got.sin);
        TEST_ASSERT_DOUBLE_WITHIN(1.01, fmin(32768 * cos(RAD(angle)), 32767), got.cos);
    }
}

static void test_quarter_turns_are_exact(void)
{
    struct sincos at[4] = {sincos_of(0), sincos_of(16384), sincos_of(32768), sincos_of(49152)};

    TEST_ASSERT_EQUAL_INT16(0, at[0].sin);
    TEST_ASSERT_EQUAL_INT16(32767, at[0].cos);
    TEST_ASSERT_EQUAL_INT16(32767, at[1].sin);
    TEST_ASSERT_EQUAL_INT16(0, at[1].cos);
    TEST_ASSERT_EQUAL_INT16(0, at[2].sin);
    TEST_ASSERT_EQUAL_INT16(-32767, at[2].cos);
    TEST_ASSERT_EQUAL_INT16(-32767, at[3].sin);
    TEST_ASSERT_EQUAL_INT16(0, at[3].cos);
}

static void test_directions_are_within_a_unit(void)
{
    for (int i = 0; i < 1000000; i++) {
        struct vec16 v = {draw_narrow(), draw_narrow()};
        double exact = atan2(v.y, v.x) * ANGLE_TURN / TURN_RAD;

        if (v.x == 0 && v.y == 0)
            continue;
        TEST_ASSERT_TRUE(away(direction_of(v), exact, ANGLE_TURN) < 1);
    }
}

static void test_directions_at_the_edges(void)
{
    TEST_ASSERT_EQUAL_UINT16(0, direction_of((struct vec16){0, 0}));
    TEST_ASSERT_EQUAL_UINT16(0, direction_of((struct vec16){1, 0}));
    TEST_ASSERT_EQUAL_UINT16(16384, direction_of((struct vec16){0, 1}));
    TEST_ASSERT_EQUAL_UINT16(32768, direction_of((struct vec16){-1, 0}));
    TEST_ASSERT_EQUAL_UINT16(49152, direction_of((struct vec16){0, -1}));
    TEST_ASSERT_EQUAL_UINT16(8192, direction_of((struct vec16){32767, 32767}));
    TEST_ASSERT_EQUAL_UINT16(40960, direction_of((struct vec16){-32767, -32767}));
}

static void test_how_fast_a_vector_turns(void)
{
    for (int i = 0; i < 1000000; i++) {
        struct vec16 v = {draw_narrow(), draw_narrow()};
        struct vec16 w = {draw_narrow(), draw_narrow()};
        double square = (double)v.x * v.x + (double)v.y * v.y;

        if (square < 32 * 32)
            continue;
        double exact = ((double)v.x * w.y - (double)v.y * w.x) / square * RATE_ONE;
        double bound = 3 + (0.001 * hypot(w.x, w.y) + 5) / sqrt(square) * RATE_ONE;
        double limited = fmax(-INT16_MAX, fmin(INT16_MAX, exact));
        TEST_ASSERT_TRUE(fabs(course_of(v, w).turn - limited) < bound);
    }
}

static void test_saturating_leaves_alone_what_fits(void)
{
    struct vec16 got = vec_saturate(-32767, 32767);

    TEST_ASSERT_EQUAL_INT16(-32767, got.x);
    TEST_ASSERT_EQUAL_INT16(32767, got.y);
}

static void test_saturating_keeps_the_direction(void)
{
    for (int i = 0; i < 1000000; i++) {
        struct vec32 v = {(int32_t)draw() >> draw() % 20, (int32_t)draw() >> draw() % 20};
        struct vec16 got = vec_saturate(v.x, v.y);
        int32_t longer = abs32(got.x) > abs32(got.y) ? abs32(got.x) : abs32(got.y);

        if (v.x == got.x && v.y == got.y)
            continue;
        TEST_ASSERT_TRUE(away(atan2(got.y, got.x), atan2(v.y, v.x), TURN_RAD) < RAD(1));
        TEST_ASSERT_GREATER_OR_EQUAL_INT32(INT16_MAX / 2, longer);
        TEST_ASSERT_LESS_OR_EQUAL_INT32(INT16_MAX, longer);
    }
}

static void test_saturating_the_largest(void)
{
    struct vec16 got = vec_saturate(INT32_MIN, INT32_MAX);

    TEST_ASSERT_INT16_WITHIN(1, -got.x, got.y);
    TEST_ASSERT_TRUE(got.x < -INT16_MAX / 2);
}

static double length(struct vec32 v)
{
    return hypot(v.x, v.y);
}

static int sign(double value)
{
    return (value > 0) - (value < 0);
}

static void test_lengths_of_narrow_vectors_compare_exactly(void)
{
    for (int i = 0; i < 1000000; i++) {
        struct vec32 a = {draw_narrow(), draw_narrow()};
        struct vec32 b = {a.y, -a.x};

        TEST_ASSERT_EQUAL_INT8(0, vec_compare(&a, &b));
        b.x += b.x < INT16_MAX ? 1 : -1;
        TEST_ASSERT_EQUAL_INT8(sign(length(a) - length(b)), vec_compare(&a, &b));
    }
}

static void test_lengths_of_long_vectors_compare_where_they_differ(void)
{
    for (int i = 0; i < 1000000; i++) {
        struct vec32 a = {(int32_t)draw() >> draw() % 20, (int32_t)draw() >> draw() % 20};
        struct vec32 b = {(int32_t)draw() >> draw() % 20, (int32_t)draw() >> draw() % 20};
        double difference = length(a) - length(b);

        if (fabs(difference) > fmax(length(a), length(b)) / 4096)
            TEST_ASSERT_EQUAL_INT8(sign(difference), vec_compare(&a, &b));
    }
}

/* One from the sine, one from the cosine, half from rounding. */
static void test_rotating_is_within_two_and_a_half_units(void)
{
    for (int i = 0; i < 1000000; i++) {
        struct vec16 v = {(int16_t)(draw() % 46341) - 23170, (int16_t)(draw() % 46341) - 23170};
        angle_t angle = (angle_t)draw();
        double c = cos(RAD(angle)), s = sin(RAD(angle));
        struct vec16 on = vec_rotate(v, sincos_of(angle));
        struct vec16 back = vec_rotate_back(v, sincos_of(angle));

        TEST_ASSERT_DOUBLE_WITHIN(2.5, v.x * c - v.y * s, on.x);
        TEST_ASSERT_DOUBLE_WITHIN(2.5, v.x * s + v.y * c, on.y);
        TEST_ASSERT_DOUBLE_WITHIN(2.5, v.x * c + v.y * s, back.x);
        TEST_ASSERT_DOUBLE_WITHIN(2.5, v.y * c - v.x * s, back.y);
    }
}

static int16_t draw_ms(void)
{
    return (int16_t)(draw() % 2001) - 1000;
}

static void test_a_rate_over_time_is_an_angle(void)
{
    for (int i = 0; i < 1000000; i++) {
        int16_t rate = saturate16((int16_t)draw()), ms = draw_ms();
        double exact = (double)rate / RATE_ONE * ms / 1000 * ANGLE_TURN / TURN_RAD;

        TEST_ASSERT_TRUE(away(angle_of_rate(rate, ms), exact, ANGLE_TURN) <
                         1 + 8e-5 * fabs(exact) + abs32(rate) / 4096.0);
    }
}

static void test_a_speed_over_time_is_a_distance(void)
{
    for (int i = 0; i < 1000000; i++) {
        int16_t speed = saturate16((int16_t)draw()), ms = draw_ms();
        double exact = (double)speed * ms / 1000;

        TEST_ASSERT_DOUBLE_WITHIN(2 + 8e-5 * fabs(exact), exact, distance_of_speed(speed, ms));
    }
}

/* Equation 1 of the paper, integrated exactly, as far as v and omega carry a pose in `ms`. */
static void exact_arc(double theta, int16_t speed, int16_t rate, int16_t ms, double *x, double *y)
{
    double t = ms / 1000.0;
    double turn = (double)rate / RATE_ONE * t;
    double chord = turn == 0 ? speed * t : speed * t * sin(turn / 2) / (turn / 2);

    *x = chord * cos(theta + turn / 2);
    *y = chord * sin(theta + turn / 2);
}

/* A chord is the arc less turn^2 / 24 of it. */
static double chord_bound(int16_t speed, int16_t rate, int16_t ms)
{
    double turn = (double)rate / RATE_ONE * ms / 1000;

    return 2.5 + fabs(speed * ms / 1000.0) * (turn * turn / 24 + 3e-4);
}

static void test_a_pose_advances_along_its_arc(void)
{
    for (int i = 0; i < 1000000; i++) {
        struct pose from = {{(int32_t)draw() >> 8, (int32_t)draw() >> 8}, (angle_t)draw()};
        int16_t speed = (int16_t)(draw() % 32001) - 16000;
        int16_t rate = (int16_t)(draw() % 10241) - 5120;
        int16_t ms = draw() % 101;
        struct pose to = from;
        double x, y;

        pose_advance(&to, speed, rate, ms);
        exact_arc(RAD(from.theta), speed, rate, ms, &x, &y);
        TEST_ASSERT_TRUE(hypot(to.at.x - from.at.x - x, to.at.y - from.at.y - y) <
                         chord_bound(speed, rate, ms));
        TEST_ASSERT_EQUAL_UINT16((angle_t)(from.theta + (angle_t)angle_of_rate(rate, ms)),
                                 to.theta);
    }
}

static void test_a_pose_stays_where_it_is_without_time_or_speed(void)
{
    struct pose from = {{-8000000, 8000000}, 12345};
    struct pose still = from;
    struct pose now = from;

    pose_advance(&still, 0, 0, 1000);
    pose_advance(&now, 32767, -32767, 0);
    TEST_ASSERT_EQUAL_MEMORY(&from, &still, sizeof from);
    TEST_ASSERT_EQUAL_MEMORY(&from, &now, sizeof from);
}

static void test_products_in_q15_are_rounded(void)
{
    TEST_ASSERT_EQUAL_INT16(16384, mul_q15(32767, 16384));
    TEST_ASSERT_EQUAL_INT16(1, mul_q15(1, 16384));
    TEST_ASSERT_EQUAL_INT16(0, mul_q15(1, 16383));
    TEST_ASSERT_EQUAL_INT16(0, mul_q15(-1, 16384));
    TEST_ASSERT_EQUAL_INT16(-32766, mul_q15(-32767, 32767));
}

static void test_numbers_saturate(void)
{
    TEST_ASSERT_EQUAL_INT16(32767, saturate16(32768));
    TEST_ASSERT_EQUAL_INT16(-32767, saturate16(-32768));
    TEST_ASSERT_EQUAL_INT16(32767, saturate16(INT32_MAX));
    TEST_ASSERT_EQUAL_INT16(-32767, saturate16(INT32_MIN));
    TEST_ASSERT_EQUAL_INT16(-5, saturate16(-5));
    TEST_ASSERT_EQUAL_INT32(100, clamp32(101, 100));
    TEST_ASSERT_EQUAL_INT32(-100, clamp32(-101, 100));
    TEST_ASSERT_EQUAL_INT32(99, clamp32(99, 100));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sine_and_cosine_are_within_a_unit_at_every_angle);
    RUN_TEST(test_quarter_turns_are_exact);
    RUN_TEST(test_directions_are_within_a_unit);
    RUN_TEST(test_directions_at_the_edges);
    RUN_TEST(test_how_fast_a_vector_turns);
    RUN_TEST(test_saturating_leaves_alone_what_fits);
    RUN_TEST(test_saturating_keeps_the_direction);
    RUN_TEST(test_saturating_the_largest);
    RUN_TEST(test_lengths_of_narrow_vectors_compare_exactly);
    RUN_TEST(test_lengths_of_long_vectors_compare_where_they_differ);
    RUN_TEST(test_rotating_is_within_two_and_a_half_units);
    RUN_TEST(test_a_rate_over_time_is_an_angle);
    RUN_TEST(test_a_speed_over_time_is_a_distance);
    RUN_TEST(test_a_pose_advances_along_its_arc);
    RUN_TEST(test_a_pose_stays_where_it_is_without_time_or_speed);
    RUN_TEST(test_products_in_q15_are_rounded);
    RUN_TEST(test_numbers_saturate);
    return UNITY_END();
}
