#include "body.h"

#include "limits.h"
#include "random.h"

#include <math.h>
#include <unity.h>

#define FULL PWM_STEPS

static const struct body_kind ideal = {
    .track = 0.1, .wheel_max = 1, .left = {1, 0}, .right = {1, 0}};
static struct body body;

void setUp(void)
{
    body = (struct body){.theta = 0};
}

void tearDown(void)
{
}

static void assert_at(double x, double y, double theta)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, x, body.x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, y, body.y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0, remainder(body.theta - theta, 2 * M_PI));
}

static void test_straight_on(void)
{
    body.theta = M_PI / 6;
    body_move(&ideal, &body, FULL, FULL, 2);
    assert_at(sqrt(3), 1, M_PI / 6);
    body_move(&ideal, &body, -FULL, -FULL, 2);
    assert_at(0, 0, M_PI / 6);
}

static void test_on_the_spot(void)
{
    body_move(&ideal, &body, -FULL, FULL, 0.1); /* 20 rad/s */
    assert_at(0, 0, 2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0, body_v(&body));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 20, body_omega(&ideal, &body));
}

static void test_one_wheel_turns_about_the_other(void)
{
    body_move(&ideal, &body, 0, FULL, M_PI / 20); /* 10 rad/s: a quarter turn */
    assert_at(0.05, 0.05, M_PI / 2);
}

/* In any number of steps. */
static void test_a_full_circle_returns(void)
{
    for (int steps = 1; steps <= 1000; steps = steps * 3 + 1) {
        setUp();
        body.x = -7;
        body.y = 3;
        body.theta = 1;
        double omega = (FULL - 5000) * ideal.wheel_max / PWM_STEPS / ideal.track;
        for (int i = 0; i < steps; i++)
            body_move(&ideal, &body, 5000, FULL, 2 * M_PI / omega / steps);
        assert_at(-7, 3, 1);
    }
}

static void test_any_arc_is_exact(void)
{
    uint32_t state = 1;

    for (int i = 0; i < 10000; i++) {
        int16_t left = (int16_t)(random_next(&state) % (2 * FULL + 1)) - FULL;
        int16_t right = (int16_t)(random_next(&state) % (2 * FULL + 1)) - FULL;
        double v = (left + right) / 2.0 / FULL;
        double omega = (right - left) / 0.1 / FULL;

        if (left == right)
            continue;
        setUp();
        body_move(&ideal, &body, left, right, 0.02);
        assert_at(v / omega * sin(omega * 0.02), v / omega * (1 - cos(omega * 0.02)), omega * 0.02);
    }
}

static void test_the_heading_stays_within_half_a_turn(void)
{
    for (int i = 0; i < 1000; i++) {
        body_move(&ideal, &body, -FULL, FULL, 0.02);
        TEST_ASSERT_TRUE(fabs(body.theta) <= M_PI);
    }
}

static void test_an_ideal_body_obeys_at_once(void)
{
    body_move(&ideal, &body, FULL, -FULL, 0.02);
    body_move(&ideal, &body, 0, 0, 0.02);
    TEST_ASSERT_TRUE(body_v(&body) == 0 && body_omega(&ideal, &body) == 0);
    double theta = body.theta;
    body_move(&ideal, &body, 0, 0, 1);
    TEST_ASSERT_TRUE(body.theta == theta);
}

static void test_held_stands_still(void)
{
    body = (struct body){.x = 1, .y = 2, .theta = 3, .left = 0.5, .right = 0.4, .held = true};
    body_move(&ideal, &body, FULL, FULL, 1);
    assert_at(1, 2, 3);
    TEST_ASSERT_TRUE(body_v(&body) == 0 && body_omega(&ideal, &body) == 0);
}

static void test_an_ideal_body_is_as_fast_as_the_law_may_ask(void)
{
    struct scenario scenario = {.body = BODY_IDEAL, .v_max = 4, .omega_max = 10};
    struct body_kind kind = body_kind_of(&scenario, 7);

    TEST_ASSERT_TRUE(kind.lag == 0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 4 + 10 * kind.track / 2, kind.wheel_max);
}

