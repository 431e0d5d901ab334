#include "history.h"

#include "limits.h"
#include "message.h"

#include <math.h>
#include <stdlib.h>

bool history_begin(struct history *history, size_t robots, double duration)
{
    size_t room = (size_t)ceil(duration * TICKS_PER_S) + 1;

    *history = (struct history){.robots = robots, .room = room};
    history->glimpses = calloc(room * robots, sizeof *history->glimpses);
    history->formation = calloc(room, sizeof *history->formation);
    return history->glimpses != NULL && history->formation != NULL;
}

void history_free(struct history *history)
{
    free(history->glimpses);
    free(history->formation);
    *history = (struct history){0};
}

void history_add(struct history *history, const struct sim_tick *tick)
{
    if (history->ticks == history->room)
        return;
    for (size_t i = 0; i < history->robots; i++) {
        const struct sample *s = &tick->samples[i];

        history->glimpses[history->ticks * history->robots + i] = (struct glimpse){
            .x = (float)s->x,
            .y = (float)s->y,
            .theta = (float)s->theta,
            .omega = (float)s->omega,
            .error = (float)s->distance_error,
            .vertex = s->vertex,
            .role = s->role,
            .alive = s->alive,
        };
    }
    history->formation[history->ticks++] = (uint8_t)tick->formation;
}

double history_time(size_t tick)
{
    return tick == NEVER ? INFINITY : (double)tick / TICKS_PER_S;
}

size_t history_tick(const struct history *history, double time)
{
    size_t tick = time > 0 ? (size_t)lround(time * TICKS_PER_S) : 0;

    return tick < history->ticks ? tick : history->ticks - 1;
}

const struct glimpse *history_at(const struct history *history, size_t tick, size_t robot)
{
    return &history->glimpses[tick * history->robots + robot];
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
        if (history->formation[tick] != history->formation[0])
            return tick;
    return NEVER;
}
