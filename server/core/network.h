/* network.h: the radio between the robots, emulated: who hears a beacon, when, and whether. */
#ifndef NETWORK_H
#define NETWORK_H

#include "outbox.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A beacon on its way. */
struct beacon_in_flight {
    uint64_t due;  /* tick at which it is relayed */
    size_t sender; /* index */
    uint32_t sequence;
    bool to_all;
    struct beacon_frame frame;
};

/* One robot's place in the network. */
struct station {
    double x, y;
    bool tracked; /* has a place; without one only the long range reaches it */
    bool linked;
    bool muted;
    uint16_t group; /* of a partition */
    uint16_t id;
    int32_t column, row; /* its cell */
    int32_t next;        /* in its bucket; -1 = last */
};

struct network {
    uint64_t seed;
    double range, loss;
    uint32_t delay_ticks;
    size_t station_count;
    struct station *station;
    size_t cell_count; /* a power of two */
    int32_t *cell;     /* buckets of cells: the first station, -1 = none */
    size_t flight_room, flight_first, flight_count;
    struct beacon_in_flight *flight;
    uint64_t dropped;
};

/* Sends a beacon at `tick`. One that finds no room in the air is dropped and counted. */
void network_send(struct network *network, uint64_t tick, size_t sender, uint32_t sequence,
                  bool to_all, const struct beacon_frame *frame);

/* Delivers to `outbox` (one per station) what is due at `tick`, at the stations' places of now.
 * Delays never reorder beacons. */
void network_deliver(struct network *network, uint64_t tick, struct outbox *outbox);

/* True when the beacon is lost: a hash of its name against the loss, so that no beacon's fate
 * depends on another's. */
bool network_loses(const struct network *network, uint16_t sender, uint16_t receiver,
                   uint32_t sequence);

#endif
