#include "history.h"

#include "limits.h"
#include "message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool history_begin(struct history *history, size_t robots, size_t room)
{
    *history = (struct history){.robots = robots, .room = room};
    history->id = calloc(robots, sizeof *history->id);
    history->glimpses = calloc(room * robots, sizeof *history->glimpses);
    history->moments = calloc(room, sizeof *history->moments);
    if (history->id != NULL && history->glimpses != NULL && history->moments != NULL)
        return true;
    history_free(history);
    return false;
}

void history_free(struct history *history)
{
    for (size_t i = 0; i < history->shapes; i++)
        free(history->shape[i].vertices);
    free(history->shape);
    free(history->id);
    free(history->glimpses);
    free(history->moments);
    *history = (struct history){0};
}

struct shape *history_add_shape(struct history *history, const char *name, size_t vertices)
{
    struct shape *more = realloc(history->shape, (history->shapes + 1) * sizeof *more);

    if (more == NULL)
        return NULL;
    history->shape = more;
    struct shape *shape = &more[history->shapes];
    *shape =
        (struct shape){.count = vertices, .vertices = calloc(vertices, sizeof *shape->vertices)};
    if (history->shapes == SHAPES_MAX || (vertices > 0 && shape->vertices == NULL)) {
        free(shape->vertices);
        return NULL;
    }
    snprintf(shape->name, sizeof shape->name, "%s", name);
    history->shapes++;
    return shape;
}

static bool make_room(struct history *history)
{
    size_t room = 2 * history->room;
    struct glimpse *glimpses =
        realloc(history->glimpses, room * history->robots * sizeof *glimpses);

    if (glimpses == NULL)
        return false;
    history->glimpses = glimpses;
    struct moment *moments = realloc(history->moments, room * sizeof *moments);
    if (moments == NULL)
        return false;
    history->moments = moments;
    history->room = room;
    return true;
}

struct glimpse *history_add(struct history *history)
{
    if (history->ticks == history->room && !make_room(history))
        return NULL;
    return &history->glimpses[history->ticks++ * history->robots];
}

double history_time(const struct history *history, size_t tick)
{
    return tick == NEVER ? INFINITY : history->moments[tick].time_ms / 1000.0;
}

size_t history_tick(const struct history *history, double time)
{
    size_t low = 0, high = history->ticks;

    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;

        if (history_time(history, middle) > time + 1e-6)
            high = middle;
        else
            low = middle;
    }
    return low;
}

const struct glimpse *history_at(const struct history *history, size_t tick, size_t robot)
{
    return &history->glimpses[tick * history->robots + robot];
}

const struct shape *history_shape_at(const struct history *history, size_t tick)
{
    return &history->shape[history->moments[tick].formation];
}

double history_mean_error(const struct history *history, size_t tick)
{
    double sum = 0;
    size_t alive = 0;

    for (size_t i = 0; i < history->robots; i++) {
        const struct glimpse *g = history_at(history, tick, i);

        sum += g->alive ? (double)g->error : 0;
        alive += g->alive;
    }
    return alive > 0 ? sum / (double)alive : 0;
}

double history_peak_error(const struct history *history, size_t from)
{
    double peak = 0;

    for (size_t tick = from; tick < history->ticks; tick++)
        peak = fmax(peak, history_mean_error(history, tick));
    return peak;
}

double history_error_integral(const struct history *history, size_t from)
{
    double sum = 0;

    for (size_t tick = from; tick < history->ticks; tick++)
        sum += history_mean_error(history, tick);
    return sum / TICKS_PER_S;
}

size_t history_leader(const struct history *history, size_t tick)
{
    for (size_t i = 0; i < history->robots; i++) {
        const struct glimpse *g = history_at(history, tick, i);

        if (g->alive && g->role == ROLE_LEADER)
            return i;
    }
    return NEVER;
}

static bool is_held_before(const struct history *history, size_t tick, size_t robot)
{
    uint16_t vertex = history_at(history, tick, robot)->vertex;

    for (size_t i = 0; i < robot; i++) {
        const struct glimpse *g = history_at(history, tick, i);

        if (g->alive && g->role != ROLE_LEADER && g->vertex == vertex)
            return true;
    }
    return false;
}

size_t history_held(const struct history *history, size_t tick)
{
    size_t held = 0;

    for (size_t i = 0; i < history->robots; i++) {
        const struct glimpse *g = history_at(history, tick, i);

        held += g->alive && g->role != ROLE_LEADER && g->vertex != 0 &&
                !is_held_before(history, tick, i);
    }
    return held;
}

static bool someone_is_dead(const struct history *history, size_t tick)
{
    for (size_t i = 0; i < history->robots; i++)
        if (!history_at(history, tick, i)->alive)
            return true;
    return false;
}

size_t history_death(const struct history *history)
{
    for (size_t tick = 0; tick < history->ticks; tick++)
        if (someone_is_dead(history, tick))
            return tick;
    return NEVER;
}

size_t history_takeover(const struct history *history, size_t leader)
{
    for (size_t tick = 0; tick < history->ticks; tick++) {
        size_t leads = history_leader(history, tick);

        if (leads != NEVER && leads != leader)
            return tick;
    }
    return NEVER;
}

size_t history_reformation(const struct history *history)
{
    for (size_t tick = 1; tick < history->ticks; tick++)
        if (history->moments[tick].formation != history->moments[0].formation)
            return tick;
    return NEVER;
}
