#include "fixed.h"

static bool is_narrow(const struct vec32 *v)
{
    return (int16_t)v->x == v->x && (int16_t)v->y == v->y;
}

static void halve(struct vec32 *v)
{
    v->x >>= 1;
    v->y >>= 1;
}

static uint32_t square(const struct vec32 *v)
{
    return square16((int16_t)v->x) + square16((int16_t)v->y);
}

int8_t vec_compare(const struct vec32 *a, const struct vec32 *b)
{
    struct vec32 of[] = {*a, *b};

    while (!is_narrow(&of[0]) || !is_narrow(&of[1])) {
        halve(&of[0]);
        halve(&of[1]);
    }
    uint32_t of_a = square(&of[0]);
    uint32_t of_b = square(&of[1]);

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

void pose_advance(struct pose *pose, int16_t speed, int16_t rate, int16_t ms)
{
    int16_t turn = angle_of_rate(rate, ms);
    int16_t chord = distance_of_speed(speed, ms);
    struct sincos middle = sincos_of((angle_t)(pose->theta + (turn >> 1)));

    pose->at.x += mul_q15(chord, middle.cos);
    pose->at.y += mul_q15(chord, middle.sin);
    pose->theta += (angle_t)turn;
}
