#include "panel.h"

#include "chart.h"
#include "message.h"

#include <math.h>
#include <stdio.h>

#define NARROW 460 /* pixels */
#define WIDE 940
#define CROWD 16         /* robots; more are drawn finely, in a scale of colours */
#define LINE_POINTS 400  /* of a line; of a crowd's: */
#define CROWD_POINTS 120

void panel_add(struct panel *panel, const struct run *run, const char *word)
{
    panel->run[panel->runs] = run;
    panel->word[panel->runs++] = word;
}

void panel_mark(struct panel *panel, size_t tick, const char *word)
{
    if (tick == NEVER)
        return;
    panel->tick[panel->moments] = tick;
    panel->moment[panel->moments++] = word;
}

/* ---- what several panels draw ---------------------------------------------------------- */

struct box {
    double x0, x1, y0, y1;
};

static const struct box nothing = {INFINITY, -INFINITY, INFINITY, -INFINITY};

static void include(struct box *box, double x, double y)
{
    box->x0 = fmin(box->x0, x);
    box->x1 = fmax(box->x1, x);
    box->y0 = fmin(box->y0, y);
    box->y1 = fmax(box->y1, y);
}

static struct chart open_map(FILE *out, const struct panel *panel, const struct box *box,
                             double margin)
{
    struct axes axes = {
        .words = panel->caption,
        .x = "x (m)",
        .y = "y (m)",
        .x0 = box->x0 - margin,
        .x1 = box->x1 + margin,
        .y0 = box->y0 - margin,
        .y1 = box->y1 + margin,
        .to_scale = true,
        .width = panel->wide ? WIDE : NARROW,
        .height = panel->wide ? 560 : 480,
    };

    return chart_open(out, &axes);
}

/* Over the time of the panel's first run. */
static struct chart open_graph(FILE *out, const struct panel *panel, const char *y, double y0,
                               double y1)
{
    struct axes axes = {
        .words = panel->caption,
        .x = "t (s)",
        .y = y,
        .x1 = history_time(panel->run[0]->history.ticks - 1),
        .y0 = y0,
        .y1 = y1,
        .width = panel->wide ? WIDE : NARROW,
        .height = 320,
    };

    return chart_open(out, &axes);
}

static bool is_crowd(const struct history *history)
{
    return history->robots > CROWD;
}

/* The classes c0 to c7 are colours told apart; m0 to m9 a scale. */
static const char *class_of(const struct history *history, size_t robot)
{
    static const char few[8][3] = {"c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7"};
    static const char many[10][3] = {"m0", "m1", "m2", "m3", "m4", "m5", "m6", "m7", "m8", "m9"};

    return is_crowd(history) ? many[robot * 10 / history->robots] : few[robot % 8];
}

static const char *class_with(const struct history *history, size_t robot, const char *more)
{
    static char classes[32];

    snprintf(classes, sizeof classes, "%s %s", class_of(history, robot), more);
    return classes;
}

static size_t stride_of(const struct history *history)
{
    return history->ticks / (is_crowd(history) ? CROWD_POINTS : LINE_POINTS) + 1;
}

static void draw_route(const struct chart *chart, const struct history *history, size_t robot,
                       const char *classes, size_t from, size_t to)
{
    size_t stride = stride_of(history);

    chart_begin_line(chart, classes);
    for (size_t tick = from; tick < to; tick += stride) {
        const struct glimpse *g = history_at(history, tick, robot);
        chart_to(chart, g->x, g->y);
    }
    const struct glimpse *g = history_at(history, to, robot);
    chart_to(chart, g->x, g->y);
    chart_end_line(chart);
}

static void draw_marks(const struct chart *chart, const struct panel *panel)
{
    for (size_t i = 0; i < panel->moments; i++)
        chart_moment(chart, history_time(panel->tick[i]), panel->moment[i]);
}

static void key_of_robots(struct chart *chart, const struct run *run)
{
    for (size_t i = 0; i < run->history.robots && !is_crowd(&run->history); i++) {
        char words[16];
        snprintf(words, sizeof words, "robot %u", run->scenario->robots[i].id);
        chart_key(chart, class_of(&run->history, i), words);
    }
}

/* ---- routes ---------------------------------------------------------------------------- */

