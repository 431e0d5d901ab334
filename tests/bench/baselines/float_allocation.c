#include "float_allocation.h"

#include <math.h>
#include <string.h>

struct place {
    float x, y;
};

/* The leader's frame. */
struct frame {
    const struct float_contest *contest;
    float sin, cos;
};

static struct place place_of(const struct frame *frame, uint16_t vertex)
{
    const struct float_vertex *v = &frame->contest->vertex[vertex - 1];

    return (struct place){frame->contest->x + v->x * frame->cos - v->y * frame->sin,
                          frame->contest->y + v->x * frame->sin + v->y * frame->cos};
}

static float square_distance(struct place a, struct place b)
{
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

static float own_distance(const struct frame *frame, uint16_t vertex)
{
    struct place own = {frame->contest->own_x, frame->contest->own_y};

    return square_distance(own, place_of(frame, vertex));
}

static uint16_t closest(const struct frame *frame, const bool *taboo)
{
    uint16_t best = 0;
    float best_distance = INFINITY;

    for (uint16_t vertex = 1; vertex <= frame->contest->vertices; vertex++) {
        if (taboo[vertex - 1] || vertex == frame->contest->leader_vertex)
            continue;
        float distance = own_distance(frame, vertex);
        if (distance < best_distance) {
            best = vertex;
            best_distance = distance;
        }
    }
    return best;
}

static struct place position_of(const struct float_neighbour *n)
{
    float age = n->age / 1000.0f;
    float middle = n->theta + n->omega * age / 2;

    return (struct place){n->x + n->v * age * cosf(middle), n->y + n->v * age * sinf(middle)};
}

static bool lost(const struct frame *frame, uint16_t vertex)
{
    float own = own_distance(frame, vertex);

    for (uint16_t i = 0; i < frame->contest->neighbours; i++) {
        const struct float_neighbour *n = &frame->contest->neighbour[i];

        if (n->vertex != vertex)
            continue;
        float its = square_distance(position_of(n), place_of(frame, vertex));
        if (its < own || (its == own && n->id < frame->contest->own_id))
            return true;
    }
    return false;
}

uint16_t float_allocate(const struct float_contest *contest, bool *taboo)
{
    struct frame frame = {contest, sinf(contest->theta), cosf(contest->theta)};
    bool cleared = false;

    for (;;) {
        uint16_t vertex = closest(&frame, taboo);

        if (vertex == 0 && cleared)
            return 0;
        if (vertex == 0) {
            memset(taboo, 0, contest->vertices * sizeof *taboo);
            cleared = true;
        } else if (lost(&frame, vertex)) {
            taboo[vertex - 1] = true;
        } else {
            return vertex;
        }
    }
}
