/* driven.h: what motion capture sees of a robot whose wheels are known, on a calibration's drive.
 */
#ifndef DRIVEN_H
#define DRIVEN_H

#include "drive.h"
#include "wheel_fit.h"

struct driven {
    double wheel_max; /* m/s, nominal */
    double gain[WHEELS], dead[WHEELS];
    double track, lag;
    bool swapped; /* each motor turns the other one's wheel */
    double heading, ahead, aside;
    double latest; /* s: the delay from sending to effect is 25 ms and up to so much more */
    bool noisy;    /* as an arena of cameras (mocap.h) */
};

/* The record of a whole drive, seen 50 times a second, which began at (1, -2), heading 2 rad. */
void driven_record(const struct driven *robot, const struct drive_plan *plan, uint32_t seed,
                   struct drive_record *record);

#endif
