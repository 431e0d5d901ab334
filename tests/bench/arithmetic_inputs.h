/* arithmetic_inputs.h: what the arithmetic of fixed.h is measured with, the same on both sides. */
#ifndef ARITHMETIC_INPUTS_H
#define ARITHMETIC_INPUTS_H

#include "fixed.h"
#include "random.h"

#define ARITHMETIC_INPUTS 12000
#define ARITHMETIC_SEED 2

static inline int16_t arithmetic_part(uint16_t drawn)
{
    return drawn == 0x8000 ? 0 : (int16_t)drawn; /* -32,768 is out of range */
}

/* Vectors of all lengths, on the axes and on the diagonals too. `state` is random.h's and starts
 * at ARITHMETIC_SEED; `index` counts from 0. */
static inline struct vec16 arithmetic_vector(uint16_t index, uint32_t *state)
{
    uint32_t drawn = random_next(state);
    struct vec16 v = {arithmetic_part((uint16_t)drawn), arithmetic_part((uint16_t)(drawn >> 16))};

    v.x >>= index % 15;
    v.y >>= index % 15;
    if (index % 16 == 14)
        v.y = 0;
    if (index % 16 == 15)
        v.x = (int16_t)-v.y;
    return v;
}

#endif
