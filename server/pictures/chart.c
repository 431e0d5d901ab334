#include "chart.h"

#include "markup.h"

#include <math.h>
#include <string.h>

#define LEFT 56
#define RIGHT 12
#define TOP 26 /* the key's line */
#define BOTTOM 40
#define TICKS 6
#define TICK_ROOM 24 /* pixels */
#define LETTER 6.6   /* mean width of a letter of the key, pixels */

static double at_x(const struct chart *chart, double x)
{
    return chart->left + (x - chart->x0) / (chart->x1 - chart->x0) * (chart->right - chart->left);
}

static double at_y(const struct chart *chart, double y)
{
    return chart->bottom - (y - chart->y0) / (chart->y1 - chart->y0) * (chart->bottom - chart->top);
}

/* 1, 2 or 5 times a power of ten, for about TICKS of them in `range`, fewer on few pixels. */
static double step_of(double range, double pixels)
{
    double ticks = fmin(TICKS, pixels / TICK_ROOM);
    double ten = pow(10, floor(log10(range / ticks)));
    double share = range / ticks / ten;

    return ten * (share <= 1 ? 1 : share <= 2 ? 2 : share <= 5 ? 5 : 10);
}

static int decimals_of(double step)
{
    return step < 1 ? (int)ceil(-log10(step) - 1e-9) : 0;
}

static void write_text(const struct chart *chart, const char *classes, double x, double y,
                       const char *words)
{
    fprintf(chart->out, "<text class=\"%s\" x=\"%.1f\" y=\"%.1f\">", classes, x, y);
    markup_text(chart->out, words);
    fputs("</text>\n", chart->out);
}

static void write_number(const struct chart *chart, const char *classes, double x, double y,
                         double number, double step)
{
    char words[32];

    snprintf(words, sizeof words, "%.*f", decimals_of(step), number + 0.0); /* never -0 */
    write_text(chart, classes, x, y, words);
}

static void draw_x_axis(const struct chart *c, const char *name)
{
    double step = step_of(c->x1 - c->x0, c->right - c->left);

    for (double i = ceil(c->x0 / step - 1e-9); i * step <= c->x1 + step * 1e-9; i++) {
        double x = at_x(c, i * step);
        fprintf(c->out, "<path class=\"grid\" d=\"M%.1f,%.1fV%.1f\"/>", x, c->top, c->bottom);
        write_number(c, "mid", x, c->bottom + 16, i * step, step);
    }
    write_text(c, "mid", (c->left + c->right) / 2, c->bottom + 33, name);
}

static void draw_y_axis(const struct chart *c, const char *name)
{
    double step = step_of(c->y1 - c->y0, c->bottom - c->top);

    for (double i = ceil(c->y0 / step - 1e-9); i * step <= c->y1 + step * 1e-9; i++) {
        double y = at_y(c, i * step);
        fprintf(c->out, "<path class=\"grid\" d=\"M%.1f,%.1fH%.1f\"/>", c->left, y, c->right);
        write_number(c, "end", c->left - 6, y + 4, i * step, step);
    }
    fprintf(c->out, "<g transform=\"translate(13 %.1f) rotate(-90)\">", (c->top + c->bottom) / 2);
    write_text(c, "mid", 0, 0, name);
    fputs("</g>", c->out);
}

/* Shows more of the axis that has room to spare, or makes the picture lower. */
static void make_true_to_scale(struct chart *c, bool trimmed)
{
    double per_metre =
        fmin((c->right - c->left) / (c->x1 - c->x0), (c->bottom - c->top) / (c->y1 - c->y0));
    double more = (c->right - c->left) / per_metre - (c->x1 - c->x0);
    double higher = (c->bottom - c->top) / per_metre - (c->y1 - c->y0);

    c->x0 -= more / 2;
    c->x1 += more / 2;
    if (trimmed) {
        c->bottom -= higher * per_metre;
        return;
    }
    c->y0 -= higher / 2;
    c->y1 += higher / 2;
}

static struct chart lay_out(FILE *out, const struct axes *axes)
{
    struct chart c = {
        .out = out,
        .left = LEFT,
        .right = axes->width - RIGHT,
        .top = TOP,
        .bottom = axes->height - BOTTOM,
        .x0 = axes->x0,
        .x1 = axes->x1,
        .y0 = axes->y0,
        .y1 = axes->y1,
        .key = LEFT,
    };

    if (axes->to_scale)
        make_true_to_scale(&c, axes->trimmed);
    return c;
}

