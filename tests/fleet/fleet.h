/* fleet.h: runs whole fleets for the tests of this folder. */
#ifndef FLEET_H
#define FLEET_H

#include "sim.h"

#include <stdbool.h>
#include <stdio.h>

/* What a run is of; what is not named is the scenario's or sim's default. */
struct fleet_run {
    const char *file; /* under scenarios/, or NULL: `text` */
    const char *text;
    const char *settings[8]; /* of --set, ended by NULL */
    enum sim_robots robots;
    uint64_t seed;                           /* 0: 1 */
    unsigned threads;                        /* 0: 1 */
    const struct parameter_file *parameters; /* of sim.h; NULL: the defaults */
    const char *out;   /* below the test's working directory; NULL: no trace is kept */
    struct view *view; /* of sim.h, and so are the next two */
    void (*watch)(void *watcher, const struct sim_tick *tick);
    void *watcher;
    enum sim_end end; /* how it is to end */
};

/* What came out. The run must end as it is to, or the test fails with its words; and no chip's
 * stack may become deeper than cmake/stack-bound.sh says that it can. */
struct fleet_result {
    struct summary summary; /* its `scenario` is gone */
    uint16_t leader;        /* id at the end, 0 = none */
};

struct fleet_result fleet_run(const struct fleet_run *run);

/* The file under scenarios/ passes `muster sim --check` and is named after its scenario. */
void fleet_check(const char *file);

/* One row of a trace. */
struct fleet_row {
    double t, x, y, theta, v, omega, error;
    unsigned robot, vertex, alive;
    char role;
};

/* Opens the trace of a run that had `out`; then row by row, false at its end. */
FILE *fleet_trace(const char *out);
bool fleet_next(FILE *trace, struct fleet_row *row);

/* Both runs' trace.csv and events.csv are the same, byte for byte. */
void fleet_same_files(const char *out_a, const char *out_b);

/* The first time at which `robot` (0: any) has role L and time is at least `from`; -1: never. */
double fleet_leads_at(const char *out, unsigned robot, double from);

#endif
