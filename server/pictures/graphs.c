/* graphs.c: panels over time. */
#include "drawing.h"

#include "message.h"

#include <math.h>
#include <stdio.h>

#define HEIGHT 320     /* pixels, of a graph */
#define JOB_OF_MANY 40 /* of a robot's row at least; in a crowd: */
#define JOB_OF_CROWD 9

static double end_of(const struct panel *panel)
{
    double end = 1e-3;

    for (size_t i = 0; i < panel->runs; i++)
        end = fmax(end, history_time(panel->run[i], panel_end(panel, panel->run[i])));
    return end;
}

static struct chart open_graph(FILE *out, const struct panel *panel, const char *y, double y0,
                               double y1, double height)
{
    struct axes axes = {
        .words = panel->caption,
        .x = "t (s)",
        .y = y,
        .x1 = end_of(panel),
        .y0 = y0,
        .y1 = y1,
        .width = panel_width(panel),
        .height = height,
    };

    return chart_open(out, &axes);
}

static void draw_marks(struct chart *chart, const struct panel *panel)
{
    for (size_t i = 0; i < panel->moments; i++)
        chart_moment(chart, history_time(panel->run[0], panel->tick[i]), panel->moment[i]);
}

/* ---- values ---------------------------------------------------------------------------- */

typedef double graph_value(const struct history *history, size_t tick, size_t robot);

static double error_of(const struct history *history, size_t tick, size_t robot)
{
    return history_at(history, tick, robot)->error;
}

static double mean_error_of(const struct history *history, size_t tick, size_t robot)
{
    (void)robot;
    return history_mean_error(history, tick);
}

static double omega_of(const struct history *history, size_t tick, size_t robot)
{
    return history_at(history, tick, robot)->omega;
}

/* From one tick to another. */
static void draw_value(const struct chart *chart, const struct panel *panel,
                       const struct history *history, size_t robot, const char *classes,
                       graph_value *value, size_t first, size_t last)
{
    chart_begin_line(chart, classes);
    for (size_t tick = first; tick <= last; tick += panel_stride(panel, history))
        chart_to(chart, history_time(history, tick), value(history, tick, robot));
    chart_end_line(chart);
}

/* A robot's distance error, while it lives. */
static void draw_life(const struct chart *chart, const struct panel *panel, size_t robot)
{
    const struct history *history = panel->run[0];
    const char *classes = robot_classes(history, robot, is_crowd(history) ? "fine" : "");
    size_t born = 0;

    for (size_t tick = 0; tick < history->ticks; tick++) {
        bool ends = tick + 1 == history->ticks || !history_at(history, tick + 1, robot)->alive;

        if (!history_at(history, tick, robot)->alive)
            born = tick + 1;
        else if (ends)
            draw_value(chart, panel, history, robot, classes, error_of, born, tick);
    }
}

void draw_errors(FILE *out, const struct panel *panel)
{
    const struct history *history = panel->run[0];
    double highest = 0.01;

    for (size_t i = 0; i < history->ticks * history->robots; i++)
        highest = fmax(highest, history->glimpses[i].error);
    struct chart chart = open_graph(out, panel, "distance error (m)", 0, highest * 1.05, HEIGHT);
    for (size_t i = 0; i < history->robots; i++)
        draw_life(&chart, panel, i);
    draw_value(&chart, panel, history, 0, "mean", mean_error_of, 0, panel_end(panel, history));
    draw_marks(&chart, panel);
    chart_key(&chart, "mean", "mean");
    draw_key_of_robots(&chart, history);
    chart_close(&chart);
}

static void draw_runs(struct chart *chart, const struct panel *panel, graph_value *value)
{
    for (size_t i = 0; i < panel->runs; i++) {
        draw_value(chart, panel, panel->run[i], 0, run_class(i), value, 0,
                   panel_end(panel, panel->run[i]));
        chart_key(chart, run_class(i), panel->word[i]);
    }
}

