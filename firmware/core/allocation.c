#include "allocation.h"

#include "rom.h"

#include <string.h>

/* Read by the letter, every vertex tried costs a look at every neighbour: so many a tick, that a
 * tick may end in time. */
#define LITERAL_TRIES 2

/* Sets of vertices: 1 is the lowest bit of the first byte. */

static uint8_t bit_of(uint16_t vertex)
{
    static const uint8_t bits[] ROM = {1, 2, 4, 8, 16, 32, 64, 128};

    return rom_u8(&bits[(uint8_t)(vertex - 1) & 7]);
}

static bool has(const uint8_t *set, uint16_t vertex)
{
    return set[(vertex - 1) >> 3] & bit_of(vertex);
}

static void add(uint8_t *set, uint16_t vertex)
{
    set[(vertex - 1) >> 3] |= bit_of(vertex);
}

void allocation_begin(struct allocation_state *state)
{
    memset(state, 0, sizeof *state);
}

static void clear_taboo(struct allocation_state *state)
{
    memset(state->taboo, 0, sizeof state->taboo);
}

void allocation_under(struct allocation_state *state, uint16_t leader, uint8_t formation)
{
    if (state->leader == leader && state->formation == formation)
        return;
    clear_taboo(state);
    state->unfinished = false;
    state->cleared = false;
    if (state->formation != formation)
        state->held = 0;
    state->leader = leader;
    state->formation = formation;
}

static uint32_t street_length(struct vec32 offset)
{
    return (uint32_t)abs32(offset.x) + (uint32_t)abs32(offset.y);
}

/* `offset`, which fits, turned into the leader's frame. */
static struct vec16 turned(const struct allocation_view *view, struct vec32 offset, uint8_t scale)
{
    for (; scale > 0; scale--) {
        offset.x >>= 1;
        offset.y >>= 1;
    }
    return vec_rotate_back((struct vec16){(int16_t)offset.x, (int16_t)offset.y}, view->heading);
}

struct place allocation_place(const struct allocation_view *view)
{
    struct vec32 offset = vec_sub(view->own, view->origin);
    uint32_t length = street_length(offset);
    uint8_t scale = view->formation->scale;

    while (length >> scale > FORMATION_REACH)
        scale++;
    return (struct place){turned(view, offset, scale), scale};
}

/* A pass at work. */
struct contest {
    const struct allocation_view *view;
    struct vec16 at; /* this robot */
    uint8_t scale;
    uint8_t coarser; /* than the formation's: mostly 0 */
    uint32_t reach;  /* what fits, quarter millimetres */
};

static int16_t scaled(int16_t part, uint8_t coarser)
{
    for (; coarser > 0; coarser--)
        part >>= 1;
    return part;
}

static uint32_t square(int16_t x, int16_t y)
{
    return (uint32_t)mul16(x, x) + (uint32_t)mul16(y, y);
}

/* From a vertex to `at`, squared. */
static uint32_t square_to(const struct contest *contest, uint16_t vertex, struct vec16 at)
{
    const struct vec16 *place = &contest->view->formation->vertex[vertex - 1];

    return square(scaled(place->x, contest->coarser) - at.x,
                  scaled(place->y, contest->coarser) - at.y);
}

static bool is_closer(const struct contest *contest, const struct neighbour *n, uint16_t vertex,
                      uint32_t own_square)
{
    const struct allocation_view *view = contest->view;
    struct vec32 offset = vec_sub(neighbour_position(n, view->now), view->origin);

    /* Out of reach it is left to yield or to come nearer. */
    if (street_length(offset) > contest->reach)
        return false;
    uint32_t its = square_to(contest, vertex, turned(view, offset, contest->scale));
    return its < own_square || (its == own_square && n->id < view->id);
}

/* The closest vertex so far. */
struct choice {
    uint16_t vertex; /* 0 = none */
    uint16_t bound;  /* no closer one is farther than this along x or y */
    uint32_t square;
};