/* Lines from the leader to its live followers, and everyone as an arrowhead. */
static void draw_formation(const struct chart *chart, const struct history *history, size_t tick)
{
    size_t leader = history_leader(history, tick);

    for (size_t i = 0; i < history->robots && leader != NEVER && !is_crowd(history); i++) {
        const struct glimpse *from = history_at(history, tick, leader);
        const struct glimpse *to = history_at(history, tick, i);
        if (i != leader && to->alive)
            chart_segment(chart, "join", from->x, from->y, to->x, to->y);
    }
    for (size_t i = 0; i < history->robots; i++) {
        const struct glimpse *g = history_at(history, tick, i);
        if (!g->alive)
            continue;
        if (is_crowd(history))
            chart_dot(chart, class_with(history, i, "mark"), g->x, g->y, i == leader ? 4 : 1.6);
        else
            chart_robot(chart, class_of(history, i), g->x, g->y, g->theta);
        if (i == leader)
            chart_dot(chart, "ring", g->x, g->y, is_crowd(history) ? 7 : 11);
    }
}

static void draw_lost(const struct chart *chart, const struct history *history, size_t tick)
{
    for (size_t i = 0; i < history->robots; i++) {
        const struct glimpse *g = history_at(history, tick, i);
        if (!g->alive && chart_shows(chart, g->x, g->y))
            chart_cross(chart, g->x, g->y);
    }
}

void draw_routes(FILE *out, const struct panel *panel)
{
    const struct history *history = &panel->run[0]->history;
    struct box box = nothing;

    for (size_t i = 0; i < history->ticks * history->robots; i++)
        include(&box, history->glimpses[i].x, history->glimpses[i].y);
    double margin = 0.05 * fmax(box.x1 - box.x0, box.y1 - box.y0);
    struct chart chart = open_map(out, panel, &box, margin);
    for (size_t i = 0; i < history->robots; i++)
        draw_route(&chart, history, i, class_with(history, i, is_crowd(history) ? "fine" : ""), 0,
                   history->ticks - 1);
    for (size_t i = 0; i < history->robots; i++) {
        const struct glimpse *g = history_at(history, 0, i);
        chart_dot(&chart, class_with(history, i, "start"), g->x, g->y, is_crowd(history) ? 1 : 4);
    }
    for (size_t i = 0; i < panel->moments; i++)
        draw_formation(&chart, history, panel->tick[i]);
    draw_formation(&chart, history, history->ticks - 1);
    draw_lost(&chart, history, history->ticks - 1);
    key_of_robots(&chart, panel->run[0]);
    chart_close(&chart);
}

/* ---- snapshots ------------------------------------------------------------------------- */

/* Where vertex j, from 0, of the formation in force is. */
static void place_vertex(const struct run *run, size_t tick, size_t leader, size_t j, double *x,
                         double *y)
{
    const struct glimpse *about = history_at(&run->history, tick, leader);
    const struct scenario_formation *formation =
        &run->scenario->formations[run->history.formation[tick]];
    double direction = (double)about->theta + formation->psi[j];

    *x = (double)about->x + formation->L[j] * cos(direction);
    *y = (double)about->y + formation->L[j] * sin(direction);
}

static size_t vertices_at(const struct run *run, size_t tick)
{
    return run->scenario->formations[run->history.formation[tick]].count;
}

/* A square around all live robots and all vertices. */
static struct box frame_snapshot(const struct run *run, size_t tick, size_t leader)
{
    struct box box = nothing;
    double x, y;

    for (size_t i = 0; i < run->history.robots; i++) {
        const struct glimpse *g = history_at(&run->history, tick, i);
        if (g->alive)
            include(&box, g->x, g->y);
    }
    for (size_t j = 0; j < vertices_at(run, tick) && leader != NEVER; j++) {
        place_vertex(run, tick, leader, j, &x, &y);
        include(&box, x, y);
    }
    x = (box.x0 + box.x1) / 2;
    y = (box.y0 + box.y1) / 2;
    double half = fmax(box.x1 - box.x0, box.y1 - box.y0) / 2;
    return (struct box){x - half, x + half, y - half, y + half};
}

