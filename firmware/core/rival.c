/* rival.c: The ATmega128 has it in its own instructions, firmware/atmega128/rival.S. */
#include "rival.h"

uint32_t rival_square(const struct lookout *lookout, const struct neighbour *neighbour,
                      struct vec16 place)
{
    struct vec32 offset;

    neighbour_position(neighbour, lookout->now, &offset);
    offset = vec_sub(offset, lookout->origin);
    if (street_length(offset) > lookout->reach)
        return UINT32_MAX;
    struct vec16 seen = lookout_see(lookout, offset);
    return square16(minus16(seen.x, place.x)) + square16(minus16(seen.y, place.y));
}
