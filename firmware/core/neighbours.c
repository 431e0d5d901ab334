#include "neighbours.h"

#include <stddef.h>

/* table->count when unknown. */
static uint8_t index_of(const struct neighbours *table, uint16_t id)
{
    uint8_t i = 0;

    while (i < table->count && table->entry[i].id != id)
        i++;
    return i;
}

const struct neighbour *neighbours_find(const struct neighbours *table, uint16_t id)
{
    uint8_t i = index_of(table, id);

    return i < table->count ? &table->entry[i] : NULL;
}

/* Good enough to order by, and no multiplication. */
static int32_t street_distance(struct vec32 a, struct vec32 b)
{
    return abs32(a.x - b.x) + abs32(a.y - b.y);
}

static struct neighbour *farthest_other(struct neighbours *table, struct vec32 own)
{
    struct neighbour *farthest = NULL;
    int32_t reach = -1;

    for (uint8_t i = 0; i < table->count; i++) {
        struct neighbour *n = &table->entry[i];
        int32_t distance = street_distance(n->pose.at, own);

        if (n->candidate || distance <= reach)
            continue;
        reach = distance;
        farthest = n;
    }
    return farthest;
}

static struct neighbour *place_for(struct neighbours *table, const struct message_beacon *beacon,
                                   struct vec32 own)
{
    uint8_t known = index_of(table, beacon->id);

    if (known < table->count)
        return &table->entry[known];
    if (table->count < NEIGHBOURS_MAX)
        return &table->entry[table->count++];

    struct neighbour *farthest = farthest_other(table, own);
    if (farthest == NULL)
        return NULL;
    bool nearer = street_distance(beacon->pose.at, own) < street_distance(farthest->pose.at, own);
    return beacon->candidate || nearer ? farthest : NULL;
}

bool neighbours_hear(struct neighbours *table, const struct message_beacon *beacon, uint16_t tick,
                     struct vec32 own)
{
    struct neighbour *n = place_for(table, beacon, own);

    if (n == NULL)
        return false;
    *n = (struct neighbour){
        .id = beacon->id,
        .heard = tick,
        .time = beacon->time,
        .pose = beacon->pose,
        .v = beacon->v,
        .omega = beacon->omega,
        .role = beacon->role,
        .candidate = beacon->candidate,
        .fault = beacon->fault,
        .formation = beacon->formation,
        .vertex = beacon->vertex,
    };
    return true;
}

void neighbours_expire(struct neighbours *table, uint16_t tick)
{
    uint8_t i = 0;

    while (i < table->count) {
        uint16_t silent = tick - table->entry[i].heard;

        if (silent > NEIGHBOUR_TIMEOUT_TICKS)
            table->entry[i] = table->entry[--table->count];
        else
            i++;
    }
}

/* Of its state, ms. One "from the future" has just been measured. */
static int16_t age_of(const struct neighbour *neighbour, uint16_t now)
{
    int16_t age = (int16_t)(uint16_t)(now - neighbour->time);

    return age < 0 ? 0 : age > STATE_AGE_MAX_MS ? STATE_AGE_MAX_MS : age;
}

void neighbour_pose(const struct neighbour *neighbour, uint16_t now, struct pose *pose)
{
    *pose = neighbour->pose;
    pose_advance(pose, neighbour->v, neighbour->omega, age_of(neighbour, now));
}

struct vec32 neighbour_position(const struct neighbour *neighbour, uint16_t now)
{
    struct vec16 gone =
        travelled(neighbour->pose.theta, neighbour->v, neighbour->omega, age_of(neighbour, now));

    return (struct vec32){neighbour->pose.at.x + gone.x, neighbour->pose.at.y + gone.y};
}
