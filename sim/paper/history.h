/* history.h: what was seen of a run, kept tick by tick for the figures. */
#ifndef PAPER_HISTORY_H
#define PAPER_HISTORY_H

#include "sim.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A robot at a tick: a struct sample in a third of the room. */
struct glimpse {
    float x, y, theta, omega, error; /* m, m, rad, rad/s, m */
    uint16_t vertex;                 /* 0 = none */
    uint8_t role;                    /* enum role */
    bool alive;
};

struct history {
    size_t robots, ticks, room;
    struct glimpse *glimpses; /* [tick * robots + robot] */
    uint8_t *formation;       /* of each tick, index */
};

/* As a robot or a tick: there is none. */
#define NEVER SIZE_MAX

/* Room for a run of `duration` s. False when there is no memory. */
bool history_begin(struct history *history, size_t robots, double duration);
void history_free(struct history *history);

/* The next tick; what does not fit is left out. */
void history_add(struct history *history, const struct sim_tick *tick);

double history_time(size_t tick); /* s; INFINITY for NEVER */
size_t history_tick(const struct history *history, double time);
const struct glimpse *history_at(const struct history *history, size_t tick, size_t robot);

/* The mean distance error of the live, m. */
double history_mean_error(const struct history *history, size_t tick);

/* The largest mean distance error, and the mean's integral in m s, from a tick to the end. */
double history_peak_error(const struct history *history, size_t from);
double history_error_integral(const struct history *history, size_t from);

/* Who leads at a tick, or NEVER. */
size_t history_leader(const struct history *history, size_t tick);

/* Different vertices held by live followers. */
size_t history_held(const struct history *history, size_t tick);

/* The first tick at which a robot is dead, at which another than `leader` leads, at which the
 * formation is another than at the start; NEVER where it does not come to that. */
size_t history_death(const struct history *history);
size_t history_takeover(const struct history *history, size_t leader);
size_t history_reformation(const struct history *history);

#endif
