/* sim.h: a whole run of a scenario in virtual time. */
#ifndef SIM_H
#define SIM_H

#include "parameter_file.h"
#include "scenario.h"
#include "summary.h"
#include "view.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum sim_robots { SIM_AVR, SIM_NATIVE };

/* What those who look on may ask for, ACT_BIT(). */
#define SIM_ACTS (ACT_BIT(ACT_COUNT) - 1 - ACT_BIT(ACT_BEGIN))

/* A control tick, as it is in trace.csv. */
struct sim_tick {
    double t;                     /* s */
    size_t formation;             /* the one in force, index */
    const struct sample *samples; /* one per robot, gone after the call */
};

struct sim_options {
    enum sim_robots robots;
    const char *firmware; /* ELF file for SIM_AVR */
    /* Of the robots that it names; of the others, and all of them where this is NULL, the
     * defaults. */
    const struct parameter_file *parameters;
    const char *out; /* directory for the run's files, made when missing */
    uint64_t seed;
    unsigned threads;  /* >= 1 */
    bool trace;        /* write trace.csv and the figures */
    double speed;      /* times real time, no faster; 0: as fast as it goes */
    struct view *view; /* those who look on, and may act on it; NULL: nobody */
    bool quiet;        /* no progress */
    bool watch_stack;  /* of SIM_AVR, exactly (robot.h) */
    void (*watch)(void *watcher, const struct sim_tick *tick); /* sees every tick; NULL: nobody */
    void *watcher;
};

enum sim_end {
    SIM_DONE,
    SIM_INTERRUPTED, /* *stop became true, or one who looks on ended it; the files are complete up
                        to that moment */
    SIM_FAILED,      /* `error` says why */
    SIM_REFUSED,     /* the firmware is none of ours, `error` says why; nothing was begun */
};

/* Runs the scenario and writes trace.csv, events.csv, summary.json and the figures into
 * options->out, in place of an earlier run's, and says what came out in `summary`. `stop` is looked
 * at once a tick, ten times a second while it is paused, and may be set by a signal handler. What
 * those who look on do is in the files as well. */
enum sim_end sim_run(const struct scenario *scenario, const struct sim_options *options,
                     const volatile bool *stop, struct summary *summary, char *error, size_t room);

#endif