static struct body_kind small(void)
{
    return body_kind_nominal(&(struct scenario){.body = BODY_SMALL, .v_max = 4, .omega_max = 10});
}

/* The paper's robot is 80 mm wide; its motors do 0.6 m/s, whatever the law would like. */
static void test_a_small_body_has_its_own_limits(void)
{
    struct body_kind kind = small();

    body_move(&kind, &body, FULL, FULL, 5);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.6, body_v(&body));
    body_move(&kind, &body, -FULL, FULL, 5);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.2 / 0.08, body_omega(&kind, &body));
}

/* A first-order lag of 50 ms: the speed after t is 1 - e^(-t/T) of what is wanted, and the way
 * falls short by T times the speed gained. */
static void test_a_small_bodys_wheels_lag(void)
{
    struct body_kind kind = small();

    body_move(&kind, &body, FULL / 2, FULL / 2, 0.05);
    double wanted = 0.6 * (FULL / 2) / FULL;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, wanted * (1 - exp(-1)), body_v(&body));
    TEST_ASSERT_DOUBLE_WITHIN(0.0002, wanted * 0.05 * exp(-1), body.x);
    body_move(&kind, &body, FULL / 2, FULL / 2, 0.95);
    TEST_ASSERT_DOUBLE_WITHIN(0.0002, wanted * (1 - 0.05), body.x);
}

static void test_a_small_body_lags_the_same_however_time_is_cut(void)
{
    struct body_kind kind = small();

    body_move(&kind, &body, 3000, 9000, 0.02);
    struct body whole = body;
    setUp();
    body_move(&kind, &body, 3000, 9000, 0.005);
    body_move(&kind, &body, 3000, 9000, 0.015);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, whole.x, body.x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, whole.y, body.y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, whole.left, body.left);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, whole.right, body.right);
}

static void test_a_small_body_that_is_held_has_no_momentum(void)
{
    struct body_kind kind = small();

    body_move(&kind, &body, FULL, FULL, 1);
    body.held = true;
    double x = body.x;
    body_move(&kind, &body, FULL, FULL, 1);
    TEST_ASSERT_TRUE(body.x == x);
    body.held = false;
    body_move(&kind, &body, 0, 0, 1);
    TEST_ASSERT_TRUE(body.x == x);
}

/* A wheel of half the speed that stands up to 4000 steps: at 4000 + k of the 12383 steps that are
 * left it does k / 12383 of that, forwards and back. */
static void test_a_wheels_gain_and_dead_band(void)
{
    struct body_kind kind = {.wheel_max = 0.6, .left = {0.5, 4000}};

    TEST_ASSERT_TRUE(body_wheel_speed(&kind, &kind.left, 0) == 0);
    TEST_ASSERT_TRUE(body_wheel_speed(&kind, &kind.left, 4000) == 0);
    TEST_ASSERT_TRUE(body_wheel_speed(&kind, &kind.left, -4000) == 0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3 / 12383, body_wheel_speed(&kind, &kind.left, 4001));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.3 / 12383, body_wheel_speed(&kind, &kind.left, -4001));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.3, body_wheel_speed(&kind, &kind.left, FULL));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.3, body_wheel_speed(&kind, &kind.left, -FULL));
}

static void test_each_wheel_has_its_own(void)
{
    struct body_kind kind = {
        .track = 0.1, .wheel_max = 1, .left = {0.9, 0}, .right = {1.1, FULL / 2.0}};

    body_move(&kind, &body, FULL, FULL, 0.02);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.9, body.left);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.1, body.right);
    body_move(&kind, &body, FULL / 2, FULL / 2, 0.02);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.45, body.left);
    TEST_ASSERT_TRUE(body.right == 0);
}

static void test_without_scatter_robots_are_as_designed(void)
{
    struct scenario scenario = {.body = BODY_SMALL};
    struct body_kind nominal = body_kind_nominal(&scenario);
    struct body_kind kind = body_kind_of(&scenario, 7);

    TEST_ASSERT_EQUAL_MEMORY(&nominal, &kind, sizeof kind);
    TEST_ASSERT_TRUE(kind.left.gain == 1 && kind.right.gain == 1);
    TEST_ASSERT_TRUE(kind.left.dead_band == 0 && kind.right.dead_band == 0);
}

