/* fanout.h: what `muster serve` does for every pose, bytes for each of a hundred robots, done by others:
 * by nobody but the kernel, and by a broker. */
#ifndef FANOUT_H
#define FANOUT_H

#include <netinet/in.h>
#include <stddef.h>

struct fanout {
    struct sockaddr_in cameras; /* where a NatNet server answers (PROTOCOL of sim/live/arena.h) */
    size_t bytes;               /* for a robot and pose */
    double seconds;
};

struct fanout_times {
    double p50, p99;   /* us */
    double core;       /* part of one processor */
};

/* A hundred writes, one after the other: from before the first one to after the last. */
struct fanout_times fanout_bare(const struct fanout *fanout);

/* One write of a hundred messages to mosquitto, which has a subscriber for each: from a pose's arrival
 * at the publisher to the arrival of the last subscriber's bytes. The processor's time is the broker's
 * and the publisher's. `folder` is for the broker's settings. */
struct fanout_times fanout_mosquitto(const struct fanout *fanout, const char *folder);

#endif
