#include "allocation.h"

#include <string.h>

static void mark(uint8_t *set, uint16_t vertex)
{
    set[(vertex - 1) >> 3] |= (uint8_t)(1u << ((vertex - 1) & 7));
}

void allocation_begin(struct allocation_state *state)
{
    memset(state, 0, sizeof *state);
}

void allocation_under(struct allocation_state *state, uint16_t leader, uint8_t formation)
{
    if (state->leader == leader && state->formation == formation)
        return;
    memset(state->taboo, 0, sizeof state->taboo);
    if (state->formation != formation)
        state->held = 0;
    state->leader = leader;
    state->formation = formation;
}

static inline int16_t scaled(int16_t part, uint8_t coarser)
{
    while (coarser-- > 0)
        part >>= 1;
    return part;
}

static uint16_t apart(int16_t a, int16_t b)
{
    return a > b ? (uint16_t)(a - b) : (uint16_t)(b - a);
}

/* The closest vertex so far. */
struct choice {
    uint16_t vertex; /* 0 = none */
    uint16_t bound;  /* no closer one is farther than this along x or y */
    uint32_t square;
};

static void consider(struct choice *choice, uint16_t vertex, uint16_t dx, uint16_t dy)
{
    uint32_t square = (uint32_t)dx * dx + (uint32_t)dy * dy;

    if (square >= choice->square)
        return;
    choice->vertex = vertex;
    choice->bound = dx + dy;
    choice->square = square;
}

/* The closest vertex that is neither on the taboo list nor the leader's; 0 = none. Most are out of
 * the question by one coordinate, without a multiplication or a call. */
static uint16_t closest(const struct allocation_view *view, const uint8_t *taboo)
{
    const struct vec16 *place = view->formation->vertex;
    const struct vec16 at = view->at;
    const uint8_t coarser = view->scale - view->formation->scale; /* mostly 0 */
    const uint16_t leader = view->formation->leader;
    struct choice choice = {.bound = UINT16_MAX, .square = UINT32_MAX};
    uint8_t marks = 0;

    for (uint16_t vertex = 1; vertex <= view->formation->total; vertex++, place++) {
        if (((uint8_t)vertex & 7) == 1)
            marks = *taboo++;
        bool free = !(marks & 1);
        marks >>= 1;
        uint16_t dx = apart(scaled(place->x, coarser), at.x);
        if (dx > choice.bound || !free)
            continue;
        uint16_t dy = apart(scaled(place->y, coarser), at.y);
        if (dy <= choice.bound && vertex != leader)
            consider(&choice, vertex, dx, dy);
    }
    return choice.vertex;
}

static bool rivals(const struct allocation_view *view, const struct neighbour *n, uint16_t vertex)
{
    if (n->id == view->leader || n->role == ROLE_LEADER)
        return false;
    return view->literal || (n->vertex == vertex && n->formation == view->formation->number);
}

static bool lost(const struct allocation_view *view, uint16_t vertex)
{
    for (uint8_t i = 0; i < view->neighbours->count; i++) {
        const struct neighbour *n = &view->neighbours->entry[i];

        if (!rivals(view, n, vertex))
            continue;
        int8_t order = view->compare(view->context, n, vertex);
        if (order < 0 || (order == 0 && n->id < view->id))
            return true;
    }
    return false;
}

void allocation_pass(struct allocation_state *state, const struct allocation_view *view)
{
    bool cleared = false;

    for (;;) {
        state->held = closest(view, state->taboo);
        if (state->held == 0) {
            if (cleared)
                return;
            memset(state->taboo, 0, sizeof state->taboo); /* step 6 */
            cleared = true;
        } else if (lost(view, state->held)) {
            mark(state->taboo, state->held);
        } else {
            return;
        }
    }
}
