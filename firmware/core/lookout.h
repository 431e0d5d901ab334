/* lookout.h: positions as they are seen from a leader, in a scale in which they are narrow. */
#ifndef LOOKOUT_H
#define LOOKOUT_H

#include "fixed.h"

/* From where a pass of allocation looks at the others. */
struct lookout {
    struct vec32 origin;   /* the leader's position */
    struct sincos heading; /* and its direction */
    uint16_t now;          /* mission time, ms modulo 65,536 */
    uint32_t reach;        /* the street length, |x| + |y|, whose parts fit the scale turned */
    /* To divide by 2^scale: away with a byte, or not; then times by / 256, unless that is 0. */
    bool byte;
    uint8_t by;
};

/* |x| + |y|, at most 2 less. */
static inline uint32_t street_length(struct vec32 offset)
{
    return (uint32_t)(offset.x < 0 ? ~offset.x : offset.x) +
           (uint32_t)(offset.y < 0 ? ~offset.y : offset.y);
}

/* `offset` from the leader, within reach, as it is seen from there. */
struct vec16 lookout_see(const struct lookout *lookout, struct vec32 offset);

#endif
