/* calibrate_fleet.h: a scenario's robots calibrated in virtual time (rehearsal.h), with the bodies,
 * the motion capture and the radio of the scenario, each alone in the arena.
 *
 * Same scenario, seed and image, same results, with any number of threads. */
#ifndef CALIBRATE_FLEET_H
#define CALIBRATE_FLEET_H

#include "calibration.h"
#include "sim.h"

struct calibrate_fleet_options {
    enum sim_robots robots;
    const char *firmware; /* ELF file for SIM_AVR */
    uint64_t seed;
    unsigned threads; /* >= 1 */
    bool quiet;       /* no progress */
};

/* calibrations[i] is that of the scenario's i-th robot, ended, where SIM_DONE comes back: it may
 * have failed, its job's words say why. As of sim_run(), `error` says why for the others. */
enum sim_end calibrate_fleet(const struct scenario *scenario,
                             const struct calibrate_fleet_options *options,
                             const volatile bool *stop, struct calibration *calibrations,
                             char *error, size_t room);

#endif
