/* plain_fights.h: fights (fights.h) as the plain allocations take them. */
#ifndef PLAIN_FIGHTS_H
#define PLAIN_FIGHTS_H

#include "fights.h"
#include "float_allocation.h"
#include "q16_allocation.h"

/* Fills all three; there must be room for the fight's vertices and neighbours. */
void float_fight(const struct fight *fight, struct float_contest *contest,
                 struct float_vertex *vertex, struct float_neighbour *neighbour);
void q16_fight(const struct fight *fight, struct q16_contest *contest, struct q16_vertex *vertex,
               struct q16_neighbour *neighbour);

#endif
