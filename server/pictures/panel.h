/* panel.h: the pictures of which figures are made. */
#ifndef PANEL_H
#define PANEL_H

#include "history.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#define PANEL_RUNS 4
#define PANEL_MOMENTS 16
#define CAPTION_MAX 160

struct panel;

typedef void panel_draw(FILE *out, const struct panel *panel);

struct panel {
    char caption[CAPTION_MAX];
    panel_draw *draw;
    bool wide;    /* as wide as two others */
    size_t until; /* the last tick that is shown, 0 = all */
    size_t runs, moments;
    const struct history *run[PANEL_RUNS];
    const char *word[PANEL_RUNS]; /* a run's name in the key */
    size_t tick[PANEL_MOMENTS];
    const char *moment[PANEL_MOMENTS]; /* what happened at that tick */
};

void panel_add(struct panel *panel, const struct history *history, const char *word);

/* Leaves out a tick that is NEVER, and what is too much. */
void panel_mark(struct panel *panel, size_t tick, const char *word);

/* Of a run: everyone's route, with the formation at the start, at the moments and at the end. */
panel_draw draw_routes;

/* Of a run: where everyone stands at the first moment, among the vertices. */
panel_draw draw_snapshot;

/* Of a run: everyone's distance error, and the mean. */
panel_draw draw_errors;

/* Of a run: everyone's role and vertex. */
panel_draw draw_vertices;

/* Of several runs: the mean distance error. */
panel_draw draw_mean_errors;

/* Of several runs of one robot: its route and the reference; its angular velocity. */
panel_draw draw_lone_routes;
panel_draw draw_angular_velocities;

#endif
