#include "robot.h"

#include "limits.h"

#define BITS_PER_BYTE 10 /* start, eight, stop */

/* Where in its period a robot's control tick is wanted, ms. */
#define PHASE_MS 5

struct link_timing link_timing_of(uint32_t baud)
{
    return (struct link_timing){
        .baud = baud,
        .slots = (uint16_t)(baud * TICK_MS / (BITS_PER_BYTE * 1000)),
        .before_phase = (uint16_t)(baud * PHASE_MS / (BITS_PER_BYTE * 1000)),
    };
}

double link_phase_s(const struct link_timing *timing)
{
    return (timing->before_phase + 0.5) * BITS_PER_BYTE / timing->baud;
}

double link_actuation_s(const struct link_timing *timing)
{
    return link_phase_s(timing) + ACTUATION_MS / 1000.0;
}
