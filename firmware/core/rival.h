/* rival.h: how far neighbours are from a place in the leader's frame. */
#ifndef RIVAL_H
#define RIVAL_H

#include "lookout.h"
#include "neighbours.h"

/* The distance between `place` and where the neighbour is by now, squared, in units of the scale,
 * each part limited to 16 bits; UINT32_MAX when it is out of reach. */
uint32_t rival_square(const struct lookout *lookout, const struct neighbour *neighbour,
                      struct vec16 place);

#endif
