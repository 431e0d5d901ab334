#include "trajectory.h"

#include "random.h"

#include <math.h>
#include <unity.h>

#define RAD(angle) ((angle)*2 * M_PI / ANGLE_TURN)

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

static int16_t draw_within(int16_t limit)
{
    return (int16_t)((int32_t)(draw() % (2 * (uint32_t)limit + 1)) - limit);
}

static struct knot draw_knot(int32_t time, int16_t v_limit, int16_t omega_limit)
{
    return (struct knot){.time = time,
                         .pose = {{(int32_t)draw() >> 9, (int32_t)draw() >> 9}, (angle_t)draw()},
                         .v = draw_within(v_limit),
                         .omega = draw_within(omega_limit)};
}

static void test_at_a_knot_the_reference_is_the_knot(void)
{
    for (int i = 0; i < 100000; i++) {
        struct knot from = draw_knot(draw() % 1000000, INT16_MAX, INT16_MAX);
        int32_t span = 1 + draw() % KNOT_SPACING_MAX_MS;
        struct knot to = draw_knot(from.time + span, INT16_MAX, INT16_MAX);
        struct reference first = reference_between(&from, &to, from.time);
        struct reference last = reference_between(&from, &to, to.time);

        TEST_ASSERT_EQUAL_MEMORY(&from.pose, &first.pose, sizeof from.pose);
        TEST_ASSERT_EQUAL_INT16(from.v, first.v);
        TEST_ASSERT_EQUAL_INT16(from.omega, first.omega);
        TEST_ASSERT_EQUAL_INT16(to.v, last.v);
        TEST_ASSERT_EQUAL_INT16(to.omega, last.omega);
    }
}

static void test_speed_and_rate_run_linearly(void)
{
    for (int i = 0; i < 100000; i++) {
        struct knot from = draw_knot(draw() % 1000000, 16000, 20000);
        int32_t span = 1 + draw() % KNOT_SPACING_MAX_MS;
        struct knot to = draw_knot(from.time + span, 16000, 20000);
        int32_t since = (int32_t)(draw() % ((uint32_t)span + 1));
        struct reference r = reference_between(&from, &to, from.time + since);
        double v_dot = (to.v - from.v) * 1000.0 / span;
        double omega_dot = (to.omega - from.omega) * 1000.0 / span;

        TEST_ASSERT_DOUBLE_WITHIN(1, from.v + v_dot * since / 1000, r.v);
        TEST_ASSERT_DOUBLE_WITHIN(1, from.omega + omega_dot * since / 1000, r.omega);
        TEST_ASSERT_DOUBLE_WITHIN(1, fmax(-INT16_MAX, fmin(v_dot, INT16_MAX)), r.v_dot);
        TEST_ASSERT_DOUBLE_WITHIN(1, fmax(-INT16_MAX, fmin(omega_dot, INT16_MAX)), r.omega_dot);
    }
}

/* Equation 1 of the paper with v and omega linear in time, in small steps of the midpoint rule. */
static void integrate(const struct knot *from, const struct knot *to, double since, double *x,
                      double *y, double *theta)
{
    const int steps = 200;
    double span = (to->time - from->time) / 1000.0, dt = since / 1000 / steps;

    *x = *y = 0;
    *theta = RAD(from->pose.theta);
    for (int i = 0; i < steps; i++) {
        double part = (i + 0.5) * dt / span;
        double v = from->v + (to->v - from->v) * part;
        double omega = (from->omega + (to->omega - from->omega) * part) / RATE_ONE;

        *x += v * dt * cos(*theta + omega * dt / 2);
        *y += v * dt * sin(*theta + omega * dt / 2);
        *theta += omega * dt;
    }
}

/* Up to 2 m/s and 2 rad/s, changing by 1 m/s^2 and 1 rad/s^2, knots 100 ms apart: within 1 mm and
 * 3 units of heading of where the trajectory is. */
static void test_the_pose_follows_equation_1(void)
{
    for (int i = 0; i < 20000; i++) {
        struct knot from = draw_knot(draw() % 1000000, 7600, 1948);
        struct knot to = {.time = from.time + 100,
                          .v = (int16_t)(from.v + draw_within(400)),
                          .omega = (int16_t)(from.omega + draw_within(100))};
        int32_t since = draw() % 101;
        struct reference r = reference_between(&from, &to, from.time + since);
        double x, y, theta;

        integrate(&from, &to, since, &x, &y, &theta);
        TEST_ASSERT_DOUBLE_WITHIN(NARROW_PER_M / 1000, from.pose.at.x + x, r.pose.at.x);
        TEST_ASSERT_DOUBLE_WITHIN(NARROW_PER_M / 1000, from.pose.at.y + y, r.pose.at.y);
        TEST_ASSERT_DOUBLE_WITHIN(
            3, 0, remainder(r.pose.theta - theta * ANGLE_TURN / (2 * M_PI), ANGLE_TURN));
    }
}

static void test_after_the_last_knot_it_goes_straight_on(void)
{
    struct knot last = {.time = 5000, .pose = {{100, -200}, 16384}, .v = 4000, .omega = 0};
    struct reference r = reference_after(&last, 5500);

    TEST_ASSERT_INT32_WITHIN(1, 100, r.pose.at.x);
    TEST_ASSERT_INT32_WITHIN(1, 1800, r.pose.at.y);
    TEST_ASSERT_EQUAL_INT16(4000, r.v);
    TEST_ASSERT_EQUAL_INT16(0, r.v_dot);
    TEST_ASSERT_EQUAL_INT16(0, r.omega_dot);
}

static void test_without_new_knots_it_comes_to_stand(void)
{
    struct knot last = {.time = 5000, .pose = {{100, -200}, 16384}, .v = 4000, .omega = 512};
    struct reference at_limit = reference_after(&last, 5000 + KNOT_SPACING_MAX_MS);
    struct reference beyond = reference_after(&last, 5001 + KNOT_SPACING_MAX_MS);
    struct reference much_later = reference_after(&last, 1000000000);

    TEST_ASSERT_EQUAL_INT16(4000, at_limit.v);
    TEST_ASSERT_EQUAL_INT16(512, at_limit.omega);
    TEST_ASSERT_EQUAL_MEMORY(&at_limit.pose, &beyond.pose, sizeof beyond.pose);
    TEST_ASSERT_EQUAL_MEMORY(&at_limit.pose, &much_later.pose, sizeof beyond.pose);
    TEST_ASSERT_EQUAL_INT16(0, beyond.v);
    TEST_ASSERT_EQUAL_INT16(0, beyond.omega);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_at_a_knot_the_reference_is_the_knot);
    RUN_TEST(test_speed_and_rate_run_linearly);
    RUN_TEST(test_the_pose_follows_equation_1);
    RUN_TEST(test_after_the_last_knot_it_goes_straight_on);
    RUN_TEST(test_without_new_knots_it_comes_to_stand);
    return UNITY_END();
}
