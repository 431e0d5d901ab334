/* fleet.h: whole simulations, as they are measured. */
#ifndef FLEET_H
#define FLEET_H

#include "sim.h"

#define FLEET_FOUR BENCH_SCENARIOS "/paper-sim-leader-fault.yaml"
#define FLEET_HUNDRED BENCH_SCENARIOS "/paper-sim-100-v-mirrored.yaml"
#define FLEET_THOUSAND BENCH_FOLDER "/formation-1000.yaml"

struct fleet {
    const char *figure;
    const char *scenario, *setting;
    enum sim_robots robots;
    unsigned threads;
};

/* Runs it, without a trace. `view`: NULL, nobody looks on. */
struct summary fleet_run(const struct fleet *fleet, bool watch_stack, struct view *view);

#endif
