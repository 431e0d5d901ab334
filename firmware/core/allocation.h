/* allocation.h: Competitive Position Allocation (Algorithm 1 of the paper).
 *
 * A follower takes the closest vertex and yields to a rival: a neighbour that holds the same
 * vertex and is closer to it, ties to the smaller id. The vertex it yielded goes on its taboo
 * list, and the next closest is tried. The list lives on from pass to pass; it is cleared when
 * every vertex is on it, by a new leader and by a new formation.
 *
 * Try and mark, repeated, comes to this: of the vertices not on the list, find the closest that
 * nobody claims; only for the claimed ones that are closer still, work out where their claimants
 * stand. One sweep over n vertices and one over m neighbours, O(n + m). */
#ifndef ALLOCATION_H
#define ALLOCATION_H

#include "formation.h"
#include "neighbours.h"

#define TABOO_BYTES ((VERTICES_MAX + 7) / 8)

struct allocation_state {
    uint16_t held;     /* vertex 1..n, 0 = none */
    bool unfinished;   /* the pass goes on in the next tick */
    bool cleared;      /* the list was, in the unfinished pass */
    uint8_t formation; /* number of the formation it belongs to */
    uint16_t leader;   /* id the taboo list was made under */
    uint8_t taboo[TABOO_BYTES];
};

/* What a pass looks at. */
struct allocation_view {
    const struct formation *formation;
    const struct neighbours *neighbours;
    uint16_t id;         /* this robot's */
    uint16_t leader;     /* the robot the vertices are placed about: never a rival */
    bool literal;        /* any closer neighbour is a rival, whatever it holds: Algorithm 1 read by
                            the letter, kept to show the difference */
    struct vec32 origin; /* the leader's position now, and the direction of its heading */
    struct sincos heading;
    struct vec32 own; /* this robot's position now */
    uint16_t now;     /* mission time, ms modulo 65,536 */
};

/* A position in the leader's frame, in units of 2^scale quarter millimetres: parts are within
 * FORMATION_REACH, as those of vertices are, so that differences are narrow. */
struct place {
    struct vec16 at;
    uint8_t scale;
};

/* This robot's, at the finest scale in which it and the formation fit. */
struct place allocation_place(const struct allocation_view *view);

/* Forgets the held vertex and the taboo list. */
void allocation_begin(struct allocation_state *state);

/* Clears the taboo list when leader or formation are others than before. */
void allocation_under(struct allocation_state *state, uint16_t leader, uint8_t formation);

/* One pass. Where it ends, state->held is the result, 0 when every vertex is lost to a rival; until
 * then it is what it was. */
void allocation_pass(struct allocation_state *state, const struct allocation_view *view);

#endif
