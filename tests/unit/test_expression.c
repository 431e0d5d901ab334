#include "expression.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

static const char *const no_names[] = {NULL};
static const char *const time_names[] = {"t", NULL};
static const char *const view_names[] = {"t", "leader.x", "leader.y", "leader.theta", NULL};

void setUp(void)
{
}

void tearDown(void)
{
}

static double value_of(const char *text, const char *const *names, const double *values)
{
    char error[512] = "";
    struct expression *expression = expression_new(text, names, error, sizeof error);

    TEST_ASSERT_NOT_NULL_MESSAGE(expression, error);
    double value = expression_value(expression, values);
    expression_free(expression);
    return value;
}

static void assert_value(double expected, const char *text)
{
    double value = value_of(text, no_names, NULL);
    char message[128];

    snprintf(message, sizeof message, "%s is %.17g, not %.17g", text, value, expected);
    TEST_ASSERT_TRUE_MESSAGE(fabs(value - expected) <= 1e-12 * fmax(1, fabs(expected)), message);
}

static void assert_refused(const char *text, const char *reason)
{
    char error[512] = "";
    struct expression *expression = expression_new(text, time_names, error, sizeof error);

    TEST_ASSERT_NULL_MESSAGE(expression, text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(error, reason), error);
}

static void test_numbers(void)
{
    assert_value(3, "3");
    assert_value(0.5, ".5");
    assert_value(1000, "1e3");
    assert_value(0.0025, "2.5E-3");
    assert_value(10, "010");
}

static void test_operators(void)
{
    assert_value(7, "1 + 2 * 3");
    assert_value(-4, "-2^2");
    assert_value(512, "2^3^2");
    assert_value(1, "2 >= 2");
    assert_value(0, "2 != 2");
    assert_value(5, "1 < 2 ? 5 : 6");
    assert_value(1, "1 < 2 && 0 == 0");
    assert_value(37 * M_PI / 70, "37*pi/70");
}

static void test_functions(void)
{
    assert_value(sin(1), "sin(1)");
    assert_value(cos(1), "cos(1)");
    assert_value(tan(1), "tan(1)");
    assert_value(asin(0.5), "asin(0.5)");
    assert_value(acos(0.5), "acos(0.5)");
    assert_value(atan(2), "atan(2)");
    assert_value(atan2(1, -2), "atan2(1, -2)");
    assert_value(sinh(1), "sinh(1)");
    assert_value(cosh(1), "cosh(1)");
    assert_value(tanh(1), "tanh(1)");
    assert_value(exp(2), "exp(2)");
    assert_value(log(2), "ln(2)");
    assert_value(3, "sqrt(9)");
    assert_value(2, "abs(-2)");
    assert_value(-3, "floor(-2.5)");
    assert_value(-1, "min(3, -1, 2)");
    assert_value(3, "max(3, -1, 2)");
}

static void test_names_take_their_values(void)
{
    const double values[] = {2, 3, 4, 5};

    TEST_ASSERT_TRUE(
        value_of("t + 10*leader.x + 100*leader.y + 1000*leader.theta", view_names, values) == 5432);
    TEST_ASSERT_TRUE(value_of("leader.y>=1", view_names, values) == 1);
}

static void test_value_follows_its_names(void)
{
    char error[512];
    struct expression *expression = expression_new("t^2", time_names, error, sizeof error);

    TEST_ASSERT_NOT_NULL(expression);
    TEST_ASSERT_FALSE(expression_is_constant(expression));
    TEST_ASSERT_TRUE(expression_value(expression, &(double){3}) == 9);
    TEST_ASSERT_TRUE(expression_value(expression, &(double){-4}) == 16);
    expression_free(expression);
}

static void test_values_that_are_not_finite_come_out(void)
{
    TEST_ASSERT_TRUE(isinf(value_of("1/0", no_names, NULL)));
    TEST_ASSERT_TRUE(isnan(value_of("sqrt(-1)", no_names, NULL)));
    TEST_ASSERT_TRUE(isnan(value_of("min(1, sqrt(-1))", no_names, NULL)));
    TEST_ASSERT_TRUE(isnan(value_of("max(sqrt(-1), 1)", no_names, NULL)));
}

static void test_what_muparser_would_take(void)
{
    assert_refused("t=5", "an assignment");
    assert_refused("t == 5, t = 1", "a comma");
    assert_refused("1,2", "a comma");
    assert_refused("(1),(2)", "a comma");
    assert_refused("(1,2)", "");
    assert_refused("\"text\"", "no meaning");
    assert_refused("100abc", "'100abc' is no number");
    assert_refused("_pi", "'_pi' has no meaning here");
    assert_refused("_e", "no meaning");
    assert_refused("log(2)", "'log' has no meaning here");
    assert_refused("rint(2.5)", "no meaning");
    assert_refused("sum(1, 2)", "no meaning");
    assert_refused("sign(2)", "no meaning");
}

static void test_nonsense(void)
{
    static const char *const texts[] = {
        "",     " ",    "100abc",    "2pi",      "0x10",  "1.2.3",   "1e999",
        ".inf", ".nan", "nan",       "inf",      "sin",   "pi(1)",   "t t",
        "3 +",  "* 3",  "(1",        "1)",       "1 ? 2", "1 : 2",   "!1",
        "1;2",  "t'",   "sin(1, 2)", "atan2(1)", "min()", "t === 1", "\xC3\xA9",
    };

    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        assert_refused(texts[i], "");
}

static void test_unknown_name_is_told_with_what_is_known(void)
{
    assert_refused("tanhh(t)", "'tanhh' has no meaning here, 'tanh' would have; pi, t, sin cos");
    assert_refused("leader.x", "'leader.x' has no meaning here; pi, t, sin");
}

static void test_long_texts(void)
{
    char text[30001];

    memset(text, '(', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    assert_refused(text, "");
    memset(text, 'x', sizeof text - 1);
    assert_refused(text, "no meaning");
    memset(text, '1', sizeof text - 1);
    assert_refused(text, "");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_numbers);
    RUN_TEST(test_operators);
    RUN_TEST(test_functions);
    RUN_TEST(test_names_take_their_values);
    RUN_TEST(test_value_follows_its_names);
    RUN_TEST(test_values_that_are_not_finite_come_out);
    RUN_TEST(test_what_muparser_would_take);
    RUN_TEST(test_nonsense);
    RUN_TEST(test_unknown_name_is_told_with_what_is_known);
    RUN_TEST(test_long_texts);
    return UNITY_END();
}
