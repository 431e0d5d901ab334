#include "chart.h"

#include <stdlib.h>
#include <string.h>
#include <unity.h>

static char *text;
static size_t length;
static FILE *out;

void setUp(void)
{
    out = open_memstream(&text, &length);
    TEST_ASSERT_NOT_NULL(out);
}

void tearDown(void)
{
    free(text);
}

static const char *written(const struct chart *chart)
{
    chart_close(chart);
    fclose(out);
    return text;
}

static struct axes map(double x1, double y1)
{
    return (struct axes){.words = "a map",
                         .x = "x (m)",
                         .y = "y (m)",
                         .x1 = x1,
                         .y1 = y1,
                         .to_scale = true,
                         .width = 460,
                         .height = 480};
}

static double pixels_per_x(const struct chart *chart)
{
    return (chart->right - chart->left) / (chart->x1 - chart->x0);
}

static double pixels_per_y(const struct chart *chart)
{
    return (chart->bottom - chart->top) / (chart->y1 - chart->y0);
}

static void a_metre_is_as_long_upwards_as_sidewards(void)
{
    static const double sides[][2] = {{1, 1}, {100, 3}, {2, 50}};

    for (size_t i = 0; i < 3; i++) {
        struct axes axes = map(sides[i][0], sides[i][1]);
        struct chart chart = chart_open(out, &axes);

        TEST_ASSERT_TRUE(pixels_per_x(&chart) - pixels_per_y(&chart) < 1e-9);
        TEST_ASSERT_TRUE(pixels_per_y(&chart) - pixels_per_x(&chart) < 1e-9);
        TEST_ASSERT_TRUE(chart.x0 <= 0 && chart.x1 >= sides[i][0]);
        TEST_ASSERT_TRUE(chart.y0 <= 0 && chart.y1 >= sides[i][1]);
    }
    fclose(out);
}

static void a_trimmed_map_is_no_higher_than_it_has_to_be(void)
{
    struct axes axes = map(100, 20);

    axes.trimmed = true;
    struct chart chart = chart_open(out, &axes);
    TEST_ASSERT_TRUE(chart.y0 == 0 && chart.y1 == 20);
    TEST_ASSERT_TRUE(pixels_per_x(&chart) - pixels_per_y(&chart) < 1e-9);
    TEST_ASSERT_NULL(strstr(written(&chart), "0 0 460 480"));
}

static void ticks_are_round_and_zero_has_no_sign(void)
{
    struct axes axes = map(0.3, 0.3);

    axes.x0 = axes.y0 = -0.3;
    struct chart chart = chart_open(out, &axes);
    const char *svg = written(&chart);
    TEST_ASSERT_NOT_NULL(strstr(svg, ">0.2<"));
    TEST_ASSERT_NOT_NULL(strstr(svg, ">0.0<"));
    TEST_ASSERT_NULL(strstr(svg, "-0.0<"));
}

static void words_are_escaped(void)
{
    struct axes axes = map(1, 1);

    axes.words = "\"a\" < b";
    struct chart chart = chart_open(out, &axes);
    chart_key(&chart, "c0", "R & D");
    const char *svg = written(&chart);
    TEST_ASSERT_NOT_NULL(strstr(svg, "aria-label=\"&quot;a&quot; &lt; b\""));
    TEST_ASSERT_NOT_NULL(strstr(svg, ">R &amp; D<"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_metre_is_as_long_upwards_as_sidewards);
    RUN_TEST(a_trimmed_map_is_no_higher_than_it_has_to_be);
    RUN_TEST(ticks_are_round_and_zero_has_no_sign);
    RUN_TEST(words_are_escaped);
    return UNITY_END();
}
