#include "fixed.h"

#include "rom.h"

#include <stdbool.h>

/* sin(i / 256 quarter turns) in Q1.15. */
static const uint16_t sine[257] ROM = {
    0, 201, 402, 603, 804, 1005, 1206, 1407, 1608, 1809, 2009, 2210,
    2411, 2611, 2811, 3012, 3212, 3412, 3612, 3812, 4011, 4211, 4410, 4609,
    4808, 5007, 5205, 5404, 5602, 5800, 5998, 6195, 6393, 6590, 6787, 6983,
    7180, 7376, 7571, 7767, 7962, 8157, 8351, 8546, 8740, 8933, 9127, 9319,
    9512, 9704, 9896, 10088, 10279, 10469, 10660, 10850, 11039, 11228, 11417, 11605,
    11793, 11980, 12167, 12354, 12540, 12725, 12910, 13095, 13279, 13463, 13646, 13828,
    14010, 14192, 14373, 14553, 14733, 14912, 15091, 15269, 15447, 15624, 15800, 15976,
    16151, 16326, 16500, 16673, 16846, 17018, 17190, 17361, 17531, 17700, 17869, 18037,
    18205, 18372, 18538, 18703, 18868, 19032, 19195, 19358, 19520, 19681, 19841, 20001,
    20160, 20318, 20475, 20632, 20788, 20943, 21097, 21251, 21403, 21555, 21706, 21856,
    22006, 22154, 22302, 22449, 22595, 22740, 22884, 23028, 23170, 23312, 23453, 23593,
    23732, 23870, 24008, 24144, 24279, 24414, 24548, 24680, 24812, 24943, 25073, 25202,
    25330, 25457, 25583, 25708, 25833, 25956, 26078, 26199, 26320, 26439, 26557, 26674,
    26791, 26906, 27020, 27133, 27246, 27357, 27467, 27576, 27684, 27791, 27897, 28002,
    28106, 28209, 28311, 28411, 28511, 28610, 28707, 28803, 28899, 28993, 29086, 29178,
    29269, 29359, 29448, 29535, 29622, 29707, 29792, 29875, 29957, 30038, 30118, 30196,
    30274, 30350, 30425, 30499, 30572, 30644, 30715, 30784, 30853, 30920, 30986, 31050,
    31114, 31177, 31238, 31298, 31357, 31415, 31471, 31527, 31581, 31634, 31686, 31737,
    31786, 31834, 31881, 31927, 31972, 32015, 32058, 32099, 32138, 32177, 32214, 32251,
    32286, 32319, 32352, 32383, 32413, 32442, 32470, 32496, 32522, 32546, 32568, 32590,
    32610, 32629, 32647, 32664, 32679, 32693, 32706, 32718, 32729, 32738, 32746, 32753,
    32758, 32762, 32766, 32767, 32767,
};

/* atan(i / 256) in quarter units of an angle: two bits more than the result needs. */
static const uint16_t arctangent[257] ROM = {
    0, 163, 326, 489, 652, 815, 978, 1141, 1303, 1466, 1629, 1792,
    1954, 2117, 2279, 2442, 2604, 2767, 2929, 3091, 3253, 3415, 3577, 3738,
    3900, 4061, 4223, 4384, 4545, 4706, 4867, 5028, 5188, 5349, 5509, 5669,
    5829, 5989, 6148, 6308, 6467, 6626, 6784, 6943, 7101, 7260, 7418, 7575,
    7733, 7890, 8047, 8204, 8361, 8517, 8673, 8829, 8985, 9140, 9296, 9450,
    9605, 9759, 9914, 10067, 10221, 10374, 10527, 10680, 10832, 10984, 11136, 11287,
    11439, 11590, 11740, 11890, 12040, 12190, 12339, 12488, 12637, 12785, 12933, 13081,
    13228, 13375, 13522, 13668, 13814, 13959, 14105, 14249, 14394, 14538, 14682, 14825,
    14968, 15111, 15253, 15395, 15537, 15678, 15819, 15960, 16100, 16239, 16379, 16518,
    16656, 16794, 16932, 17069, 17206, 17343, 17479, 17615, 17750, 17885, 18020, 18154,
    18288, 18421, 18554, 18687, 18819, 18951, 19083, 19213, 19344, 19474, 19604, 19733,
    19862, 19991, 20119, 20247, 20374, 20501, 20627, 20753, 20879, 21004, 21129, 21254,
    21378, 21501, 21624, 21747, 21870, 21992, 22113, 22234, 22355, 22475, 22595, 22714,
    22834, 22952, 23070, 23188, 23306, 23423, 23539, 23655, 23771, 23886, 24001, 24116,
    24230, 24344, 24457, 24570, 24682, 24795, 24906, 25017, 25128, 25239, 25349, 25459,
    25568, 25677, 25785, 25893, 26001, 26108, 26215, 26321, 26427, 26533, 26638, 26743,
    26848, 26952, 27056, 27159, 27262, 27364, 27467, 27568, 27670, 27771, 27871, 27972,
    28072, 28171, 28270, 28369, 28467, 28565, 28663, 28760, 28857, 28953, 29050, 29145,
    29241, 29336, 29430, 29525, 29619, 29712, 29805, 29898, 29991, 30083, 30175, 30266,
    30357, 30448, 30538, 30628, 30718, 30807, 30896, 30985, 31073, 31161, 31248, 31336,
    31423, 31509, 31595, 31681, 31767, 31852, 31937, 32022, 32106, 32190, 32273, 32357,
    32439, 32522, 32604, 32686, 32768,
};

