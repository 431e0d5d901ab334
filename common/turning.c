/* turning.c: the functions of fixed.h that every control tick is made of. The ATmega128 has them in
 * its own instructions, firmware/atmega128/turning.S, to the same bit. */
#include "fixed.h"
#include "rom.h"
#include "tables.h"

/* `step` * `part` / 64, rounded. */
static uint8_t part_of_step(uint8_t step, uint8_t part)
{
    return (uint8_t)((mul8(step, part) + 32) >> 6);
}

struct sincos sincos_of(angle_t angle)
{
    uint8_t i = (uint8_t)(angle >> 6);
    uint8_t part = angle & 63;
    const uint16_t *up = &sine_table[i];
    const uint16_t *down = &sine_table[256 - i];
    uint16_t rising = rom_u16(up);
    uint16_t falling = rom_u16(down);

    if (part != 0) {
        uint16_t low = rom_u16(down - 1);

        rising += part_of_step((uint8_t)(rom_u16(up + 1) - rising), part);
        falling = low + part_of_step((uint8_t)(falling - low), 64 - part);
    }
    int16_t s = (int16_t)rising, c = (int16_t)falling;
    switch (angle >> 14) {
    case 0: return (struct sincos){s, c};
    case 1: return (struct sincos){c, (int16_t)-s};
    case 2: return (struct sincos){(int16_t)-s, (int16_t)-c};
    default: return (struct sincos){(int16_t)-c, s};
    }
}

/* table[at / 256], linearly. The entries of all three tables lie less than 256 apart. */

static uint16_t in_rising(const uint16_t *table, uint16_t at)
{
    const uint16_t *entry = &table[at >> 8];
    uint16_t low = rom_u16(entry);
    uint8_t step = (uint8_t)(rom_u16(entry + 1) - low);

    return low + ((mul8(step, (uint8_t)at) + 128) >> 8);
}

static uint16_t in_falling(const uint16_t *table, uint16_t at)
{
    const uint16_t *entry = &table[at >> 8];
    uint16_t high = rom_u16(entry);
    uint8_t step = (uint8_t)(high - rom_u16(entry + 1));

    return high - ((mul8(step, (uint8_t)at) + 127) >> 8);
}

static void swap(int16_t *a, int16_t *b)
{
    int16_t was = *a;

    *a = *b;
    *b = was;
}

/* v mirrored into the first octant, 0 <= v.y <= v.x, and w with it. */
enum { MIRRORED_X = 1, MIRRORED_Y = 2, SWAPPED = 4 };

static uint8_t mirror(struct vec16 *v, struct vec16 *w)
{
    uint8_t how = 0;

    if (v->x < 0) {
        v->x = (int16_t)-v->x;
        w->x = (int16_t)-w->x;
        how |= MIRRORED_X;
    }
    if (v->y < 0) {
        v->y = (int16_t)-v->y;
        w->y = (int16_t)-w->y;
        how |= MIRRORED_Y;
    }
    if (v->y > v->x) {
        swap(&v->x, &v->y);
        swap(&w->x, &w->y);
        how |= SWAPPED;
    }
    return how;
}

struct course course_of(struct vec16 v, struct vec16 w)
{
    struct course course = {0, 0};
    uint8_t how = mirror(&v, &w);
    uint16_t large = (uint16_t)v.x;
    uint16_t small = (uint16_t)v.y;
    bool byte = large < 1u << 8;
    uint8_t power = 1;

    if (large == 0)
        return course;
    /* large * (byte ? 2^8 : 1) * power lies in [2^15, 2^16). */
    if (byte) {
        large <<= 8;
        small <<= 8;
    }
    while (large < 1u << 15) {
        large <<= 1;
        small <<= 1;
        power <<= 1;
    }
    uint16_t inverse = in_falling(reciprocal_table, (uint16_t)(large << 1)); /* 2^30 / large */
    uint32_t quotient = mul16_unsigned(small, inverse);
    uint16_t ratio = quotient >= 1ul << 30 ? UINT16_MAX : (uint16_t)(quotient << 2 >> 16);

    uint16_t angle = (in_rising(arctangent_table, ratio) + 2) >> 2;
    if (how & SWAPPED)
        angle = ANGLE_QUARTER - angle;
    if (how & MIRRORED_X)
        angle = 2 * ANGLE_QUARTER - angle;
    if (how & MIRRORED_Y)
        angle = (angle_t)-angle;
    course.angle = angle;

    /* (1, ratio) x w over 1 + ratio^2, halved, times the inverse. */
    int16_t cross = (int16_t)(w.y / 2 - mul_q15(w.x, (int16_t)(ratio >> 1)) / 2);
    int16_t reduced = mul_q15(cross, (int16_t)in_falling(falloff_table, ratio));
    int32_t turn = mul16(reduced, (int16_t)inverse) >> 8;

    if (byte)
        for (; power > 1; power >>= 1)
            turn *= 2;
    else
        turn = mul24_high(turn, power);
    turn >>= 3; /* 30 bits of the inverse less 8, 8, 1 of the half, and 10 of the rate */
    bool odd = (how ^ how >> 1 ^ how >> 2) & 1;
    int16_t limited = saturate16(turn);

    course.turn = odd ? (int16_t)-limited : limited;
    return course;
}

int16_t vec_along(struct vec16 v, struct sincos direction)
{
    int32_t sum = mul16(v.x, direction.cos) + mul16(v.y, direction.sin);

    return saturate16(mul24_high((sum + 0x4000) >> 8, 2));
}

/* |value|, one less where it is negative: it always fits. */
static uint32_t size_of(int32_t value)
{
    return (uint32_t)(value < 0 ? ~value : value);
}

/* How to make values of some size narrow: away with a byte, or not, then times by / 256. */
struct shrinking {
    bool byte;
    uint8_t by;
};

/* For sizes below 2^31, or-ed together. Halves what is narrow already. */
static struct shrinking shrinking_of(uint32_t size)
{
    uint16_t above = (uint16_t)(size << 1 >> 16);
    struct shrinking s = {.byte = above > UINT8_MAX, .by = 128};

    if (s.byte)
        above >>= 8;
    for (uint8_t bits = (uint8_t)above >> 1; bits != 0; bits >>= 1)
        s.by >>= 1;
    return s;
}

static int16_t shrink(int32_t value, struct shrinking by)
{
    return no_minimum((int16_t)mul24_high(by.byte ? value >> 8 : value, by.by));
}

struct vec16 vec_saturate(int32_t x, int32_t y)
{
    if ((int16_t)x == x && (int16_t)y == y)
        return (struct vec16){no_minimum((int16_t)x), no_minimum((int16_t)y)};
    struct shrinking by = shrinking_of(size_of(x) | size_of(y));
    return (struct vec16){shrink(x, by), shrink(y, by)};
}

struct vec16 vec_add_scaled(struct vec16 a, uint16_t gain, struct vec16 b)
{
    return vec_saturate(a.x + (mul16_mixed(b.x, gain) >> 8), a.y + (mul16_mixed(b.y, gain) >> 8));
}

uint32_t vec_square_between(struct vec16 a, struct vec16 b)
{
    return square16((int16_t)(a.x - b.x)) + square16((int16_t)(a.y - b.y));
}
