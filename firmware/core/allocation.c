#include "allocation.h"

#include "rival.h"
#include "rom.h"
#include "sweep.h"

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

/* A pass at work. */
struct contest {
    const struct allocation_view *view;
    struct lookout lookout;
    struct vec16 at; /* this robot, in the leader's frame */
    uint8_t scale;
    uint8_t by; /* from the formation's scale to this one, which mostly is the same: times by / 256,
                   unless it is 0. A robot for which 1 is not little enough is 500 times the
                   formation away */
};

static bool fits(int16_t part)
{
    return part <= FORMATION_REACH && part >= -FORMATION_REACH;
}

static void look_from(struct lookout *lookout, const struct allocation_view *view, uint8_t scale)
{
    lookout->origin = view->origin;
    lookout->heading = view->heading;
    lookout->now = view->now;
    lookout->reach = (uint32_t)INT16_MAX << scale;
    lookout->byte = scale >= 8;
    lookout->by = scale % 8 == 0 ? 0 : (uint8_t)(256u >> scale % 8);
}

/* At the finest scale in which this robot and the formation fit. */
static void enter(struct contest *contest, const struct allocation_view *view)
{
    struct vec32 offset = vec_sub(view->own, view->origin);
    uint32_t length = street_length(offset);
    uint8_t scale = view->formation->scale;

    while (length >> scale > INT16_MAX)
        scale++;
    for (;; scale++) {
        look_from(&contest->lookout, view, scale);
        contest->at = lookout_see(&contest->lookout, offset);
        if (fits(contest->at.x) && fits(contest->at.y))
            break;
    }
    contest->view = view;
    contest->scale = scale;
    uint8_t coarser = scale - view->formation->scale;
    contest->by = coarser == 0 ? 0 : coarser > 8 ? 1 : (uint8_t)(256u >> coarser);
}

struct place allocation_place(const struct allocation_view *view)
{
    struct contest contest;

    enter(&contest, view);
    return (struct place){contest.at, contest.scale};
}

static struct vec16 vertex_of(const struct contest *contest, uint16_t vertex)
{
    return vec_scale(contest->view->formation->vertex[vertex - 1], contest->by);
}

/* The distance to a place, squared. */
static uint32_t square_to(const struct contest *contest, struct vec16 place)
{
    return vec_square_between(contest->at, place);
}

/* Out of reach a neighbour is left to yield or to come nearer. */
static bool is_closer(const struct contest *contest, const struct neighbour *n, struct vec16 place,
                      uint32_t own_square)
{
    uint32_t its = rival_square(&contest->lookout, n, place);

    return its < own_square || (its == own_square && n->id < contest->view->id);
}

/* The closest vertex so far. */
struct choice {
    uint16_t vertex; /* 0 = none */
    uint32_t square;
};

/* Comes before the chosen one: Algorithm 1 would try this vertex first. */
static bool is_before(const struct choice *choice, uint16_t vertex, uint32_t square)
{
    return square < choice->square || (square == choice->square && vertex < choice->vertex);
}

/* The closest vertex that is not in `skip`. */
static struct choice closest(const struct contest *contest, const uint8_t *skip)
{
    const struct formation *formation = contest->view->formation;
    struct sweep sweep = {
        .vertex = formation->vertex,
        .skip = skip,
        .at = contest->at,
        .bytes = (uint8_t)((formation->total + 7) >> 3),
        .by = contest->by,
    };

    sweep_vertices(&sweep);
    return (struct choice){sweep.closest, sweep.square};
}

/* The vertices that are out of the question: on the taboo list, the leader's, beyond the last. */
static void exclude(uint8_t *set, const struct formation *formation, const uint8_t *taboo)
{
    uint8_t used = (uint8_t)((formation->total + 7) >> 3);

    memcpy(set, taboo, used);
    memset(set + used, 0xFF, TABOO_BYTES - used);
    if (formation->leader != 0)
        add(set, formation->leader);
    if (formation->total % 8 != 0)
        set[formation->total >> 3] |= (uint8_t)(0xFF << formation->total % 8);
}

/* Every byte of a set has this value. */
static bool is_all(const uint8_t *set, uint8_t value)
{
    uint8_t i = 0;

    while (i < TABOO_BYTES && set[i] == value)
        i++;
    return i == TABOO_BYTES;
}

/* Which vertex each neighbour claims that this robot might: 0 = none. */
struct claims {
    uint16_t of[NEIGHBOURS_MAX];
};

