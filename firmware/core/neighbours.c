#include "neighbours.h"

#include <stddef.h>

/* table->count when unknown. */
static uint8_t index_of(const struct neighbours *table, uint16_t id)
{
    uint8_t i = table->next;

    for (uint8_t left = table->count; left > 0; left--, i++) {
        if (i >= table->count)
            i = 0;
        if (table->entry[i].id == id)
            return i;
    }
    return table->count;
}

const struct neighbour *neighbours_find(const struct neighbours *table, uint16_t id)
{
    uint8_t i = index_of(table, id);

    return i < table->count ? &table->entry[i] : NULL;
}

/* Good enough to order by, and no multiplication. */
static int32_t street_distance(const struct vec32 *a, const struct vec32 *b)
{
    return abs32(a->x - b->x) + abs32(a->y - b->y);
}

/* table->count when all are candidates. */
static uint8_t farthest_other(const struct neighbours *table, const struct vec32 *own,
                              int32_t *reach)
{
    uint8_t farthest = table->count;

    *reach = -1;
    for (uint8_t i = 0; i < table->count; i++) {
        const struct neighbour *n = &table->entry[i];
        int32_t distance = street_distance(&n->pose.at, own);

        if (n->candidate || distance <= *reach)
            continue;
        *reach = distance;
        farthest = i;
    }
    return farthest;
}

/* The entry for a sender that is not in the table; NEIGHBOURS_MAX when nobody gives way. */
static uint8_t make_room(struct neighbours *table, const struct message_beacon *beacon,
                         const struct vec32 *own)
{
    int32_t reach;

    if (table->count < NEIGHBOURS_MAX)
        return table->count++;
    uint8_t farthest = farthest_other(table, own, &reach);
    if (beacon->candidate || street_distance(&beacon->pose.at, own) < reach)
        return farthest;
    return NEIGHBOURS_MAX;
}

bool neighbours_hear(struct neighbours *table, const struct message_beacon *beacon, uint8_t tick,
                     const struct vec32 *own)
{
    uint8_t i = index_of(table, beacon->id);

    if (i == table->count)
        i = make_room(table, beacon, own);
    if (i == NEIGHBOURS_MAX)
        return false;
    struct sincos heading = sincos_of(beacon->pose.theta);
    struct neighbour *n = &table->entry[i];

    table->next = i + 1;
    n->id = beacon->id;
    n->time = beacon->time;
    n->pose = beacon->pose;
    n->drift = (struct vec16){mul_q15(beacon->v, heading.cos), mul_q15(beacon->v, heading.sin)};
    n->omega = beacon->omega;
    n->vertex = beacon->vertex;
    n->formation = beacon->formation;
    n->heard = tick;
    n->role = beacon->role;
    n->candidate = beacon->candidate;
    n->fault = beacon->fault;
    return true;
}

void neighbours_expire(struct neighbours *table, uint8_t tick)
{
    struct neighbour *n = table->entry;

    for (uint8_t left = table->count; left > 0; left--) {
        if ((uint8_t)(tick - n->heard) > NEIGHBOUR_TIMEOUT_TICKS)
            *n = table->entry[--table->count];
        else
            n++;
    }
}

int16_t neighbour_speed(const struct neighbour *neighbour)
{
    return vec_along(neighbour->drift, sincos_of(neighbour->pose.theta));
}

void neighbour_pose(const struct neighbour *neighbour, uint16_t now, struct pose *pose)
{
    *pose = neighbour->pose;
    pose_advance(pose, neighbour_speed(neighbour), neighbour->omega,
                 (int16_t)neighbour_age(neighbour, now));
}