/* The sine of `quarter` / 16,384 quarter turns, 0 <= quarter <= 16,384. */
static int16_t sine_of_quarter(uint16_t quarter)
{
    uint16_t i = quarter >> 6;
    uint8_t part = quarter & 63;
    uint16_t low = rom_u16(&sine[i]);

    if (part == 0)
        return (int16_t)low;
    uint16_t step = rom_u16(&sine[i + 1]) - low;
    return (int16_t)(low + ((step * part + 32u) >> 6));
}

struct sincos sincos_of(angle_t angle)
{
    uint16_t rest = angle & (ANGLE_QUARTER - 1);
    int16_t rising = sine_of_quarter(rest);
    int16_t falling = sine_of_quarter(ANGLE_QUARTER - rest);

    switch (angle >> 14) {
    case 0:
        return (struct sincos){rising, falling};
    case 1:
        return (struct sincos){falling, (int16_t)-rising};
    case 2:
        return (struct sincos){(int16_t)-rising, (int16_t)-falling};
    default:
        return (struct sincos){(int16_t)-falling, rising};
    }
}

/* atan(low / high) for low <= high, high > 0: 0 to an eighth of a turn. */
static uint16_t octant_angle(uint16_t low, uint16_t high)
{
    uint32_t ratio = (((uint32_t)low << 16) + high / 2) / high;
    uint16_t i = (uint16_t)(ratio >> 8);
    uint8_t part = ratio & 0xFF;
    uint16_t quarters = rom_u16(&arctangent[i]);

    if (part != 0)
        quarters += (uint16_t)(((uint32_t)(rom_u16(&arctangent[i + 1]) - quarters) * part) >> 8);
    return (quarters + 2) >> 2;
}

angle_t direction_of(struct vec16 v)
{
    uint16_t ax = v.x < 0 ? 0u - (uint16_t)v.x : (uint16_t)v.x;
    uint16_t ay = v.y < 0 ? 0u - (uint16_t)v.y : (uint16_t)v.y;

    if (ax == 0 && ay == 0)
        return 0;
    uint16_t a = ay <= ax ? octant_angle(ay, ax) : ANGLE_QUARTER - octant_angle(ax, ay);
    if (v.x < 0)
        a = 2 * ANGLE_QUARTER - a;
    return v.y < 0 ? (angle_t)-a : a;
}

static bool is_narrow(struct vec32 v)
{
    return v.x <= INT16_MAX && v.x >= -INT16_MAX && v.y <= INT16_MAX && v.y >= -INT16_MAX;
}

static void halve(struct vec32 *v)
{
    v->x >>= 1;
    v->y >>= 1;
}

struct vec16 vec_saturate(struct vec32 v)
{
    while (!is_narrow(v))
        halve(&v);
    return (struct vec16){(int16_t)v.x, (int16_t)v.y};
}

static uint32_t square(struct vec32 v)
{
    return (uint32_t)mul16((int16_t)v.x, (int16_t)v.x) +
           (uint32_t)mul16((int16_t)v.y, (int16_t)v.y);
}

int8_t vec_compare(struct vec32 a, struct vec32 b)
{
    while (!is_narrow(a) || !is_narrow(b)) {
        halve(&a);
        halve(&b);
    }
    uint32_t of_a = square(a);
    uint32_t of_b = square(b);

    return of_a < of_b ? -1 : of_a > of_b;
}

struct vec32 vec_rotate(struct vec16 v, struct sincos by)
{
    /* Each product is below 2^30, so their sum and the rounding stay within 32 bits. */
    return (struct vec32){(mul16(v.x, by.cos) - mul16(v.y, by.sin) + 0x4000) >> 15,
                          (mul16(v.x, by.sin) + mul16(v.y, by.cos) + 0x4000) >> 15};
}

struct vec32 vec_rotate_back(struct vec16 v, struct sincos by)
{
    return vec_rotate(v, (struct sincos){(int16_t)-by.sin, by.cos});
}

int16_t angle_of_rate(int16_t rate, int16_t ms)
{
    /* 1,335 / 2^17 = 65,536 / (2 pi * 1,024 * 1,000), within 7e-5. */
    return (int16_t)(((mul16(rate, ms) >> 5) * 1335 + 2048) >> 12);
}

int16_t distance_of_speed(int16_t speed, int16_t ms)
{
    /* 2,097 / 2^21 = 1 / 1,000, within 8e-5; the product stays below 2^31. */
    return (int16_t)(((mul16(speed, ms) >> 5) * 2097) >> 16);
}

struct pose pose_advance(struct pose from, int16_t speed, int16_t rate, int16_t ms)
{
    int16_t turn = angle_of_rate(rate, ms);
    int16_t chord = distance_of_speed(speed, ms);
    struct sincos middle = sincos_of((angle_t)(from.theta + (turn >> 1)));

    from.at.x += mul_q15(chord, middle.cos);
    from.at.y += mul_q15(chord, middle.sin);
    from.theta += (angle_t)turn;
    return from;
}