static void consider(struct choice *choice, uint16_t vertex, int16_t dx, int16_t dy)
{
    uint32_t to = square(dx, dy);

    if (to > choice->square || (to == choice->square && vertex >= choice->vertex))
        return;
    choice->vertex = vertex;
    choice->bound = (uint16_t)(dx < 0 ? -dx : dx) + (uint16_t)(dy < 0 ? -dy : dy);
    choice->square = to;
}

static bool within(int16_t difference, uint16_t bound)
{
    return (uint16_t)(difference < 0 ? -difference : difference) <= bound;
}

/* Those of the eight vertices from `v` on whose bits are not in `skip`. Nearly all of a sweep is
 * spent here: for most vertices a difference and a comparison, no product. */
static void sweep_eight(const struct contest *contest, struct choice *choice, const struct vec16 *v,
                        uint8_t skip)
{
    for (; skip != 0xFF; skip = skip >> 1 | 0x80, v++) {
        if (skip & 1)
            continue;
        int16_t dx = scaled(v->x, contest->coarser) - contest->at.x;
        if (!within(dx, choice->bound))
            continue;
        int16_t dy = scaled(v->y, contest->coarser) - contest->at.y;
        if (within(dy, choice->bound))
            consider(choice, (uint16_t)(v - contest->view->formation->vertex) + 1, dx, dy);
    }
}

/* The closest vertex that is not in `skip`. First one in eight, to have a narrow bound early: else
 * vertices numbered towards the robot would each be the closest so far. */
static struct choice closest(const struct contest *contest, const uint8_t *skip)
{
    const struct vec16 *vertex = contest->view->formation->vertex;
    uint8_t bytes = (uint8_t)((contest->view->formation->total + 7) >> 3);
    struct choice choice = {.bound = UINT16_MAX, .square = UINT32_MAX};

    for (uint8_t i = 0; i < bytes; i++)
        sweep_eight(contest, &choice, &vertex[8 * i], skip[i] | 0xFE);
    for (uint8_t i = 0; i < bytes; i++)
        sweep_eight(contest, &choice, &vertex[8 * i], skip[i] | 0x01);
    return choice;
}

/* The vertex that a neighbour claims and this robot might: 0 = none. */
static uint16_t claim_of(const struct contest *contest, const struct neighbour *n)
{
    const struct allocation_view *view = contest->view;

    if (n->formation != view->formation->number || n->vertex > view->formation->total ||
        n->role == ROLE_LEADER || n->id == view->leader)
        return 0;
    return n->vertex;
}

/* The vertices that are out of the question: on the taboo list, the leader's, beyond the last. */
static void exclude(uint8_t *set, const struct formation *formation, const uint8_t *taboo)
{
    memcpy(set, taboo, TABOO_BYTES);
    if (formation->leader != 0)
        add(set, formation->leader);
    if (formation->total % 8 != 0)
        set[formation->total >> 3] |= (uint8_t)(0xFF << formation->total % 8);
}

/* Comes before the chosen one: Algorithm 1 would try this vertex first. */
static bool is_before(const struct choice *choice, uint16_t vertex, uint32_t to)
{
    return to < choice->square || (to == choice->square && vertex < choice->vertex);
}

/* Sorts the claims on vertices before `choice`: those lost to their claimants go into `lost`, the
 * closest of the others becomes the choice. True when there is such a one. */
static bool judge_claims(const struct contest *contest, const uint8_t *excluded, uint8_t *lost,
                         struct choice *choice)
{
    const struct neighbours *neighbours = contest->view->neighbours;
    bool won = false;

