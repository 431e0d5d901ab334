#include "allocation.h"

#include <string.h>

static uint8_t bit_of(uint16_t vertex)
{
    return (uint8_t)(1u << ((vertex - 1) & 7));
}

static bool marked(const uint8_t *set, uint16_t vertex)
{
    return set[(vertex - 1) >> 3] & bit_of(vertex);
}

static void mark(uint8_t *set, uint16_t vertex)
{
    set[(vertex - 1) >> 3] |= bit_of(vertex);
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
    state->tried = 0;
    state->cleared = false;
    if (state->formation != formation)
        state->held = 0;
    state->leader = leader;
    state->formation = formation;
}

static bool within(int16_t a, int16_t b, uint16_t bound)
{
    return (a > b ? (uint16_t)(a - b) : (uint16_t)(b - a)) <= bound;
}

/* A part of a vertex, from the formation's scale to the pass's; mostly they are the same. */
static inline int16_t scaled(int16_t part, uint8_t coarser)
{
    for (; coarser > 0; coarser--)
        part >>= 1;
    return part;
}

static struct vec16 place_of(const struct vec16 *vertex, uint8_t coarser)
{
    return (struct vec16){scaled(vertex->x, coarser), scaled(vertex->y, coarser)};
}

/* The closest vertex so far. */
struct choice {
    uint16_t vertex; /* 0 = none */
    uint16_t bound;  /* no closer one is farther than this along x or y */
    uint32_t square;
};

static void consider(struct choice *choice, uint16_t vertex, struct vec16 place, struct vec16 at)
{
    int16_t dx = place.x - at.x;
    int16_t dy = place.y - at.y;
    uint32_t square = (uint32_t)mul16(dx, dx) + (uint32_t)mul16(dy, dy);

    if (square > choice->square || (square == choice->square && vertex > choice->vertex))
        return;
    choice->vertex = vertex;
    choice->bound = (uint16_t)(dx < 0 ? -dx : dx) + (uint16_t)(dy < 0 ? -dy : dy);
    choice->square = square;
}

/* The first of the vertices `from` up to `end` that lies within `bound` along both axes, or
 * `end`. Nearly all of a sweep is spent here: two comparisons a vertex, no product. */
static const struct vec16 *find_near(const struct vec16 *from, const struct vec16 *end,
                                     struct vec16 at, uint16_t bound, uint8_t coarser)
{
    for (; from != end; from++)
        if (within(scaled(from->x, coarser), at.x, bound) &&
            within(scaled(from->y, coarser), at.y, bound))
            break;
    return from;
}

static void sweep(struct choice *choice, const struct allocation_view *view, const uint8_t *taboo,
                  uint16_t from, uint16_t end)
{
    const struct vec16 *vertices = view->formation->vertex;
    uint8_t coarser = view->scale - view->formation->scale;

    for (const struct vec16 *v = &vertices[from];; v++) {
        v = find_near(v, &vertices[end], view->at, choice->bound, coarser);
        if (v == &vertices[end])
            return;
        uint16_t vertex = (uint16_t)(v - vertices) + 1;
        if (!marked(taboo, vertex) && vertex != view->formation->leader)
            consider(choice, vertex, place_of(v, coarser), view->at);
    }
}

/* The closest vertex that is neither on the taboo list nor the leader's; 0 = none. The sweep
 * begins near `guess`, to have a narrow bound early. */
static uint16_t closest(const struct allocation_view *view, const uint8_t *taboo, uint16_t guess)
{
    struct choice choice = {.bound = UINT16_MAX, .square = UINT32_MAX};
    uint16_t total = view->formation->total;
    uint16_t start = guess > 0 && guess <= total ? guess - 1 : 0;

    sweep(&choice, view, taboo, start, total);
    sweep(&choice, view, taboo, 0, start);
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

static void finish(struct allocation_state *state, uint16_t vertex)
{
    state->held = vertex;
    state->tried = 0;
    state->cleared = false;
}

void allocation_pass(struct allocation_state *state, const struct allocation_view *view)
{
    uint8_t tries = ALLOCATION_TRIES;

    while (tries > 0) {
        uint16_t guess = state->tried != 0 ? state->tried : state->held;
        uint16_t vertex = closest(view, state->taboo, guess);

        if (vertex == 0 && state->cleared) {
            finish(state, 0);
            return;
        }
        if (vertex == 0) {
            memset(state->taboo, 0, sizeof state->taboo); /* step 6 */
            state->cleared = true;
        } else if (lost(view, vertex)) {
            mark(state->taboo, vertex);
            state->tried = vertex;
            tries--;
        } else {
            finish(state, vertex);
            return;
        }
    }
}