static void draw_axes(const struct chart *chart, const struct axes *axes)
{
    draw_x_axis(chart, axes->x);
    if (axes->y != NULL)
        draw_y_axis(chart, axes->y);
}

struct chart chart_begin(FILE *out, const struct axes *axes)
{
    struct chart c = lay_out(out, axes);

    draw_axes(&c, axes);
    return c;
}

struct chart chart_open(FILE *out, const struct axes *axes)
{
    struct chart c = lay_out(out, axes);

    fprintf(out, "<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\" aria-label=\"", axes->width,
            c.bottom + BOTTOM);
    markup_text(out, axes->words);
    fputs("\">\n", out);
    draw_axes(&c, axes);
    return c;
}

void chart_close(const struct chart *chart)
{
    fputs("</svg>\n", chart->out);
}

bool chart_shows(const struct chart *chart, double x, double y)
{
    return x >= chart->x0 && x <= chart->x1 && y >= chart->y0 && y <= chart->y1;
}

void chart_begin_line(const struct chart *chart, const char *classes)
{
    fprintf(chart->out, "<path class=\"line %s\" d=\"M", classes);
}

void chart_to(const struct chart *chart, double x, double y)
{
    fprintf(chart->out, "%.1f,%.1f ", at_x(chart, x), at_y(chart, y));
}

void chart_end_line(const struct chart *chart)
{
    fputs("\"/>\n", chart->out);
}

void chart_segment(const struct chart *chart, const char *classes, double x0, double y0, double x1,
                   double y1)
{
    chart_begin_line(chart, classes);
    chart_to(chart, x0, y0);
    chart_to(chart, x1, y1);
    chart_end_line(chart);
}

void chart_dot(const struct chart *chart, const char *classes, double x, double y, double radius)
{
    fprintf(chart->out, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"/>\n", classes,
            at_x(chart, x), at_y(chart, y), radius);
}

void chart_robot(const struct chart *chart, const char *classes, double x, double y, double theta)
{
    fprintf(chart->out,
            "<path class=\"mark %s\" transform=\"translate(%.1f %.1f) rotate(%.0f)\""
            " d=\"M8,0 -5,5.5 -2.5,0 -5,-5.5Z\"/>\n",
            classes, at_x(chart, x), at_y(chart, y), -theta * 180 / M_PI);
}

void chart_cross(const struct chart *chart, double x, double y)
{
    fprintf(chart->out, "<path class=\"line lost\" d=\"M%.1f,%.1fm-5,-5 10,10m0,-10 -10,10\"/>\n",
            at_x(chart, x), at_y(chart, y));
}

void chart_bar(const struct chart *chart, const char *classes, double x0, double x1, double y,
               double thick)
{
    fprintf(chart->out,
            "<rect class=\"mark %s\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n",
            classes, at_x(chart, x0), at_y(chart, y) - thick / 2, at_x(chart, x1) - at_x(chart, x0),
            thick);
}

void chart_words(const struct chart *chart, double x, double y, const char *words)
{
    write_text(chart, "", at_x(chart, x) + 6, at_y(chart, y) - 6, words);
}

void chart_words_inside(const struct chart *chart, double x0, double x1, double y,
                        const char *words)
{
    double room = at_x(chart, x1) - at_x(chart, x0);

    if (room > LETTER * (double)(strlen(words) + 1))
        write_text(chart, "mid", at_x(chart, x0) + room / 2, at_y(chart, y) + 4, words);
}

void chart_words_before(const struct chart *chart, double y, const char *words)
{
    write_text(chart, "end", chart->left - 6, at_y(chart, y) + 4, words);
}

void chart_moment(struct chart *chart, double x, const char *words)
{
    double from = at_x(chart, x) + 4;
    double wide = LETTER * (double)strlen(words);
    size_t row = 0;

    fprintf(chart->out, "<path class=\"moment\" d=\"M%.1f,%.1fV%.1f\"/>", at_x(chart, x),
            chart->top, chart->bottom);
    while (row + 1 < CHART_ROWS && chart->said[row] > from)
        row++;
    chart->said[row] = from + wide;
    write_text(chart, "said", from, chart->top + 12 + 14 * (double)row, words);
}

void chart_key(struct chart *chart, const char *classes, const char *words)
{
    double room = 34 + LETTER * (double)strlen(words);

    if (chart->key + room > chart->right + RIGHT)
        return;
    fprintf(chart->out, "<path class=\"line %s\" d=\"M%.1f,14h16\"/>", classes, chart->key);
    write_text(chart, "", chart->key + 20, 18, words);
    chart->key += room;
}
