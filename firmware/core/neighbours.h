/* neighbours.h: what a robot has heard of the others. */
#ifndef NEIGHBOURS_H
#define NEIGHBOURS_H

#include "limits.h"
#include "message.h"

/* A neighbour not heard for this long is gone: ten beacons of a follower in range. */
#define NEIGHBOUR_TIMEOUT_TICKS TICKS_PER_S

/* A state older than this is not carried on: whoever sent it may be anywhere. */
#define STATE_AGE_MAX_MS 1000

struct neighbour {
    uint16_t id;
    uint16_t time; /* mission time of the state, ms modulo 65,536 */
    struct pose pose;
    struct vec16 drift; /* its velocity, narrow */
    int16_t omega;
    uint16_t vertex;
    uint8_t formation;
    uint8_t heard; /* tick at which its last beacon was used, modulo 256 */
    uint8_t role : 2;
    bool candidate : 1;
    bool fault : 1;
};

_Static_assert(NEIGHBOUR_TIMEOUT_TICKS < 256, "ticks since a beacon are counted in a byte");

struct neighbours {
    uint8_t count;
    uint8_t next; /* where the search for a sender begins: beacons keep coming in the same order */
    struct neighbour entry[NEIGHBOURS_MAX];
};

/* Keeps a beacon heard at `tick`. In a full table the farthest from `own` that is no candidate
 * makes room for a candidate or for one nearer. False when there was none to give way. */
bool neighbours_hear(struct neighbours *table, const struct message_beacon *beacon, uint8_t tick,
                     const struct vec32 *own);

/* Forgets those that were not heard for NEIGHBOUR_TIMEOUT_TICKS. To be called every tick. */
void neighbours_expire(struct neighbours *table, uint8_t tick);

/* Age of its state, ms, STATE_AGE_MAX_MS at most. One "from the future" has just been measured. */
static inline uint16_t neighbour_age(const struct neighbour *neighbour, uint16_t now)
{
    int16_t age = (int16_t)(uint16_t)(now - neighbour->time);

    return age < 0 ? 0 : age > STATE_AGE_MAX_MS ? STATE_AGE_MAX_MS : (uint16_t)age;
}

/* Its speed, narrow: the drift along its heading. */
int16_t neighbour_speed(const struct neighbour *neighbour);

/* The pose at `now` (mission time, ms modulo 65,536) if it has gone on as it said, for
 * STATE_AGE_MAX_MS at most. */
void neighbour_pose(const struct neighbour *neighbour, uint16_t now, struct pose *pose);

/* The position alone, as if it had gone straight on, its age taken in whole 1/256 s: for a
 * comparison that is made with many of them. */
static inline void neighbour_position(const struct neighbour *neighbour, uint16_t now,
                                      struct vec32 *at)
{
    uint16_t ms = neighbour_age(neighbour, now);
    uint8_t age = (uint8_t)((uint16_t)(ms * 65u + (ms >> 1)) >> 8);

    at->x = neighbour->pose.at.x + mul16_8_high(neighbour->drift.x, age);
    at->y = neighbour->pose.at.y + mul16_8_high(neighbour->drift.y, age);
}

/* NULL when unknown. */
const struct neighbour *neighbours_find(const struct neighbours *table, uint16_t id);

#endif
