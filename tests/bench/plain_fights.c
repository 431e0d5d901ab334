#include "plain_fights.h"

#include "si.h"

/* A part of a vertex, wide. */
static int32_t wide(const struct fight *fight, int16_t part)
{
    return part * ((int32_t)1 << fight->scale);
}

static struct float_neighbour float_neighbour(const struct fight *fight, uint8_t index)
{
    struct message_beacon b = fight_beacon(fight, index);

    return (struct float_neighbour){
        float_metres(b.pose.at.x),
        float_metres(b.pose.at.y),
        float_radians(b.pose.theta),
        float_metres(b.v),
        float_rate(b.omega),
        fight->now - b.time,
        b.id,
        b.vertex,
    };
}

void float_fight(const struct fight *fight, struct float_contest *contest,
                 struct float_vertex *vertex, struct float_neighbour *neighbour)
{
    struct vec16 place;

    *contest = (struct float_contest){
        .x = float_metres(fight->base.at.x),
        .y = float_metres(fight->base.at.y),
        .theta = float_radians(fight->base.theta),
        .own_x = float_metres(fight->own.at.x),
        .own_y = float_metres(fight->own.at.y),
        .own_id = FIGHT_OWN_ID,
        .leader_vertex = fight->leader,
        .vertices = fight->size.vertices,
        .neighbours = fight->size.neighbours,
        .vertex = vertex,
        .neighbour = neighbour,
    };
    for (uint8_t rank = 0; rank < fight->size.vertices; rank++) {
        struct float_vertex *v = &vertex[fight_vertex(fight, rank, &place) - 1];

        v->x = float_metres(wide(fight, place.x));
        v->y = float_metres(wide(fight, place.y));
    }
    for (uint8_t i = 0; i < fight->size.neighbours; i++)
        neighbour[i] = float_neighbour(fight, i);
}

static struct q16_neighbour q16_neighbour(const struct fight *fight, uint8_t index)
{
    struct message_beacon b = fight_beacon(fight, index);

    return (struct q16_neighbour){
        q16_metres(b.pose.at.x),
        q16_metres(b.pose.at.y),
        q16_radians(b.pose.theta),
        q16_metres(b.v),
        q16_rate(b.omega),
        fight->now - b.time,
        b.id,
        b.vertex,
    };
}

void q16_fight(const struct fight *fight, struct q16_contest *contest, struct q16_vertex *vertex,
               struct q16_neighbour *neighbour)
{
    struct vec16 place;

    *contest = (struct q16_contest){
        .x = q16_metres(fight->base.at.x),
        .y = q16_metres(fight->base.at.y),
        .theta = q16_radians(fight->base.theta),
        .own_x = q16_metres(fight->own.at.x),
        .own_y = q16_metres(fight->own.at.y),
        .own_id = FIGHT_OWN_ID,
        .leader_vertex = fight->leader,
        .vertices = fight->size.vertices,
        .neighbours = fight->size.neighbours,
        .vertex = vertex,
        .neighbour = neighbour,
    };
    for (uint8_t rank = 0; rank < fight->size.vertices; rank++) {
        struct q16_vertex *v = &vertex[fight_vertex(fight, rank, &place) - 1];

        v->x = q16_metres(wide(fight, place.x));
        v->y = q16_metres(wide(fight, place.y));
    }
    for (uint8_t i = 0; i < fight->size.neighbours; i++)
        neighbour[i] = q16_neighbour(fight, i);
}
