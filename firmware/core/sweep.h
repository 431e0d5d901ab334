/* sweep.h: the closest of many vertices. */
#ifndef SWEEP_H
#define SWEEP_H

#include "fixed.h"

struct sweep {
    const struct vec16 *vertex; /* [0] is vertex 1 */
    const uint8_t *skip;        /* a bit a vertex, the lowest of the first byte being vertex 1's:
                                   those that are set are left out */
    struct vec16 at;            /* differences to any vertex are narrow */
    uint8_t bytes;              /* of `skip`, 1..128 */
    uint8_t by;                 /* vertices are times by / 256, rounded down, unless it is 0 */
    /* What is found: the one of the smallest number where two are as close; 0 = all are left
     * out. */
    uint16_t closest;
    uint32_t square; /* of its distance */
};

void sweep_vertices(struct sweep *sweep);

#endif