/* Adds the claimed ones to `claimed`, which holds what is excluded already. */
static void find_claims(const struct contest *contest, struct claims *claims,
                        const uint8_t *excluded, uint8_t *claimed)
{
    const struct allocation_view *view = contest->view;
    const struct neighbour *n = view->neighbours->entry;
    const struct formation *formation = view->formation;

    for (uint8_t i = 0; i < view->neighbours->count; i++, n++) {
        uint16_t vertex = n->vertex;

        claims->of[i] = 0;
        if (n->formation != formation->number || vertex == 0 || vertex > formation->total ||
            n->role == ROLE_LEADER || n->id == view->leader || has(excluded, vertex))
            continue;
        claims->of[i] = vertex;
        add(claimed, vertex);
    }
}

/* Sorts the claims on vertices before `choice`: those lost to their claimants go into `lost`, the
 * closest of the others becomes the choice. True when the choice is another one then. */
static bool judge_claims(const struct contest *contest, const struct claims *claims, uint8_t *lost,
                         struct choice *choice)
{
    const struct neighbours *neighbours = contest->view->neighbours;
    uint16_t unclaimed = choice->vertex;
    bool won = false;

    for (uint8_t i = 0; i < neighbours->count; i++) {
        uint16_t vertex = claims->of[i];

        if (vertex == 0)
            continue;
        struct vec16 place = vertex_of(contest, vertex);
        uint32_t own = square_to(contest, place);
        if (!is_before(choice, vertex, own))
            continue;
        if (is_closer(contest, &neighbours->entry[i], place, own))
            add(lost, vertex);
        else
            won = true;
    }
    for (uint8_t i = 0; won && i < neighbours->count; i++) {
        uint16_t vertex = claims->of[i];

        if (vertex != 0 && !has(lost, vertex)) {
            uint32_t own = square_to(contest, vertex_of(contest, vertex));
            if (is_before(choice, vertex, own))
                *choice = (struct choice){.vertex = vertex, .square = own};
        }
    }
    return choice->vertex != unclaimed;
}

/* Puts the lost vertices before `choice` on the taboo list. */
static void mark(const struct contest *contest, const struct claims *claims, uint8_t *taboo,
                 const uint8_t *lost, const struct choice *choice)
{
    for (uint8_t i = 0; i < contest->view->neighbours->count; i++) {
        uint16_t vertex = claims->of[i];

        if (vertex != 0 && has(lost, vertex) &&
            is_before(choice, vertex, square_to(contest, vertex_of(contest, vertex))))
            add(taboo, vertex);
    }
}

static uint16_t compete(const struct contest *contest, uint8_t *taboo)
{
    uint8_t excluded[TABOO_BYTES], claimed[TABOO_BYTES];
    struct claims claims;

    exclude(excluded, contest->view->formation, taboo);
    if (is_all(excluded, 0xFF))
        return 0;
    memcpy(claimed, excluded, sizeof claimed);
    find_claims(contest, &claims, excluded, claimed);
    struct choice choice = closest(contest, claimed);

    uint8_t *lost = claimed;
    memset(lost, 0, sizeof claimed);
    if (judge_claims(contest, &claims, lost, &choice))
        mark(contest, &claims, taboo, lost, &choice);
    else
        for (uint8_t i = 0; i < TABOO_BYTES; i++)
            taboo[i] |= lost[i];
    return choice.vertex;
}

static bool is_beaten(const struct contest *contest, const struct choice *choice)
{
    const struct neighbour *n = contest->view->neighbours->entry;
    struct vec16 place = vertex_of(contest, choice->vertex);

    for (uint8_t i = contest->view->neighbours->count; i > 0; i--, n++)
        if (n->id != contest->view->leader && n->role != ROLE_LEADER &&
            is_closer(contest, n, place, choice->square))
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
    struct contest contest;

    enter(&contest, view);
    state->unfinished = false;
    bool was_clear = is_all(state->taboo, 0);
    uint16_t vertex = view->literal ? compete_literally(&contest, state->taboo, &state->unfinished)
                                    : compete(&contest, state->taboo);
    if (state->unfinished)
        return;
    if (vertex == 0 && !state->cleared && !was_clear) {
        clear_taboo(state); /* step 6 */
        state->cleared = state->unfinished = true;
        return;
    }
    state->held = vertex;
    state->cleared = false;
}
