/* neighbours.h: what a robot has heard of the others. */
#ifndef NEIGHBOURS_H
#define NEIGHBOURS_H

#include "limits.h"
#include "message.h"

/* A neighbour not heard for this long is gone: ten beacons of a follower in range. */
#define NEIGHBOUR_TIMEOUT_TICKS TICKS_PER_S

struct neighbour {
    uint16_t id;
    uint16_t heard; /* tick at which its last beacon was used, modulo 65,536 */
    uint16_t time;  /* mission time of the state, ms modulo 65,536 */
    struct pose pose;
    int16_t v, omega;
    uint8_t role;
    bool candidate;
    bool fault;
    uint8_t formation;
    uint16_t vertex;
};

struct neighbours {
    uint8_t count;
    struct neighbour entry[NEIGHBOURS_MAX];
};

/* Keeps a beacon heard at `tick`. In a full table the farthest from `own` that is no candidate
 * makes room for a candidate or for one nearer. False when there was none to give way. */
bool neighbours_hear(struct neighbours *table, const struct message_beacon *beacon, uint16_t tick,
                     struct vec32 own);

/* Forgets those that were not heard for NEIGHBOUR_TIMEOUT_TICKS. To be called every tick. */
void neighbours_expire(struct neighbours *table, uint16_t tick);

/* NULL when unknown. */
const struct neighbour *neighbours_find(const struct neighbours *table, uint16_t id);

#endif
