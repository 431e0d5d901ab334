/* allocation.h: Competitive Position Allocation (Algorithm 1 of the paper).
 *
 * A follower takes the closest vertex and yields to a rival: a neighbour that holds the same
 * vertex and is closer to it, ties to the smaller id. The vertex it yielded goes on its taboo
 * list, and the next closest is tried. The list lives on from pass to pass; it is cleared when
 * every vertex is on it or lost, by a new leader and by a new formation.
 *
 * One sweep does what the paper's mark-and-repeat does: the vertices lost to a rival are found
 * first, the closest of the others wins, and the lost ones nearer than it are marked after. */
#ifndef ALLOCATION_H
#define ALLOCATION_H

#include "formation.h"

#define TABOO_BYTES ((VERTICES_MAX + 7) / 8)

struct allocation_state {
    uint16_t held;     /* vertex 1..n, 0 = none */
    uint8_t formation; /* number of the formation it belongs to */
    uint16_t leader;   /* id the taboo list was made under */
    uint8_t taboo[TABOO_BYTES];
};

/* A robot as allocation sees it: in the leader's frame, at the pass's scale. */
struct contender {
    uint16_t id;
    uint16_t vertex; /* it holds, 0 = none */
    struct vec16 at; /* parts within +-ALLOCATION_REACH */
};

/* Parts of positions within half of int16, so that differences fit it. */
#define ALLOCATION_REACH 16383

/* Forgets the held vertex and the taboo list. */
void allocation_begin(struct allocation_state *state);

/* Clears the taboo list when leader or formation are others than before. */
void allocation_under(struct allocation_state *state, uint16_t leader, uint8_t formation);

/* One pass. `scale` (at least formation->scale + 1) is the pass's: a unit is 2^scale quarter
 * millimetres. With `literal`, any closer neighbour is a rival, whatever it holds: Algorithm 1
 * read by the letter, kept to show the difference. state->held is the result, 0 when every
 * vertex is lost to a rival. */
void allocation_pass(struct allocation_state *state, const struct formation *formation,
                     uint8_t scale, const struct contender *own, const struct contender *rivals,
                     uint8_t rival_count, bool literal);

#endif
