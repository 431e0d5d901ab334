#include "allocation.h"

#include <string.h>

static bool marked(const uint8_t *set, uint16_t vertex)
{
    return set[(vertex - 1) >> 3] & (uint8_t)(1u << ((vertex - 1) & 7));
}

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

/* What stays the same throughout a pass. */
struct pass {
    const struct formation *formation;
    uint8_t shift; /* from the formation's scale to the pass's */
    const struct contender *own;
    uint8_t lost[TABOO_BYTES];
};

static uint32_t square_distance(const struct pass *pass, struct vec16 at, uint16_t vertex)
{
    const struct vec16 *v = &pass->formation->vertex[vertex - 1];
    int16_t dx = (int16_t)((v->x >> pass->shift) - at.x);
    int16_t dy = (int16_t)((v->y >> pass->shift) - at.y);

    return (uint32_t)mul16(dx, dx) + (uint32_t)mul16(dy, dy);
}

static bool loses(const struct pass *pass, uint16_t vertex, const struct contender *rival)
{
    uint32_t mine = square_distance(pass, pass->own->at, vertex);
    uint32_t theirs = square_distance(pass, rival->at, vertex);

    return theirs < mine || (theirs == mine && rival->id < pass->own->id);
}

static void find_lost(struct pass *pass, const struct contender *rival, bool literal)
{
    uint16_t first = literal ? 1 : rival->vertex;
    uint16_t last = literal ? pass->formation->total : rival->vertex;

    if (first == 0 || last > pass->formation->total)
        return;
    for (uint16_t vertex = first; vertex <= last; vertex++)
        if (loses(pass, vertex, rival))
            mark(pass->lost, vertex);
}

/* The closest vertex that is neither lost nor on the taboo list nor the leader's; 0 = none. */
static uint16_t closest(const struct pass *pass, const uint8_t *taboo, uint32_t *distance)
{
    uint16_t winner = 0;

    *distance = UINT32_MAX;
    for (uint16_t vertex = 1; vertex <= pass->formation->total; vertex++) {
        if (vertex == pass->formation->leader || marked(pass->lost, vertex) ||
            marked(taboo, vertex))
            continue;
        uint32_t square = square_distance(pass, pass->own->at, vertex);
        if (square < *distance) {
            *distance = square;
            winner = vertex;
        }
    }
    return winner;
}

static void mark_nearer(struct allocation_state *state, const struct pass *pass, uint32_t distance)
{
    for (uint16_t vertex = 1; vertex <= pass->formation->total; vertex++)
        if (marked(pass->lost, vertex) &&
            square_distance(pass, pass->own->at, vertex) <= distance)
            mark(state->taboo, vertex);
}

void allocation_pass(struct allocation_state *state, const struct formation *formation,
                     uint8_t scale, const struct contender *own, const struct contender *rivals,
                     uint8_t rival_count, bool literal)
{
    struct pass pass = {.formation = formation, .shift = scale - formation->scale, .own = own};
    uint32_t distance;

    for (uint8_t i = 0; i < rival_count; i++)
        find_lost(&pass, &rivals[i], literal);

    uint16_t winner = closest(&pass, state->taboo, &distance);
    if (winner == 0) {
        memset(state->taboo, 0, sizeof state->taboo); /* step 6 */
        winner = closest(&pass, state->taboo, &distance);
    }
    if (winner != 0)
        mark_nearer(state, &pass, distance);
    state->held = winner;
}