/* Least and most of what 1,000 robots have of one part. */
struct spread {
    double least, most;
};

static void add(struct spread *spread, double value)
{
    spread->least = fmin(spread->least, value);
    spread->most = fmax(spread->most, value);
}

/* Within the bounds, and near both of them. */
static void assert_fills(double low, double high, struct spread spread)
{
    double margin = (high - low) / 50;

    TEST_ASSERT_TRUE(spread.least >= low && spread.least < low + margin);
    TEST_ASSERT_TRUE(spread.most <= high && spread.most > high - margin);
}

static void test_scattered_robots_fill_their_ranges(void)
{
    const struct scenario scenario = {.body = BODY_SMALL, .scatter = 0.1};
    enum { LEFT, RIGHT, LEFT_DEAD, RIGHT_DEAD, TRACK, LAG, PARTS };
    struct spread spread[PARTS];

    for (int part = 0; part < PARTS; part++)
        spread[part] = (struct spread){INFINITY, -INFINITY};
    for (uint16_t id = 1; id <= 1000; id++) {
        struct body_kind kind = body_kind_of(&scenario, id);

        add(&spread[LEFT], kind.left.gain);
        add(&spread[RIGHT], kind.right.gain);
        add(&spread[LEFT_DEAD], kind.left.dead_band / FULL);
        add(&spread[RIGHT_DEAD], kind.right.dead_band / FULL);
        add(&spread[TRACK], kind.track);
        add(&spread[LAG], kind.lag);
        TEST_ASSERT_TRUE(kind.wheel_max == 0.6);
    }
    assert_fills(0.9, 1.1, spread[LEFT]);
    assert_fills(0.9, 1.1, spread[RIGHT]);
    assert_fills(0, 0.05, spread[LEFT_DEAD]);
    assert_fills(0, 0.05, spread[RIGHT_DEAD]);
    assert_fills(0.0784, 0.0816, spread[TRACK]);
    assert_fills(0.045, 0.055, spread[LAG]);
}

/* No part of a robot tells of another part. */
static void test_a_robots_parts_differ(void)
{
    struct body_kind kind = body_kind_of(&(struct scenario){.body = BODY_SMALL, .scatter = 0.1}, 3);

    TEST_ASSERT_TRUE(fabs(kind.left.gain - kind.right.gain) > 1e-3);
    TEST_ASSERT_TRUE(fabs(kind.left.dead_band - kind.right.dead_band) > 1);
    TEST_ASSERT_TRUE(fabs(kind.track / 0.08 - 1 - (kind.left.gain - 1) / 5) > 1e-4);
    TEST_ASSERT_TRUE(fabs(kind.lag / 0.05 - kind.left.gain) > 1e-4);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_straight_on);
    RUN_TEST(test_on_the_spot);
    RUN_TEST(test_one_wheel_turns_about_the_other);
    RUN_TEST(test_a_full_circle_returns);
    RUN_TEST(test_any_arc_is_exact);
    RUN_TEST(test_the_heading_stays_within_half_a_turn);
    RUN_TEST(test_an_ideal_body_obeys_at_once);
    RUN_TEST(test_held_stands_still);
    RUN_TEST(test_an_ideal_body_is_as_fast_as_the_law_may_ask);
    RUN_TEST(test_a_small_body_has_its_own_limits);
    RUN_TEST(test_a_small_bodys_wheels_lag);
    RUN_TEST(test_a_small_body_lags_the_same_however_time_is_cut);
    RUN_TEST(test_a_small_body_that_is_held_has_no_momentum);
    RUN_TEST(test_a_wheels_gain_and_dead_band);
    RUN_TEST(test_each_wheel_has_its_own);
    RUN_TEST(test_without_scatter_robots_are_as_designed);
    RUN_TEST(test_scattered_robots_fill_their_ranges);
    RUN_TEST(test_a_robots_parts_differ);
    return UNITY_END();
}
