#include "formation.h"

uint8_t formation_scale(int32_t distance)
{
    uint8_t scale = 0;

    while (scale < FORMATION_SCALE_MAX && distance >> scale >= FORMATION_REACH)
        scale++;
    return scale;
}

/* wide (24 bits) * Q1.15: the high part and the low byte apart, so that 32 bits are enough. */
static int32_t wide_mul_q15(int32_t wide, int16_t q15)
{
    int16_t high = (int16_t)(wide >> 8);
    int16_t low = (int16_t)(wide & 0xFF);

    return (mul16(high, q15) + (mul16(low, q15) >> 8) + 0x40) >> 7;
}

struct vec16 formation_place(struct polar_vertex vertex, uint8_t scale)
{
    struct sincos psi = sincos_of(vertex.psi);
    int32_t half = scale == 0 ? 0 : (int32_t)1 << (scale - 1);

    return (struct vec16){
        saturate16((wide_mul_q15(vertex.distance, psi.cos) + half) >> scale),
        saturate16((wide_mul_q15(vertex.distance, psi.sin) + half) >> scale),
    };
}

struct vec32 formation_offset(struct vec16 goal, uint8_t scale, struct sincos heading)
{
    struct vec16 turned = vec_rotate(goal, heading);
    int32_t unit = (int32_t)1 << scale;

    return (struct vec32){turned.x * unit, turned.y * unit};
}
