/* allocation.h: Competitive Position Allocation (Algorithm 1 of the paper).
 *
 * A follower takes the closest vertex and yields to a rival: a neighbour that holds the same
 * vertex and is closer to it, ties to the smaller id. The vertex it yielded goes on its taboo
 * list, and the next closest is tried. The list lives on from pass to pass; it is cleared when
 * every vertex is on it, by a new leader and by a new formation.
 *
 * A sweep over the vertices costs little; where a rival stands costs much and is worked out only
 * for the neighbours that hold the vertex in question. */
#ifndef ALLOCATION_H
#define ALLOCATION_H

#include "formation.h"
#include "neighbours.h"

#define TABOO_BYTES ((VERTICES_MAX + 7) / 8)

/* Vertices a pass may try before it leaves the rest to the next tick: a robot that meets a whole
 * arm of a formation at once loses a vertex to each of its holders, and a control tick must end
 * in time. */
#define ALLOCATION_TRIES 4

struct allocation_state {
    uint16_t held;     /* vertex 1..n, 0 = none */
    uint16_t tried;    /* where an unfinished pass goes on; 0 = it is finished */
    bool cleared;      /* in the unfinished pass */
    uint8_t formation; /* number of the formation it belongs to */
    uint16_t leader;   /* id the taboo list was made under */
    uint8_t taboo[TABOO_BYTES];
};

/* What a pass looks at. */
struct allocation_view {
    const struct formation *formation;
    uint16_t id;     /* this robot's */
    uint16_t leader; /* the robot the vertices are placed about: never a rival */
    bool literal;    /* any closer neighbour is a rival, whatever it holds: Algorithm 1 read by
                        the letter, kept to show the difference */
    /* This robot's position in the leader's frame, parts within FORMATION_REACH, in units of
     * 2^scale quarter millimetres; the scale is at least the formation's. */
    struct vec16 at;
    uint8_t scale;
    const struct neighbours *neighbours;
    /* Below, at or above 0: the neighbour is nearer to the vertex than this robot, as near,
     * farther. */
    int8_t (*compare)(const void *context, const struct neighbour *neighbour, uint16_t vertex);
    const void *context;
};

/* Forgets the held vertex and the taboo list. */
void allocation_begin(struct allocation_state *state);

/* Clears the taboo list when leader or formation are others than before. */
void allocation_under(struct allocation_state *state, uint16_t leader, uint8_t formation);

/* One pass, or its next part. When it is finished (state->tried is 0) state->held is the result, 0
 * when every vertex is lost to a rival; until then it is what it was. */
void allocation_pass(struct allocation_state *state, const struct allocation_view *view);

#endif