static void name_robot(const struct chart *chart, const struct run *run, size_t tick, size_t robot)
{
    static const char *const roles[] = {
        [ROLE_CANDIDATE] = "C", [ROLE_LEADER] = "L", [ROLE_FOLLOWER] = "F"};
    const struct glimpse *g = history_at(&run->history, tick, robot);
    char words[16];

    snprintf(words, sizeof words, "%u %s", run->scenario->robots[robot].id,
             g->alive ? roles[g->role] : "lost");
    chart_words(chart, g->x, g->y, words);
}

void draw_snapshot(FILE *out, const struct panel *panel)
{
    const struct run *run = panel->run[0];
    const struct history *history = &run->history;
    size_t tick = panel->tick[0];
    size_t leader = history_leader(history, tick);
    struct box box = frame_snapshot(run, tick, leader);
    struct chart chart = open_map(out, panel, &box, 0.2 * (box.x1 - box.x0));
    double x, y;

    for (size_t j = 0; j < vertices_at(run, tick) && leader != NEVER; j++) {
        place_vertex(run, tick, leader, j, &x, &y);
        chart_dot(&chart, "vertex", x, y, 9);
    }
    draw_formation(&chart, history, tick);
    draw_lost(&chart, history, tick);
    for (size_t i = 0; i < history->robots; i++) {
        const struct glimpse *g = history_at(history, tick, i);
        if (chart_shows(&chart, g->x, g->y))
            name_robot(&chart, run, tick, i);
    }
    chart_close(&chart);
}

/* ---- over time ------------------------------------------------------------------------- */

/* The value of a run at a tick. */
typedef double graph_value(const struct history *history, size_t tick, size_t robot);

static double error_of(const struct history *history, size_t tick, size_t robot)
{
    return history_at(history, tick, robot)->error;
}

static double mean_of(const struct history *history, size_t tick, size_t robot)
{
    (void)robot;
    return history_mean_error(history, tick);
}

static double omega_of(const struct history *history, size_t tick, size_t robot)
{
    return history_at(history, tick, robot)->omega;
}

/* Until the robot dies. */
static void draw_graph(const struct chart *chart, const struct history *history, size_t robot,
                       const char *classes, graph_value *value)
{
    size_t stride = stride_of(history);

    chart_begin_line(chart, classes);
    for (size_t tick = 0; tick < history->ticks; tick += stride) {
        if (value != mean_of && !history_at(history, tick, robot)->alive)
            break;
        chart_to(chart, history_time(tick), value(history, tick, robot));
    }
    chart_end_line(chart);
}

void draw_errors(FILE *out, const struct panel *panel)
{
    const struct history *history = &panel->run[0]->history;
    double highest = 0.01;

    for (size_t i = 0; i < history->ticks * history->robots; i++)
        highest = fmax(highest, history->glimpses[i].error);
    struct chart chart = open_graph(out, panel, "distance error (m)", 0, highest * 1.05);
    for (size_t i = 0; i < history->robots; i++)
        draw_graph(&chart, history, i, class_of(history, i), error_of);
    draw_graph(&chart, history, 0, "mean", mean_of);
    draw_marks(&chart, panel);
    key_of_robots(&chart, panel->run[0]);
    chart_key(&chart, "mean", "mean");
    chart_close(&chart);
}

static double highest_mean(const struct panel *panel)
{
    double highest = 0.01;

    for (size_t i = 0; i < panel->runs; i++)
        highest = fmax(highest, history_peak_error(&panel->run[i]->history, 0));
    return highest;
}

void draw_mean_errors(FILE *out, const struct panel *panel)
{
    struct chart chart =
        open_graph(out, panel, "mean distance error (m)", 0, highest_mean(panel) * 1.05);

    for (size_t i = 0; i < panel->runs; i++) {
        char classes[] = {'c', (char)('0' + i), '\0'};
        draw_graph(&chart, &panel->run[i]->history, 0, classes, mean_of);
        chart_key(&chart, classes, panel->word[i]);
    }
    draw_marks(&chart, panel);
    chart_close(&chart);
}

static bool same_job(const struct glimpse *a, const struct glimpse *b)
{
    return a->alive == b->alive && a->role == b->role && a->vertex == b->vertex;
}

