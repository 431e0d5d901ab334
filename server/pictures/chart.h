/* chart.h: lines and marks on two axes, as SVG inside of an HTML page.
 *
 * Every element has classes instead of colours: the page's style sheet gives it one that can be
 * seen on a light and on a dark background. Nothing has an id, so a page can hold any number. */
#ifndef CHART_H
#define CHART_H

#include <stdbool.h>
#include <stdio.h>

struct axes {
    const char *words;     /* what it shows, for those who do not see it */
    const char *x, *y;     /* names, with their units */
    double x0, x1, y0, y1; /* what is shown at least */
    bool to_scale;         /* a metre is as long upwards as sidewards */
    bool trimmed;          /* to scale, and no higher than what is shown at least needs */
    double width, height;  /* of the picture, pixels */
};

#define CHART_MARGINS 66 /* pixels, of a chart's height, that are not plot */
#define CHART_ROWS 4     /* of moments' words, where they are close together */

struct chart {
    FILE *out;
    double left, right, top, bottom; /* of the plot, pixels */
    double x0, x1, y0, y1;
    double key;              /* where its next entry begins, pixels */
    double said[CHART_ROWS]; /* where the words of moments end, pixels */
};

struct chart chart_open(FILE *out, const struct axes *axes);
void chart_close(const struct chart *chart);

/* The same inside of an SVG, at its origin. */
struct chart chart_begin(FILE *out, const struct axes *axes);

bool chart_shows(const struct chart *chart, double x, double y);

/* A line through points: begin, at least one point, end. */
void chart_begin_line(const struct chart *chart, const char *classes);
void chart_to(const struct chart *chart, double x, double y);
void chart_end_line(const struct chart *chart);

void chart_segment(const struct chart *chart, const char *classes, double x0, double y0, double x1,
                   double y1);

/* A disc with a radius in pixels. */
void chart_dot(const struct chart *chart, const char *classes, double x, double y, double radius);

/* A robot from above: an arrowhead towards theta. */
void chart_robot(const struct chart *chart, const char *classes, double x, double y, double theta);

/* A cross: here a robot was lost. */
void chart_cross(const struct chart *chart, double x, double y);

/* A bar between two times, its middle at the height y, `thick` pixels thick. */
void chart_bar(const struct chart *chart, const char *classes, double x0, double x1, double y,
               double thick);

/* Words: a few pixels above and to the right of a point; inside of a bar; before the y axis. */
void chart_words(const struct chart *chart, double x, double y, const char *words);
void chart_words_inside(const struct chart *chart, double x0, double x1, double y,
                        const char *words);
void chart_words_before(const struct chart *chart, double y, const char *words);

/* An upright line at x with words at its top, or below those of earlier ones; x rises. */
void chart_moment(struct chart *chart, double x, const char *words);

/* An entry of the key above the plot; left out where there is no room for it. */
void chart_key(struct chart *chart, const char *classes, const char *words);

#endif
