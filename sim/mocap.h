/* mocap.h: how motion capture sees a robot: at its own rate, and not quite where it is. */
#ifndef MOCAP_H
#define MOCAP_H

#include "body.h"
#include "server.h"

/* A system of cameras. The first sample is taken at tick 0. */
struct mocap {
    unsigned rate;        /* samples a second, TICKS_PER_S at least */
    double place_noise;   /* standard deviation of x and of y, m */
    double heading_noise; /* standard deviation, rad */
    uint64_t seed;
};

/* An ideal robot is seen at every tick, as it is; a small one as in an arena. */
struct mocap mocap_of(const struct scenario *scenario, uint64_t seed);

/* How old the newest sample is at a server tick, s; below 1 / rate. */
double mocap_age(const struct mocap *mocap, uint64_t tick);

/* What the newest sample at `tick` says of a robot, whose body was `seen` when it was taken. The
 * noise is a draw by (seed, robot, sample). */
struct server_pose mocap_pose(const struct mocap *mocap, uint64_t tick, uint16_t robot,
                              const struct body *seen);

#endif
