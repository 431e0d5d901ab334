#define _GNU_SOURCE /* ppoll */

#include "sim_state.h"

#include "progress.h"

#include <math.h>
#include <poll.h>
#include <stdio.h>

/* Robots can be dragged so far from the origin, m: a little less than their positions can be. */
#define DRAG_MAX_M 2000.0

/* *stop is looked at so often while nothing else is to be done. */
#define NAP_NS 100000000

/* ---- what is told ---------------------------------------------------------------------- */

void steering_tell(struct sim *sim, const char *phase, bool over)
{
    struct view_status status = {
        .phase = phase,
        .paused = sim->pace.paused && !over,
        .over = over,
        .speed = sim->pace.speed,
    };

    if (sim->options->view != NULL)
        onlookers_status(sim->options->view, &sim->steer, status);
}

static void tell(struct sim *sim)
{
    steering_tell(sim, sim->pace.paused ? "paused" : "running", false);
}

void steering_begin(struct sim *sim)
{
    pace_begin(&sim->pace, sim->options->speed, wall_ns());
    tell(sim);
}

static void note(struct sim *sim, uint16_t robot, const char *event, const char *detail)
{
    record_note(sim->record, server_time(sim->server), robot, event, detail);
}

/* ---- what is done ---------------------------------------------------------------------- */

static bool drag(struct sim *sim, const struct act *act, char words[STEER_WORDS_MAX])
{
    size_t i = steer_robot(sim->scenario, act->robot, words);
    const struct scene_pose *to = &act->pose;
    char detail[80];

    if (i == SERVER_NOBODY)
        return false;
    if (fabs(to->x) > DRAG_MAX_M || fabs(to->y) > DRAG_MAX_M) {
        snprintf(words, STEER_WORDS_MAX, "robot %u cannot be moved farther than %g m from 0",
                 act->robot, DRAG_MAX_M);
        return false;
    }
    struct body *body = &sim->machine[i].body;
    body->x = to->x;
    body->y = to->y;
    body->theta = remainder(to->theta, 2 * M_PI);
    snprintf(detail, sizeof detail, "to %.3f m %.3f m %.3f rad", body->x, body->y, body->theta);
    note(sim, act->robot, "move", detail);
    return true;
}

static bool step(struct sim *sim, char words[STEER_WORDS_MAX])
{
    if (!sim->pace.paused) {
        snprintf(words, STEER_WORDS_MAX, "only a run that is paused goes on by one tick");
        return false;
    }
    pace_step(&sim->pace);
    return true;
}

/* What the core knows nothing of. */
static bool do_other(struct sim *sim, const struct act *act, char words[STEER_WORDS_MAX])
{
    switch (act->kind) {
    case ACT_MOVE: return drag(sim, act, words);
    case ACT_PAUSE: pace_pause(&sim->pace, true, wall_ns()); break;
    case ACT_RESUME: pace_pause(&sim->pace, false, wall_ns()); break;
    case ACT_STEP: return step(sim, words);
    case ACT_SPEED: pace_set_speed(&sim->pace, act->speed, wall_ns()); break;
    case ACT_END:
        note(sim, 0, "stop", "ended by one who looks on");
        sim->ended = true;
        break;
    default: snprintf(words, STEER_WORDS_MAX, "a simulation has no such act"); return false;
    }
    return true;
}

static bool carry_out(struct sim *sim, const struct act *act, char words[STEER_WORDS_MAX])
{
    enum steer_end end = steer(&sim->steer, act, words);

    if (end == STEER_OTHER)
        return do_other(sim, act, words);
    if (end == STEER_DONE && act->kind == ACT_DRAW)
        note(sim, 0, "draw", act->name);
    return end == STEER_DONE;
}

/* False when there is no memory for a robot. */
static bool do_acts(struct sim *sim)
{
    struct view *view = sim->options->view;
    struct act act;
    char words[STEER_WORDS_MAX];
    bool any = false;

    while (view_next_act(view, &act)) {
        bool done = carry_out(sim, &act, words);

        if (!sim_drain(sim))
            return false;
        view_answer(view, &act, done ? NULL : words);
        any = true;
    }
    if (!any)
        return true;
    tell(sim);
    /* A run that goes on shows it in its next tick. */
    if (sim->pace.paused && server_time(sim->server) >= 0)
        sim_show(sim);
    return true;
}

/* ---- until the next tick --------------------------------------------------------------- */

/* Until somebody wants something, or a signal comes. */
static void nap(const struct view *view, int64_t ns)
{
    struct pollfd acts = {.fd = view != NULL ? view_descriptor(view) : -1, .events = POLLIN};
    struct timespec limit = {0, ns < NAP_NS ? ns : NAP_NS};

    ppoll(&acts, 1, &limit, NULL);
}

bool steering_wait(struct sim *sim, const volatile bool *stop)
{
    struct view *view = sim->options->view;

    pace_tick(&sim->pace, wall_ns());
    for (;;) {
        if (view != NULL && !do_acts(sim))
            return false;
        int64_t wait = pace_wait_ns(&sim->pace, wall_ns());
        if (wait == 0 || *stop || sim->ended)
            return true;
        nap(view, wait);
    }
}
