#include "q16_allocation.h"

#include <string.h>

struct place {
    q16 x, y;
};

/* The leader's frame. */
struct frame {
    const struct q16_contest *contest;
    q16 sin, cos;
};

static struct place place_of(const struct frame *frame, uint16_t vertex)
{
    const struct q16_vertex *v = &frame->contest->vertex[vertex - 1];

    return (struct place){
        frame->contest->x + q16_mul(v->x, frame->cos) - q16_mul(v->y, frame->sin),
        frame->contest->y + q16_mul(v->x, frame->sin) + q16_mul(v->y, frame->cos),
    };
}

static q16 square_distance(struct place a, struct place b)
{
    return q16_mul(a.x - b.x, a.x - b.x) + q16_mul(a.y - b.y, a.y - b.y);
}

static q16 own_distance(const struct frame *frame, uint16_t vertex)
{
    struct place own = {frame->contest->own_x, frame->contest->own_y};

    return square_distance(own, place_of(frame, vertex));
}

static uint16_t closest(const struct frame *frame, const bool *taboo)
{
    uint16_t best = 0;
    q16 best_distance = INT32_MAX;

    for (uint16_t vertex = 1; vertex <= frame->contest->vertices; vertex++) {
        if (taboo[vertex - 1] || vertex == frame->contest->leader_vertex)
            continue;
        q16 distance = own_distance(frame, vertex);
        if (distance < best_distance) {
            best = vertex;
            best_distance = distance;
        }
    }
    return best;
}

static struct place position_of(const struct q16_neighbour *n)
{
    q16 age = (q16)((uint32_t)n->age * Q16_ONE / 1000);
    q16 chord = q16_mul(n->v, age);
    q16 s, c;

    q16_sincos(q16_wrap(n->theta + q16_mul(n->omega, age) / 2), &s, &c);
    return (struct place){n->x + q16_mul(chord, c), n->y + q16_mul(chord, s)};
}

static bool lost(const struct frame *frame, uint16_t vertex)
{
    q16 own = own_distance(frame, vertex);

    for (uint16_t i = 0; i < frame->contest->neighbours; i++) {
        const struct q16_neighbour *n = &frame->contest->neighbour[i];

        if (n->vertex != vertex)
            continue;
        q16 its = square_distance(position_of(n), place_of(frame, vertex));
        if (its < own || (its == own && n->id < frame->contest->own_id))
            return true;
    }
    return false;
}

uint16_t q16_allocate(const struct q16_contest *contest, bool *taboo)
{
    struct frame frame = {.contest = contest};
    bool cleared = false;

    q16_sincos(contest->theta, &frame.sin, &frame.cos);
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
