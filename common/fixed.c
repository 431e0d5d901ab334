#include "fixed.h"

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
    int16_t part = (int16_t)mul24_high(by.byte ? value >> 8 : value, by.by);

    return part == INT16_MIN ? -INT16_MAX : part;
}

struct vec16 vec_shorten(int32_t x, int32_t y)
{
    struct shrinking by = shrinking_of(size_of(x) | size_of(y));

    return (struct vec16){shrink(x, by), shrink(y, by)};
}

static uint32_t square(struct vec16 v)
{
    return (uint32_t)mul16(v.x, v.x) + (uint32_t)mul16(v.y, v.y);
}

int8_t vec_compare(struct vec32 a, struct vec32 b)
{
    struct vec16 short_a = {(int16_t)a.x, (int16_t)a.y};
    struct vec16 short_b = {(int16_t)b.x, (int16_t)b.y};

    if (!is_narrow(a) || !is_narrow(b)) {
        struct shrinking by =
            shrinking_of(size_of(a.x) | size_of(a.y) | size_of(b.x) | size_of(b.y));

        short_a = (struct vec16){shrink(a.x, by), shrink(a.y, by)};
        short_b = (struct vec16){shrink(b.x, by), shrink(b.y, by)};
    }
    uint32_t of_a = square(short_a);
    uint32_t of_b = square(short_b);

    return of_a < of_b ? -1 : of_a > of_b;
}

int16_t angle_of_rate(int16_t rate, int16_t ms)
{
    /* 1,335 / 2^17 = 65,536 / (2 pi * 1,024 * 1,000), within 7e-5. */
    int16_t per_rate = (int16_t)mul24_high(mul16(ms, 1335) + 32, 4);

    return (int16_t)mul24_high((mul16(rate, per_rate) + 1024) >> 8, 32);
}

int16_t distance_of_speed(int16_t speed, int16_t ms)
{
    /* 16,777 / 2^24 = 1 / 1,000, within 2e-5; a second stays below 1 in Q1.15. */
    return mul_q15(speed, (int16_t)(mul16(ms, 16777) >> 8 >> 1));
}

static struct vec16 along_chord(angle_t middle, int16_t chord)
{
    struct sincos direction = sincos_of(middle);

    return (struct vec16){mul_q15(chord, direction.cos), mul_q15(chord, direction.sin)};
}

struct vec16 travelled(angle_t theta, int16_t speed, int16_t rate, int16_t ms)
{
    return along_chord((angle_t)(theta + (angle_of_rate(rate, ms) >> 1)),
                       distance_of_speed(speed, ms));
}

void pose_advance(struct pose *pose, int16_t speed, int16_t rate, int16_t ms)
{
    int16_t turn = angle_of_rate(rate, ms);
    struct vec16 gone =
        along_chord((angle_t)(pose->theta + (turn >> 1)), distance_of_speed(speed, ms));

    pose->at.x += gone.x;
    pose->at.y += gone.y;
    pose->theta += (angle_t)turn;
}
