/* q16_allocation.h: Algorithm 1 of the paper as it reads, in Q16.16 and SI units. */
#ifndef Q16_ALLOCATION_H
#define Q16_ALLOCATION_H

#include "q16.h"

#include <stdbool.h>
#include <stdint.h>

struct q16_vertex {
    q16 x, y; /* in the leader's frame */
};

struct q16_neighbour {
    q16 x, y, theta, v, omega; /* at the time of its beacon */
    uint16_t age;              /* of that, ms */
    uint16_t id, vertex;
};

struct q16_contest {
    q16 x, y, theta; /* the leader's pose */
    q16 own_x, own_y;
    uint16_t own_id;
    uint16_t leader_vertex; /* nobody's goal */
    uint16_t vertices, neighbours;
    const struct q16_vertex *vertex; /* [0] is vertex 1 */
    const struct q16_neighbour *neighbour;
};

/* Returns the vertex to hold, 0 for none. `taboo` has room for the vertices and begins empty. */
uint16_t q16_allocate(const struct q16_contest *contest, bool *taboo);

#endif
