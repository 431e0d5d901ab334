/* float_allocation.h: Algorithm 1 of the paper as it reads, in floating point and SI units. */
#ifndef FLOAT_ALLOCATION_H
#define FLOAT_ALLOCATION_H

#include <stdbool.h>
#include <stdint.h>

struct float_vertex {
    float x, y; /* in the leader's frame */
};

struct float_neighbour {
    float x, y, theta, v, omega; /* at the time of its beacon */
    uint16_t age;                /* of that, ms */
    uint16_t id, vertex;
};

struct float_contest {
    float x, y, theta; /* the leader's pose */
    float own_x, own_y;
    uint16_t own_id;
    uint16_t leader_vertex; /* nobody's goal */
    uint16_t vertices, neighbours;
    const struct float_vertex *vertex; /* [0] is vertex 1 */
    const struct float_neighbour *neighbour;
};

/* Returns the vertex to hold, 0 for none. `taboo` has room for the vertices and begins empty. */
uint16_t float_allocate(const struct float_contest *contest, bool *taboo);

#endif