/* What a robot does from one tick until another. */
static void draw_job(const struct chart *chart, const struct history *history, size_t robot,
                     size_t from, size_t to)
{
    const struct glimpse *g = history_at(history, from, robot);
    double y = -(double)robot;
    char words[24] = "candidate";

    if (!g->alive)
        return;
    if (g->role == ROLE_LEADER)
        snprintf(words, sizeof words, "leads");
    else if (g->role == ROLE_FOLLOWER && g->vertex == 0)
        snprintf(words, sizeof words, "no vertex");
    else if (g->role == ROLE_FOLLOWER)
        snprintf(words, sizeof words, "vertex %u", g->vertex);
    chart_bar(chart, class_with(history, robot, g->role == ROLE_LEADER ? "leads" : "follows"),
              history_time(from), history_time(to), y, 30);
    chart_words_inside(chart, history_time(from), history_time(to), y, words);
}

void draw_vertices(FILE *out, const struct panel *panel)
{
    const struct history *history = &panel->run[0]->history;
    struct chart chart = open_graph(out, panel, NULL, 0.7 - (double)history->robots, 0.8);

    for (size_t robot = 0; robot < history->robots; robot++) {
        char words[16];
        size_t from = 0;
        for (size_t tick = 1; tick < history->ticks; tick++) {
            if (tick + 1 < history->ticks &&
                same_job(history_at(history, from, robot), history_at(history, tick, robot)))
                continue;
            draw_job(&chart, history, robot, from, tick);
            from = tick;
        }
        snprintf(words, sizeof words, "robot %u", panel->run[0]->scenario->robots[robot].id);
        chart_words_before(&chart, -(double)robot, words);
    }
    draw_marks(&chart, panel);
    chart_close(&chart);
}

/* ---- one robot ------------------------------------------------------------------------- */

static void draw_reference(const struct chart *chart, const struct run *run)
{
    struct reference_state state = trajectory_start(run->scenario->trajectory);

    chart_begin_line(chart, "mean");
    for (size_t tick = 0; tick < run->history.ticks; tick++) {
        if (tick % stride_of(&run->history) == 0)
            chart_to(chart, state.x, state.y);
        state = trajectory_step(run->scenario->trajectory, &state);
    }
    chart_end_line(chart);
}

void draw_lone_routes(FILE *out, const struct panel *panel)
{
    struct box box = nothing;

    /* Where the routes differ is at their beginnings. */
    for (size_t i = 0; i < panel->runs; i++) {
        const struct history *history = &panel->run[i]->history;
        for (size_t tick = 0; tick < panel->tick[0] && tick < history->ticks; tick++)
            include(&box, history_at(history, tick, 0)->x, history_at(history, tick, 0)->y);
    }
    struct chart chart = open_map(out, panel, &box, 0.1 * (box.y1 - box.y0));
    draw_reference(&chart, panel->run[0]);
    chart_key(&chart, "mean", "reference");
    for (size_t i = 0; i < panel->runs; i++) {
        const struct history *history = &panel->run[i]->history;
        char classes[] = {'c', (char)('0' + i), '\0'};
        draw_route(&chart, history, 0, classes, 0, panel->tick[0]);
        chart_key(&chart, classes, panel->word[i]);
    }
    const struct glimpse *start = history_at(&panel->run[0]->history, 0, 0);
    chart_robot(&chart, "c7", start->x, start->y, start->theta);
    chart_close(&chart);
}

void draw_angular_velocities(FILE *out, const struct panel *panel)
{
    double lowest = 0, highest = 0;

    for (size_t i = 0; i < panel->runs; i++) {
        const struct history *history = &panel->run[i]->history;
        for (size_t tick = 0; tick < history->ticks; tick++) {
            lowest = fmin(lowest, omega_of(history, tick, 0));
            highest = fmax(highest, omega_of(history, tick, 0));
        }
    }
    double margin = 0.05 * (highest - lowest);
    struct chart chart = open_graph(out, panel, "angular velocity (rad/s)", lowest - margin,
                                    highest + margin);
    for (size_t i = 0; i < panel->runs; i++) {
        char classes[] = {'c', (char)('0' + i), '\0'};
        draw_graph(&chart, &panel->run[i]->history, 0, classes, omega_of);
        chart_key(&chart, classes, panel->word[i]);
    }
    chart_close(&chart);
}
