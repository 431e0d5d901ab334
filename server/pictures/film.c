#include "film.h"

#include "drawing.h"
#include "film_scene.h"
#include "keyframes.h"
#include "markup.h"
#include "styles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PLAY 15.0    /* s that a film lasts at most, where nobody says */
#define PAUSE 1.5    /* s at its end, before it begins again */
#define STRIP 130    /* pixels, of the graph below */
#define ERROR 0.3    /* pixels, of the graph's line */
#define NOTHING 0.01 /* m: a graph shows at least that */

bool film_track(struct film *film, struct track *track)
{
    film->failed |= !track_open(track, &film->timeline);
    return !film->failed;
}

/* 1, 2, 5, 10, ... times real time. */
static double choose_speed(double seconds)
{
    double ten = 1;

    while (seconds / (10 * ten) > PLAY)
        ten *= 10;
    return seconds / ten <= PLAY         ? ten
           : seconds / (2 * ten) <= PLAY ? 2 * ten
           : seconds / (5 * ten) <= PLAY ? 5 * ten
                                         : 10 * ten;
}

static double speed_of(const struct film_options *options, double seconds)
{
    return options->speed > 0 ? options->speed : choose_speed(seconds);
}

/* ---- the graph ------------------------------------------------------------------------- */

/* The line's points, thinned out; `picked` are their ticks from the first on. */
static size_t pick_errors(const struct film *film, const struct chart *chart, size_t *picked)
{
    size_t count = film->last - film->first + 1;
    struct keyframes_point *points = calloc(count, sizeof *points);
    double up = (chart->bottom - chart->top) / (chart->y1 - chart->y0);
    double along = (chart->right - chart->left) / (chart->x1 - chart->x0);
    size_t used = 0;

    if (points == NULL)
        return 0;
    for (size_t i = 0; i < count; i++)
        points[i] =
            (struct keyframes_point){along * history_time(film->history, film->first + i),
                                     {up * history_mean_error(film->history, film->first + i), 0}};
    used = keyframes_pick(points, count, ERROR, picked);
    free(points);
    return used;
}

static void draw_errors_line(struct film *film, const struct chart *chart, const char *classes)
{
    size_t *picked = calloc(film->last - film->first + 1, sizeof *picked);
    size_t used = picked == NULL ? 0 : pick_errors(film, chart, picked);

    film->failed |= used == 0;
    chart_begin_line(chart, classes);
    for (size_t i = 0; i < used; i++)
        chart_to(chart, history_time(film->history, film->first + picked[i]),
                 history_mean_error(film->history, film->first + picked[i]));
    chart_end_line(chart);
    free(picked);
}

/* What of the line has been shown, and the moment that is. */
static void draw_progress(struct film *film, const struct chart *chart)
{
    double length = chart->right - chart->left;
    struct track track;

    fprintf(film->out,
            "<clipPath id=\"shown\"><rect x=\"%.1f\" y=\"0\" width=\"%.1f\" height=\"%d\">",
            chart->left, length, STRIP);
    if (film_track(film, &track)) {
        track_key(&track, film->timeline.from, "0");
        track_key(&track, film->timeline.to, "%.1f", length);
        track_close(&track, film->out, "animate attributeName=\"width\"");
    }
    fprintf(film->out, "</rect></clipPath>\n<path class=\"now\" d=\"M%.1f,%.1fV%.1f\">",
            chart->left, chart->top, chart->bottom);
    if (film_track(film, &track)) {
        track_key(&track, film->timeline.from, "0 0");
        track_key(&track, film->timeline.to, "%.1f 0", length);
        track_close(&track, film->out,
                    "animateTransform attributeName=\"transform\" type=\"translate\"");
    }
    fputs("</path>\n", film->out);
}

