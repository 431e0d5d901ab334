#include "comparison.h"

#include "gnuplot.h"
#include "story.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define POINTS_MAX 1500 /* of a line */
#define DASHES 5        /* that gnuplot has */

/* What gnuplot is told, by the end of the file's name. NULL when that is another. */
static const char *find_terminal(const char *name)
{
    static const struct {
        const char *suffix, *terminal;
    } formats[] = {
        {".svg", "svg size 900,560 font 'sans,13'"},
        {".png", "pngcairo size 1800,1120 font 'sans,11' fontscale 2 linewidth 2"},
        {".pdf", "pdfcairo size 15cm,9.3cm font 'sans,9'"},
    };
    const char *end = strrchr(name, '.');

    for (size_t i = 0; i < sizeof formats / sizeof formats[0] && end != NULL && end != name; i++)
        if (strcmp(end, formats[i].suffix) == 0)
            return formats[i].terminal;
    return NULL;
}

bool comparison_knows(const char *name)
{
    return find_terminal(name) != NULL;
}

/* In gnuplot's single quotes, in which nothing but themselves is special. */
static void write_quoted(FILE *out, const char *text)
{
    fputc('\'', out);
    for (; *text != '\0'; text++) {
        if (*text == '\'')
            fputc('\'', out);
        fputc(*text, out);
    }
    fputc('\'', out);
}

/* ---- data ------------------------------------------------------------------------------ */

static void write_run(FILE *out, const struct archive *archive, size_t i)
{
    const struct history *history = &archive->history;
    size_t stride = history->ticks / POINTS_MAX + 1;

    fprintf(out, "$run%zu << END\n", i);
    for (size_t tick = 0; tick < history->ticks; tick++)
        if (tick % stride == 0 || tick + 1 == history->ticks)
            fprintf(out, "%.3f %.5f\n", history_time(history, tick),
                    history_mean_error(history, tick));
    fputs("END\n", out);
}

static int by_value(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;

    return (a > b) - (a < b);
}

double comparison_median(struct archive *const *archives, size_t count, double t)
{
    double *values = calloc(count, sizeof *values);
    size_t there = 0;

    if (values == NULL)
        return NAN;
    for (size_t i = 0; i < count; i++) {
        const struct history *history = &archives[i]->history;
        if (t <= archive_end(archives[i]) + 1e-6)
            values[there++] = history_mean_error(history, history_tick(history, t));
    }
    qsort(values, there, sizeof *values, by_value);
    double median = there == 0 ? NAN : (values[(there - 1) / 2] + values[there / 2]) / 2;
    free(values);
    return median;
}

static void write_median(FILE *out, struct archive *const *archives, size_t count)
{
    double end = archives_end(archives, count);

    fputs("$median << END\n", out);
    for (int i = 0; i <= POINTS_MAX; i++)
        fprintf(out, "%.3f %.5f\n", end * i / POINTS_MAX,
                comparison_median(archives, count, end * i / POINTS_MAX));
    fputs("END\n", out);
}

/* ---- drawing --------------------------------------------------------------------------- */

#define STORIES_MAX 12 /* in a figure; more would be a thicket */

/* Words stand to the right of their line, but to the left where the next line is near. */
static void mark_stories(FILE *out, const struct archive *archive)
{
    struct story stories[STORIES_MAX];
    size_t count = stories_tell(archive, stories, STORIES_MAX);

    for (size_t i = 0; i < count && count <= STORIES_MAX; i++) {
        bool near = i + 1 < count && stories[i + 1].t - stories[i].t < archive_end(archive) / 30;
        fprintf(out,
                "set arrow from %.3f, graph 0 to %.3f, graph 1 nohead dt 3 lc rgb 0x707070\n"
                "set label ",
                stories[i].t, stories[i].t);
        write_quoted(out, stories[i].words);
        fprintf(out, " at %.3f, graph 0.98 right rotate by 90 offset char %s, 0 tc rgb 0x404040\n",
                stories[i].t, near ? "-0.8" : "0.8");
    }
}

static void plot_few(FILE *out, struct archive *const *archives, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        fprintf(out, "%s$run%zu using 1:2 with lines lw 2 dt %zu lc rgb 0x%06X title ",
                i == 0 ? "" : ", ", i, i % DASHES + 1, gnuplot_colours[i]);
        write_quoted(out, archives[i]->name);
    }
}

static void plot_many(FILE *out, size_t count)
{
    for (size_t i = 0; i < count; i++)
        fprintf(out, "$run%zu using 1:2 with lines lw 0.6 lc rgb 0x90%06X notitle, ", i,
                gnuplot_colours[0]);
    fprintf(out,
            "keyentry with lines lw 0.6 lc rgb 0x%06X title 'each of %zu runs', "
            "$median using 1:2 with lines lw 2 lc rgb 0x000000 title 'their median'",
            gnuplot_colours[0], count);
}

static void write_script(FILE *out, struct archive *const *archives, size_t count, const char *name)
{
    bool many = count > GNUPLOT_COLOURS;

    for (size_t i = 0; i < count; i++)
        write_run(out, archives[i], i);
    if (many)
        write_median(out, archives, count);
    fprintf(out, "set terminal %s noenhanced background rgb 'white'\nset output ",
            find_terminal(name));
    write_quoted(out, name);
    fputs("\nset grid lc rgb 0xE4E4E4 lt 1\nset border 3\nset tics nomirror\n"
          "set offsets 0, 0, graph 0.05, 0\n"
          "set xlabel 't (s)'\nset ylabel 'mean distance error (m)'\n"
          "set key inside right top Left reverse samplen 3 opaque\n",
          out);
    if (count == 1)
        mark_stories(out, archives[0]);
    fprintf(out, "plot [0:%.3f] [0:*] ", archives_end(archives, count));
    if (many)
        plot_many(out, count);
    else
        plot_few(out, archives, count);
    fputs("\nset output\n", out);
}

bool comparison_draw(struct archive *const *archives, size_t count, const char *dir,
                     const char *name, char *error, size_t room)
{
    FILE *script = tmpfile();

    if (script == NULL) {
        snprintf(error, room, "%s", strerror(errno));
        return false;
    }
    write_script(script, archives, count, name);
    bool drawn = gnuplot_run(dir, script, error, room);
    fclose(script);
    return drawn;
}

/* ---- numbers --------------------------------------------------------------------------- */

void comparison_print(struct archive *const *archives, size_t count, FILE *out)
{
    int width = (int)strlen("mean distance error");

    for (size_t i = 0; i < count; i++)
        width = (int)fmax(width, (double)strlen(archives[i]->name));
    fprintf(out, "%-*s  %9s  %14s  %8s  %14s\n", width, "mean distance error", "lasts (s)",
            "at the end (m)", "peak (m)", "integral (m s)");
    for (size_t i = 0; i < count; i++) {
        const struct history *history = &archives[i]->history;
        fprintf(out, "%-*s  %9.2f  %14.4f  %8.3f  %14.2f%s\n", width, archives[i]->name,
                archive_end(archives[i]), history_mean_error(history, history->ticks - 1),
                history_peak_error(history, 0), history_error_integral(history, 0),
                archives[i]->cut ? "  cut short" : "");
    }
}
