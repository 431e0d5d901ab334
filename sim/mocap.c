#include "mocap.h"

#include "chance.h"
#include "limits.h"

#include <math.h>

/* The usual rate of such arenas. */
#define SMALL_RATE 120

/* Merriaux et al. (Sensors 17 (2017) 1591) measured 0.15 mm on markers that stood still and up to
 * 2 mm on fast ones: a robot is slow. Two markers 110 mm apart, as far as the small body allows,
 * give its heading as well as their places allow: sqrt(2) 0.3 / 110 = 0.0039 rad = 0.22 degrees. */
#define SMALL_PLACE_NOISE 0.0003
#define SMALL_HEADING_NOISE (0.2 * M_PI / 180)

enum axis { AXIS_X, AXIS_Y, AXIS_THETA };

struct mocap mocap_of(const struct scenario *scenario, uint64_t seed)
{
    if (scenario->body == BODY_SMALL)
        return (struct mocap){SMALL_RATE, SMALL_PLACE_NOISE, SMALL_HEADING_NOISE, seed};
    return (struct mocap){.rate = TICKS_PER_S};
}

struct mocap_sample mocap_newest(const struct mocap *mocap, uint64_t tick)
{
    uint64_t samples = tick * mocap->rate;
    double age = (double)(samples % TICKS_PER_S) / mocap->rate / TICKS_PER_S;

    return (struct mocap_sample){
        .number = samples / TICKS_PER_S,
        .age = age,
        .age_ms = (uint16_t)lround(age * 1000),
    };
}

/* Bell-shaped, mean 0, standard deviation 1: the sum of four numbers of 16 bits. Never beyond
 * 3.5, as cameras that lose a marker say so instead of guessing. */
static double bell(uint64_t draw)
{
    double sum =
        (double)((draw & 0xFFFF) + (draw >> 16 & 0xFFFF) + (draw >> 32 & 0xFFFF) + (draw >> 48));

    return (sum / 65536 - 2) * sqrt(3);
}

static double noise(const struct mocap *mocap, uint16_t robot, uint64_t sample, enum axis axis,
                    double deviation)
{
    uint64_t name = (uint64_t)robot << 48 | (uint64_t)axis << 40 | sample;

    if (deviation == 0)
        return 0;
    return deviation * bell(chance_draw(mocap->seed, CHANCE_NOISE, name));
}

struct server_pose mocap_pose(const struct mocap *mocap, const struct mocap_sample *sample,
                              uint16_t robot, const struct body *seen)
{
    uint64_t number = sample->number;

    return (struct server_pose){
        .x = seen->x + noise(mocap, robot, number, AXIS_X, mocap->place_noise),
        .y = seen->y + noise(mocap, robot, number, AXIS_Y, mocap->place_noise),
        .theta = seen->theta + noise(mocap, robot, number, AXIS_THETA, mocap->heading_noise),
        .tracked = true,
        .age_ms = (int16_t)sample->age_ms,
    };
}