    for (uint8_t i = 0; i < neighbours->count; i++) {
        const struct neighbour *n = &neighbours->entry[i];
        uint16_t vertex = claim_of(contest, n);

        if (vertex == 0 || has(excluded, vertex) || has(lost, vertex))
            continue;
        uint32_t own = square_to(contest, vertex, contest->at);
        if (!is_before(choice, vertex, own))
            continue;
        if (is_closer(contest, n, vertex, own))
            add(lost, vertex);
        else
            won = true;
    }
    for (uint8_t i = 0; won && i < neighbours->count; i++) {
        uint16_t vertex = claim_of(contest, &neighbours->entry[i]);

        if (vertex != 0 && !has(excluded, vertex) && !has(lost, vertex)) {
            uint32_t own = square_to(contest, vertex, contest->at);
            if (is_before(choice, vertex, own))
                *choice = (struct choice){.vertex = vertex, .square = own};
        }
    }
    return won;
}

/* Puts the lost vertices before `choice` on the taboo list. */
static void mark(const struct contest *contest, uint8_t *taboo, const uint8_t *lost,
                 const struct choice *choice)
{
    const struct neighbours *neighbours = contest->view->neighbours;

    for (uint8_t i = 0; i < neighbours->count; i++) {
        uint16_t vertex = claim_of(contest, &neighbours->entry[i]);

        if (vertex != 0 && has(lost, vertex) &&
            is_before(choice, vertex, square_to(contest, vertex, contest->at)))
            add(taboo, vertex);
    }
}

static void add_claims(const struct contest *contest, uint8_t *set)
{
    const struct neighbours *neighbours = contest->view->neighbours;

    for (uint8_t i = 0; i < neighbours->count; i++) {
        uint16_t vertex = claim_of(contest, &neighbours->entry[i]);

        if (vertex != 0)
            add(set, vertex);
    }
}

static uint16_t compete(const struct contest *contest, uint8_t *taboo)
{
    uint8_t excluded[TABOO_BYTES], claimed[TABOO_BYTES];

    exclude(excluded, contest->view->formation, taboo);
    memcpy(claimed, excluded, sizeof claimed);
    add_claims(contest, claimed);
    struct choice choice = closest(contest, claimed);

    uint8_t *lost = claimed;
    memset(lost, 0, sizeof claimed);
    if (judge_claims(contest, excluded, lost, &choice))
        mark(contest, taboo, lost, &choice);
    else
        for (uint8_t i = 0; i < TABOO_BYTES; i++)
            taboo[i] |= lost[i];
    return choice.vertex;
}

static bool is_beaten(const struct contest *contest, const struct choice *choice)
{
    const struct neighbour *n = contest->view->neighbours->entry;

    for (uint8_t i = contest->view->neighbours->count; i > 0; i--, n++)
        if (n->id != contest->view->leader && n->role != ROLE_LEADER &&
            is_closer(contest, n, choice->vertex, choice->square))
            return true;
    return false;
}

/* Sets *unfinished where it has tried as often as it may. */
static uint16_t compete_literally(const struct contest *contest, uint8_t *taboo, bool *unfinished)
{
    for (uint8_t tries = LITERAL_TRIES; tries > 0; tries--) {
        uint8_t excluded[TABOO_BYTES];

        exclude(excluded, contest->view->formation, taboo);
        struct choice choice = closest(contest, excluded);
        if (choice.vertex == 0 || !is_beaten(contest, &choice))
            return choice.vertex;
        add(taboo, choice.vertex);
    }
    *unfinished = true;
    return 0;
}

void allocation_pass(struct allocation_state *state, const struct allocation_view *view)
{
    struct place own = allocation_place(view);
    struct contest contest = {
        .view = view,
        .at = own.at,
        .scale = own.scale,
        .coarser = own.scale - view->formation->scale,
        .reach = (uint32_t)FORMATION_REACH << own.scale,
    };

    state->unfinished = false;
    uint16_t vertex = view->literal ? compete_literally(&contest, state->taboo, &state->unfinished)
                                    : compete(&contest, state->taboo);
    if (state->unfinished)
        return;
    if (vertex == 0 && !state->cleared) {
        clear_taboo(state); /* step 6 */
        state->cleared = state->unfinished = true;
        return;
    }
    state->held = vertex;
    state->cleared = false;
}
