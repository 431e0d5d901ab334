/* history.h: what was seen of a run, kept tick by tick for its pictures. */
#ifndef HISTORY_H
#define HISTORY_H

#include "scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A robot at a tick: a struct scene_robot in a third of the room. */
struct glimpse {
    float x, y, theta, omega, error; /* m, m, rad, rad/s, m */
    uint16_t vertex;                 /* 0 = none */
    uint8_t role;                    /* enum role */
    bool alive;
};

/* What all robots of a tick share. */
struct moment {
    int32_t time_ms;
    uint8_t formation;                  /* index */
    struct scene_pose reference, about; /* as in struct scene */
};

/* A formation by its own axes: what it is placed about is at 0, heading along x. */
struct shape {
    char name[SCENE_NAME_MAX];
    size_t count; /* 0: nobody said where its vertices are */
    struct scene_point *vertices;
};

#define SHAPES_MAX 255

struct history {
    size_t robots, ticks, room;
    uint16_t *id;             /* of each robot */
    struct glimpse *glimpses; /* [tick * robots + robot] */
    struct moment *moments;   /* [tick] */
    size_t shapes;
    struct shape *shape;
};

/* As a robot or a tick: there is none. */
#define NEVER SIZE_MAX

/* Room for so many ticks, at least 1. False when there is no memory. */
bool history_begin(struct history *history, size_t robots, size_t room);
void history_free(struct history *history);

/* Another shape, its vertices for the caller to fill in. NULL when there is no memory, or no number
 * left for it. */
struct shape *history_add_shape(struct history *history, const char *name, size_t vertices);

/* Another tick, for the caller to fill in: moments[ticks - 1] and what this returns, a glimpse a
 * robot. NULL when there is no memory. */
struct glimpse *history_add(struct history *history);

double history_time(const struct history *history, size_t tick); /* s; INFINITY for NEVER */

/* The last tick that was not later, or the first. */
size_t history_tick(const struct history *history, double time);

const struct glimpse *history_at(const struct history *history, size_t tick, size_t robot);

/* Of the formation in force. */
const struct shape *history_shape_at(const struct history *history, size_t tick);

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
