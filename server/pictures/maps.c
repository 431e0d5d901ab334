/* maps.c: panels seen from above. */
#include "drawing.h"

#include "message.h"

#include <math.h>
#include <stdio.h>

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

static void include_routes(struct box *box, const struct panel *panel,
                           const struct history *history)
{
    for (size_t tick = 0; tick <= panel_end(panel, history); tick++) {
        for (size_t i = 0; i < history->robots; i++) {
            const struct glimpse *g = history_at(history, tick, i);
            include(box, g->x, g->y);
        }
    }
}

/* With a margin, as a share of the longer side. */
static struct chart open_map(FILE *out, const struct panel *panel, const struct box *box,
                             double height, double margin)
{
    double around = margin * fmax(box->x1 - box->x0, box->y1 - box->y0);
    struct axes axes = {
        .words = panel->caption,
        .x = "x (m)",
        .y = "y (m)",
        .x0 = box->x0 - around,
        .x1 = box->x1 + around,
        .y0 = box->y0 - around,
        .y1 = box->y1 + around,
        .to_scale = true,
        .trimmed = is_crowd(panel->run[0]),
        .width = panel_width(panel),
        .height = height,
    };

    return chart_open(out, &axes);
}

static void draw_route(const struct chart *chart, const struct panel *panel,
                       const struct history *history, size_t robot, const char *classes)
{
    size_t end = panel_end(panel, history);

    chart_begin_line(chart, classes);
    for (size_t tick = 0; tick < end; tick += panel_stride(panel, history)) {
        const struct glimpse *g = history_at(history, tick, robot);
        chart_to(chart, g->x, g->y);
    }
    const struct glimpse *g = history_at(history, end, robot);
    chart_to(chart, g->x, g->y);
    chart_end_line(chart);
}

/* ---- formations ------------------------------------------------------------------------ */

static void draw_robot(const struct chart *chart, const struct history *history, size_t tick,
                       size_t robot)
{
    const struct glimpse *g = history_at(history, tick, robot);
    bool leads = g->role == ROLE_LEADER;

    if (!g->alive)
        return;
    if (is_crowd(history))
        chart_dot(chart, robot_classes(history, robot, "mark"), g->x, g->y, leads ? 4 : 1.6);
    else
        chart_robot(chart, robot_class(history, robot), g->x, g->y, g->theta);
    if (leads)
        chart_dot(chart, "ring", g->x, g->y, is_crowd(history) ? 7 : 11);
}

/* Everyone, with lines from the leader to its live followers. */
static void draw_formation(const struct chart *chart, const struct history *history, size_t tick)
{
    size_t leader = history_leader(history, tick);

    for (size_t i = 0; i < history->robots && leader != NEVER && !is_crowd(history); i++) {
        const struct glimpse *from = history_at(history, tick, leader);
        const struct glimpse *to = history_at(history, tick, i);
        if (i != leader && to->alive)
            chart_segment(chart, "join", from->x, from->y, to->x, to->y);
    }
    for (size_t i = 0; i < history->robots; i++)
        draw_robot(chart, history, tick, i);
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
    const struct history *history = panel->run[0];
    struct box box = nothing;

    include_routes(&box, panel, history);
    struct chart chart = open_map(out, panel, &box, 480, 0.05);
    for (size_t i = 0; i < history->robots; i++)
        draw_route(&chart, panel, history, i,
                   robot_classes(history, i, is_crowd(history) ? "fine" : ""));
    for (size_t i = 0; i < history->robots; i++) {
        const struct glimpse *g = history_at(history, 0, i);
        chart_dot(&chart, robot_classes(history, i, "start"), g->x, g->y,
                  is_crowd(history) ? 1 : 4);
    }
    for (size_t i = 0; i < panel->moments; i++)
        draw_formation(&chart, history, panel->tick[i]);
    draw_formation(&chart, history, panel_end(panel, history));
    draw_lost(&chart, history, panel_end(panel, history));
    draw_key_of_robots(&chart, history);
    chart_close(&chart);
}

/* ---- snapshots ------------------------------------------------------------------------- */

