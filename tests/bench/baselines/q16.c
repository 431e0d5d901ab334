#include "q16.h"

#define STEPS 17

/* atan(2^-i), and the product of all cos(atan(2^-i)). */
static const q16 arctangent[STEPS] = {51472, 30386, 16055, 8150, 4091, 2047, 1024, 512, 256,
                                      128,   64,    32,    16,   8,    4,    2,    1};
#define GAIN ((q16)39797)

q16 q16_wrap(q16 angle)
{
    while (angle > Q16_PI)
        angle -= 2 * Q16_PI;
    while (angle < -Q16_PI)
        angle += 2 * Q16_PI;
    return angle;
}

void q16_sincos(q16 angle, q16 *sin, q16 *cos)
{
    q16 x = GAIN, y = 0;
    int8_t turned = 0;

    if (angle > Q16_PI / 2) {
        angle -= Q16_PI;
        turned = 1;
    } else if (angle < -Q16_PI / 2) {
        angle += Q16_PI;
        turned = 1;
    }
    for (uint8_t i = 0; i < STEPS; i++) {
        q16 dx = x >> i, dy = y >> i;

        x += angle < 0 ? dy : -dy;
        y += angle < 0 ? -dx : dx;
        angle += angle < 0 ? arctangent[i] : -arctangent[i];
    }
    *sin = turned ? -y : y;
    *cos = turned ? -x : x;
}

q16 q16_atan2(q16 y, q16 x)
{
    q16 angle = 0;

    if (x < 0) {
        angle = y < 0 ? -Q16_PI : Q16_PI;
        x = -x;
        y = -y;
    }
    for (uint8_t i = 0; i < STEPS; i++) {
        q16 dx = x >> i, dy = y >> i;

        x += y < 0 ? -dy : dy;
        angle += y < 0 ? -arctangent[i] : arctangent[i];
        y += y < 0 ? dx : -dx;
    }
    return angle;
}