void draw_mean_errors(FILE *out, const struct panel *panel)
{
    double highest = 0.01;

    for (size_t i = 0; i < panel->runs; i++)
        highest = fmax(highest, history_peak_error(panel->run[i], 0));
    struct chart chart =
        open_graph(out, panel, "mean distance error (m)", 0, highest * 1.05, HEIGHT);
    draw_runs(&chart, panel, mean_error_of);
    draw_marks(&chart, panel);
    chart_close(&chart);
}

void draw_angular_velocities(FILE *out, const struct panel *panel)
{
    double lowest = 0, highest = 0;

    for (size_t i = 0; i < panel->runs; i++) {
        const struct history *history = panel->run[i];
        for (size_t tick = 0; tick < history->ticks; tick++) {
            lowest = fmin(lowest, omega_of(history, tick, 0));
            highest = fmax(highest, omega_of(history, tick, 0));
        }
    }
    double margin = 0.05 * (highest - lowest);
    struct chart chart = open_graph(out, panel, "angular velocity (rad/s)", lowest - margin,
                                    highest + margin, HEIGHT);
    draw_runs(&chart, panel, omega_of);
    chart_close(&chart);
}

/* ---- roles and vertices ---------------------------------------------------------------- */

static bool same_job(const struct history *history, size_t robot, size_t tick, size_t other)
{
    const struct glimpse *a = history_at(history, tick, robot);
    const struct glimpse *b = history_at(history, other, robot);

    return a->alive == b->alive && a->role == b->role && a->vertex == b->vertex &&
           history->moments[tick].formation == history->moments[other].formation;
}

static void name_job(char *words, size_t room, const struct history *history, size_t robot,
                     size_t tick)
{
    const struct glimpse *g = history_at(history, tick, robot);

    if (g->role == ROLE_LEADER)
        snprintf(words, room, "leads");
    else if (g->role == ROLE_CANDIDATE)
        snprintf(words, room, "candidate");
    else if (g->vertex == 0)
        snprintf(words, room, "no vertex");
    else if (history_shape_at(history, tick)->name[0] == '\0')
        snprintf(words, room, "vertex %u", g->vertex);
    else
        snprintf(words, room, "vertex %u of %.20s", g->vertex,
                 history_shape_at(history, tick)->name);
}

/* What a robot does from one tick until another. */
static void draw_job(const struct chart *chart, const struct history *history, size_t robot,
                     size_t from, size_t to)
{
    const struct glimpse *g = history_at(history, from, robot);
    double y = -(double)robot;
    char words[40];

    if (!g->alive)
        return;
    name_job(words, sizeof words, history, robot, from);
    chart_bar(chart, robot_classes(history, robot, g->role == ROLE_LEADER ? "leads" : "follows"),
              history_time(history, from), history_time(history, to), y,
              is_crowd(history) ? JOB_OF_CROWD - 2 : 30);
    if (!is_crowd(history))
        chart_words_inside(chart, history_time(history, from), history_time(history, to), y, words);
}

static void draw_jobs(const struct chart *chart, const struct history *history, size_t robot)
{
    size_t from = 0;

    for (size_t tick = 1; tick < history->ticks; tick++) {
        if (tick + 1 < history->ticks && same_job(history, robot, from, tick))
            continue;
        draw_job(chart, history, robot, from, tick);
        from = tick;
    }
}

/* Pixels of a robot's row. */
static double job_room(const struct history *history)
{
    double shared = (double)(HEIGHT - CHART_MARGINS) / (double)history->robots;

    return is_crowd(history) ? JOB_OF_CROWD : fmax(JOB_OF_MANY, shared);
}

void draw_vertices(FILE *out, const struct panel *panel)
{
    const struct history *history = panel->run[0];
    size_t robots = history->robots, named = is_crowd(history) ? 5 : 1;
    struct chart chart = open_graph(out, panel, NULL, 0.5 - (double)robots, 0.9,
                                    CHART_MARGINS + (double)robots * job_room(history));
    char words[16];

    for (size_t robot = 0; robot < robots; robot++) {
        draw_jobs(&chart, history, robot);
        snprintf(words, sizeof words, is_crowd(history) ? "%u" : "robot %u", history->id[robot]);
        if (robot % named == 0)
            chart_words_before(&chart, -(double)robot, words);
    }
    draw_marks(&chart, panel);
    chart_close(&chart);
}
