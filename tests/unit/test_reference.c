#include "expression.h"
#include "reference.h"

#include <math.h>
#include <unity.h>

static const char *const names[] = {"t", NULL};

static struct trajectory *trajectory;

void setUp(void)
{
    trajectory = NULL;
}

void tearDown(void)
{
    trajectory_free(trajectory);
}

static void given(double x, double y, double theta, const char *v, const char *omega)
{
    const double start[] = {x, y, theta};
    char error[512] = "";
    struct expression *speed = expression_new(v, names, error, sizeof error);
    struct expression *rate = expression_new(omega, names, error, sizeof error);

    TEST_ASSERT_NOT_NULL_MESSAGE(speed, error);
    TEST_ASSERT_NOT_NULL_MESSAGE(rate, error);
    trajectory = trajectory_new(start, speed, rate);
    TEST_ASSERT_NOT_NULL(trajectory);
}

static struct reference_state state_after(int ticks)
{
    struct reference_state state = trajectory_start(trajectory);

    for (int i = 0; i < ticks; i++)
        state = trajectory_step(trajectory, &state);
    return state;
}

static void assert_near(double expected, double value)
{
    TEST_ASSERT_TRUE_MESSAGE(fabs(value - expected) < 1e-9, "off by a nanometre or more");
}

static void test_start(void)
{
    given(1, -2, 0.5, "1 + t", "2 - t");
    struct reference_state state = trajectory_start(trajectory);

    assert_near(0, state.t);
    assert_near(1, state.x);
    assert_near(-2, state.y);
    assert_near(0.5, state.theta);
    assert_near(1, state.v);
    assert_near(2, state.omega);
}

static void test_straight_line(void)
{
    given(0, 1, M_PI / 2, "0.3", "0");
    struct reference_state state = state_after(500);

    assert_near(10, state.t);
    assert_near(0, state.x);
    assert_near(4, state.y);
    assert_near(M_PI / 2, state.theta);
}

static void test_circle(void)
{
    given(2, 0, M_PI / 2, "1", "0.5");
    struct reference_state state = state_after(700);

    assert_near(2 * cos(7), state.x);
    assert_near(2 * sin(7), state.y);
    assert_near(M_PI / 2 + 7, state.theta);
}

/* theta = t^2 / 2 and v = t give x = sin(t^2 / 2), y = 1 - cos(t^2 / 2). */
static void test_speeds_that_change(void)
{
    given(0, 0, 0, "t", "t");
    struct reference_state state = state_after(100);

    assert_near(sin(2), state.x);
    assert_near(1 - cos(2), state.y);
    assert_near(2, state.theta);
    assert_near(2, state.v);
    assert_near(2, state.omega);
}

/* The paper's first trajectory: the integral of -0.2 tanh(0.1 (t - 15)) is -2 ln cosh. */
static void test_paper_heading(void)
{
    given(0, 0, -M_PI, "1.5", "-0.2*tanh(0.1*(t-15))");
    struct reference_state state = state_after(1500);

    assert_near(-M_PI, state.theta);
    state = state_after(750);
    assert_near(-M_PI + 2 * log(cosh(1.5)), state.theta);
}

static void test_time_is_counted_exactly(void)
{
    given(0, 0, 0, "0", "0");
    TEST_ASSERT_TRUE(state_after(3).t == 0.06);
    TEST_ASSERT_TRUE(state_after(50000).t == 1000);
}

static void test_no_value_is_passed_on(void)
{
    given(0, 0, 0, "sqrt(0.01 - t)", "0");
    TEST_ASSERT_TRUE(isnan(state_after(1).x));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_start);
    RUN_TEST(test_straight_line);
    RUN_TEST(test_circle);
    RUN_TEST(test_speeds_that_change);
    RUN_TEST(test_paper_heading);
    RUN_TEST(test_time_is_counted_exactly);
    RUN_TEST(test_no_value_is_passed_on);
    return UNITY_END();
}