static void draw_graph(struct film *film)
{
    double highest = NOTHING;

    for (size_t tick = film->first; tick <= film->last; tick++)
        highest = fmax(highest, history_mean_error(film->history, tick));
    struct axes axes = {
        .words = "",
        .x = "t (s)",
        .y = "m",
        .x0 = film->timeline.from,
        .x1 = film->timeline.to,
        .y1 = highest * 1.1,
        .width = film->width,
        .height = STRIP,
    };
    fprintf(film->out, "<g transform=\"translate(0 %.0f)\">\n", film->height);
    struct chart chart = chart_begin(film->out, &axes);
    for (size_t i = 0; i < film->stories; i++)
        chart_moment(&chart, film->story[i].t, film->story[i].words);
    chart_key(&chart, "mean", "mean distance error of the live robots");
    draw_errors_line(film, &chart, "faint");
    fputs("<g class=\"film\">\n", film->out);
    draw_progress(film, &chart);
    draw_errors_line(film, &chart, "mean shown");
    fputs("</g>\n<g class=\"still\">\n", film->out);
    draw_errors_line(film, &chart, "mean");
    fputs("</g>\n</g>\n", film->out);
}

/* ---- all of it ------------------------------------------------------------------------- */

static void write_head(const struct film *film)
{
    FILE *out = film->out;
    const char *scenario = json_string_value(json_object_get(film->archive->summary, "scenario"));

    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
            "viewBox=\"0 0 %.0f %.0f\" role=\"img\" aria-labelledby=\"title story\">\n"
            "<title id=\"title\">",
            film->width, film->height + STRIP, film->width, film->height + STRIP);
    markup_text(out, scenario != NULL ? scenario : film->archive->name);
    fprintf(out, ": %zu robots, %.0f s</title>\n<desc id=\"story\">A team from above.",
            film->history->robots, film->timeline.to - film->timeline.from);
    for (size_t i = 0; i < film->stories; i++) {
        fprintf(out, " At %.1f s ", film->story[i].t);
        markup_text(out, film->story[i].words);
        fputc('.', out);
    }
    fprintf(out, "</desc>\n<style>\n%s%s</style>\n", ink_css, film_css);
    fprintf(out, "<rect class=\"paper\" width=\"%.0f\" height=\"%.0f\"/>\n", film->width,
            film->height + STRIP);
}

/* What is to be told of the time that is shown. */
static void choose_stories(struct film *film)
{
    size_t count = stories_tell(film->archive, film->story, FILM_STORIES_MAX);

    if (count > FILM_STORIES_MAX)
        count = FILM_STORIES_MAX;
    for (size_t i = 0; i < count; i++)
        if (film->story[i].t >= film->timeline.from && film->story[i].t <= film->timeline.to)
            film->story[film->stories++] = film->story[i];
}

static void write_film(struct film *film)
{
    write_head(film);
    film_arena_defs(film);
    fputs("<g class=\"film\">\n", film->out);
    film->moves = true;
    film_arena(film);
    film_words(film);
    fputs("</g>\n<g class=\"still\">\n", film->out);
    film->moves = false;
    film_arena(film);
    film_words(film);
    fputs("</g>\n", film->out);
    film_key(film);
    draw_graph(film);
    fputs("</svg>\n", film->out);
}

bool film_write(const struct archive *archive, const struct film_options *options, FILE *out)
{
    double seconds = options->to - options->from;
    double play = seconds / speed_of(options, seconds);
    struct film film = {
        .out = out,
        .archive = archive,
        .history = &archive->history,
        .first = history_tick(&archive->history, options->from),
        .last = history_tick(&archive->history, options->to),
        .timeline = {options->from, options->to, play, play + PAUSE},
        .crowd = is_crowd(&archive->history),
        .size = is_crowd(&archive->history) ? 0.5 : 1,
        .width = options->width,
        .height = floor(options->width / 2),
    };

    choose_stories(&film);
    film.failed = !film_camera(&film);
    if (!film.failed)
        write_film(&film);
    free(film.camera);
    return !film.failed && ferror(out) == 0;
}
