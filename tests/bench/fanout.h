/* fanout.h: what `muster serve` does for every pose, bytes for each of a hundred robots, done by
 * others: by nobody but the kernel, and by a broker. */
#ifndef FANOUT_H
#define FANOUT_H

#include <netinet/in.h>
#include <stddef.h>

#define FANOUT_BYTES_MAX 120

struct fanout {
    struct sockaddr_in cameras; /* of a NatNet server; frames come to whoever keeps asking */
    size_t bytes;               /* for a robot and pose, FANOUT_BYTES_MAX at most */
    double seconds;
};

struct fanout_times {
    double p50, p99; /* us */
    double core;     /* part of one processor; of bare writes 0 */
};

/* A hundred writes: from before the first one to after the last. */
struct fanout_times fanout_bare(const struct fanout *fanout);

/* One write of a hundred messages to mosquitto, which has a subscriber for each: from a pose's
 * arrival at the publisher to the arrival of the last subscriber's bytes. The processor's time is
 * the broker's and the publisher's. `folder` is for the broker's settings. */
struct fanout_times fanout_mosquitto(const struct fanout *fanout, const char *folder);

#endif
