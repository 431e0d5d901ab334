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

/* A part of a vertex at the pass's scale, which is mostly the formation's plus one. */
static inline int16_t scaled(int16_t part, uint8_t more)
{
    part >>= 1;
    while (more-- > 0)
        part >>= 1;
    return part;
}

static struct vec16 place_of(const struct allocation_view *view, uint16_t number)
{
    const struct vec16 *vertex = &view->formation->vertex[number - 1];
    uint8_t more = view->scale - view->formation->scale - 1;

    return (struct vec16){scaled(vertex->x, more), scaled(vertex->y, more)};
}

static uint32_t square_distance(struct vec16 a, struct vec16 b)
{
    int16_t dx = (int16_t)(a.x - b.x);
    int16_t dy = (int16_t)(a.y - b.y);

    return (uint32_t)mul16(dx, dx) + (uint32_t)mul16(dy, dy);
}

static uint16_t apart(int16_t a, int16_t b)
{
    return a > b ? (uint16_t)(a - b) : (uint16_t)(b - a);
}

/* The closest vertex that is neither on the taboo list nor the leader's; 0 = none. Most vertices
 * are out of the question by one coordinate: no multiplication for them. */
static uint16_t closest(const struct allocation_view *view, const uint8_t *taboo)
{
    const struct vec16 *vertex = view->formation->vertex;
    uint8_t more = view->scale - view->formation->scale - 1;
    uint32_t least = UINT32_MAX;
    uint16_t bound = UINT16_MAX; /* no closer vertex is farther along x or y */
    uint16_t winner = 0;
    uint8_t marks = 0;

    for (uint16_t i = 0; i < view->formation->total; i++, marks >>= 1) {
        if ((i & 7) == 0)
            marks = taboo[i >> 3];
        if ((marks & 1) || i + 1 == view->formation->leader)
            continue;
        uint16_t dx = apart(scaled(vertex[i].x, more), view->at.x);
        if (dx > bound)
            continue;
        uint16_t dy = apart(scaled(vertex[i].y, more), view->at.y);
        if (dy > bound)
            continue;
        uint32_t square = (uint32_t)dx * dx + (uint32_t)dy * dy;
        if (square < least) {
            least = square;
            bound = dx + dy;
            winner = i + 1;
        }
    }
    return winner;
}

static bool rivals(const struct allocation_view *view, const struct neighbour *n, uint16_t vertex)
{
    if (n->id == view->leader || n->role == ROLE_LEADER)
        return false;
    return view->literal || (n->vertex == vertex && n->formation == view->formation->number);
}

static bool lost(const struct allocation_view *view, uint16_t vertex)
{
    struct vec16 place = place_of(view, vertex);
    uint32_t mine = square_distance(place, view->at);

    for (uint8_t i = 0; i < view->neighbours->count; i++) {
        const struct neighbour *n = &view->neighbours->entry[i];

        if (!rivals(view, n, vertex))
            continue;
        uint32_t theirs = square_distance(place, view->locate(view->context, n));
        if (theirs < mine || (theirs == mine && n->id < view->id))
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
