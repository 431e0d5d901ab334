#include "drawing.h"

#include <stdio.h>

#define CROWD 16        /* robots; more are a crowd */
#define LINE_POINTS 400 /* of a line; of a crowd's: */
#define CROWD_POINTS 120

void panel_add(struct panel *panel, const struct history *history, const char *word)
{
    panel->run[panel->runs] = history;
    panel->word[panel->runs++] = word;
}

void panel_mark(struct panel *panel, size_t tick, const char *word)
{
    if (tick == NEVER || panel->moments == PANEL_MOMENTS)
        return;
    panel->tick[panel->moments] = tick;
    panel->moment[panel->moments++] = word;
}

double panel_width(const struct panel *panel)
{
    return panel->wide ? WIDE : NARROW;
}

size_t panel_end(const struct panel *panel, const struct history *history)
{
    size_t last = history->ticks - 1;

    return panel->until == 0 || panel->until > last ? last : panel->until;
}

bool is_crowd(const struct history *history)
{
    return history->robots > CROWD;
}

size_t panel_stride(const struct panel *panel, const struct history *history)
{
    return panel_end(panel, history) / (is_crowd(history) ? CROWD_POINTS : LINE_POINTS) + 1;
}

const char *run_class(size_t i)
{
    static const char classes[8][3] = {"c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7"};

    return classes[i % 8];
}

const char *robot_class(const struct history *history, size_t robot)
{
    static const char scale[10][3] = {"m0", "m1", "m2", "m3", "m4", "m5", "m6", "m7", "m8", "m9"};

    return is_crowd(history) ? scale[robot * 10 / history->robots] : run_class(robot);
}

const char *robot_classes(const struct history *history, size_t robot, const char *more)
{
    static char classes[32];

    snprintf(classes, sizeof classes, "%s %s", robot_class(history, robot), more);
    return classes;
}

void draw_key_of_robots(struct chart *chart, const struct history *history)
{
    char words[16];

    for (size_t i = 0; i < history->robots && !is_crowd(history); i++) {
        snprintf(words, sizeof words, "robot %u", history->id[i]);
        chart_key(chart, robot_class(history, i), words);
    }
}