/* Where vertex j, from 0, of the formation in force is. */
static void place_vertex(const struct history *history, size_t tick, size_t leader, size_t j,
                         double *x, double *y)
{
    const struct glimpse *about = history_at(history, tick, leader);
    const struct scene_point *vertex = &history_shape_at(history, tick)->vertices[j];
    double along = cos((double)about->theta), across = sin((double)about->theta);

    *x = (double)about->x + along * vertex->x - across * vertex->y;
    *y = (double)about->y + across * vertex->x + along * vertex->y;
}

/* A square around all live robots and all vertices. */
static struct box frame_snapshot(const struct history *history, size_t tick, size_t leader)
{
    struct box box = nothing;
    double x, y;

    for (size_t i = 0; i < history->robots; i++) {
        const struct glimpse *g = history_at(history, tick, i);
        if (g->alive)
            include(&box, g->x, g->y);
    }
    for (size_t j = 0; j < history_shape_at(history, tick)->count && leader != NEVER; j++) {
        place_vertex(history, tick, leader, j, &x, &y);
        include(&box, x, y);
    }
    x = (box.x0 + box.x1) / 2;
    y = (box.y0 + box.y1) / 2;
    double half = fmax(box.x1 - box.x0, box.y1 - box.y0) / 2;
    return (struct box){x - half, x + half, y - half, y + half};
}

static void draw_vertices_of(const struct chart *chart, const struct history *history, size_t tick,
                             size_t leader)
{
    const struct shape *shape = history_shape_at(history, tick);
    double x, y;

    for (size_t j = 0; j < shape->count && leader != NEVER; j++) {
        if (shape->vertices[j].x == 0 && shape->vertices[j].y == 0)
            continue;
        place_vertex(history, tick, leader, j, &x, &y);
        chart_dot(chart, "vertex", x, y, 9);
    }
}

static void name_robot(const struct chart *chart, const struct history *history, size_t tick,
                       size_t robot)
{
    static const char *const roles[] = {
        [ROLE_CANDIDATE] = "C", [ROLE_LEADER] = "L", [ROLE_FOLLOWER] = "F"};
    const struct glimpse *g = history_at(history, tick, robot);
    char words[16];

    if (!chart_shows(chart, g->x, g->y))
        return;
    snprintf(words, sizeof words, "%u %s", history->id[robot], g->alive ? roles[g->role] : "lost");
    chart_words(chart, g->x, g->y, words);
}

void draw_snapshot(FILE *out, const struct panel *panel)
{
    const struct history *history = panel->run[0];
    size_t tick = panel->tick[0];
    size_t leader = history_leader(history, tick);
    struct box box = frame_snapshot(history, tick, leader);
    struct chart chart = open_map(out, panel, &box, 440, 0.15);

    draw_vertices_of(&chart, history, tick, leader);
    draw_formation(&chart, history, tick);
    draw_lost(&chart, history, tick);
    for (size_t i = 0; i < history->robots; i++)
        name_robot(&chart, history, tick, i);
    chart_close(&chart);
}

/* ---- one robot ------------------------------------------------------------------------- */

static void draw_reference(const struct chart *chart, const struct panel *panel)
{
    const struct history *history = panel->run[0];

    chart_begin_line(chart, "mean");
    for (size_t tick = 0; tick <= panel_end(panel, history); tick += panel_stride(panel, history))
        chart_to(chart, history->moments[tick].reference.x, history->moments[tick].reference.y);
    chart_end_line(chart);
}

void draw_lone_routes(FILE *out, const struct panel *panel)
{
    const struct glimpse *start = history_at(panel->run[0], 0, 0);
    struct box box = nothing;

    for (size_t i = 0; i < panel->runs; i++)
        include_routes(&box, panel, panel->run[i]);
    struct chart chart = open_map(out, panel, &box, 320, 0.1);
    draw_reference(&chart, panel);
    chart_key(&chart, "mean", "reference");
    for (size_t i = 0; i < panel->runs; i++) {
        draw_route(&chart, panel, panel->run[i], 0, run_class(i));
        chart_key(&chart, run_class(i), panel->word[i]);
    }
    chart_robot(&chart, "c7", start->x, start->y, start->theta);
    chart_close(&chart);
}
