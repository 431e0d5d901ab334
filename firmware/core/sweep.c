/* sweep.c: The ATmega128 has it in its own instructions, firmware/atmega128/sweep.S. */
#include "sweep.h"

void sweep_vertices(struct sweep *sweep)
{
    const struct vec16 *v = sweep->vertex;
    uint16_t vertex = 1;

    sweep->closest = 0;
    sweep->square = UINT32_MAX;
    for (uint8_t i = 0; i < sweep->bytes; i++) {
        uint8_t skip = sweep->skip[i];

        for (uint8_t bit = 0; bit < 8; bit++, skip >>= 1, vertex++, v++) {
            if (skip & 1)
                continue;
            uint32_t square = vec_square_between(vec_scale(*v, sweep->by), sweep->at);
            if (square < sweep->square) {
                sweep->square = square;
                sweep->closest = vertex;
            }
        }
    }
}
