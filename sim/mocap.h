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

/* A moment at which it looked at all robots. */
struct mocap_sample {
    uint64_t number;
    double age; /* at the server's tick, s; below 1 / rate */
    uint16_t age_ms;
};

/* The newest sample at a server tick. */
struct mocap_sample mocap_newest(const struct mocap *mocap, uint64_t tick);

/* What a sample says of a robot, whose body was `seen` when it was taken. The noise is a draw by
 * (seed, robot, sample). */
struct server_pose mocap_pose(const struct mocap *mocap, const struct mocap_sample *sample,
                              uint16_t robot, const struct body *seen);

#endif
