#include "histogram.h"

#include <math.h>

#define LAST (HISTOGRAM_OCTAVES * HISTOGRAM_STEPS - 1)

/* Values below HISTOGRAM_STEPS have a place each; above, the leading bits choose it. */
static unsigned place_of(uint32_t us)
{
    unsigned octave = 0;

    while (us >> octave >= 2 * HISTOGRAM_STEPS)
        octave++;
    unsigned place = octave * HISTOGRAM_STEPS + (us >> octave);
    return place < LAST ? place : LAST;
}

/* The largest value that falls into a place. */
static double value_at(unsigned place)
{
    unsigned octave = place < 2 * HISTOGRAM_STEPS ? 0 : place / HISTOGRAM_STEPS - 1;
    double leading = place - octave * HISTOGRAM_STEPS;

    return ldexp(leading + 1, (int)octave) - 1;
}

void histogram_add(struct histogram *histogram, int64_t us)
{
    uint32_t value = us < 0 ? 0 : us > UINT32_MAX ? UINT32_MAX : (uint32_t)us;

    histogram->count++;
    histogram->in[place_of(value)]++;
    if (value > histogram->most)
        histogram->most = value;
}

double histogram_at(const struct histogram *histogram, double part)
{
    double wanted = part * (double)histogram->count;
    uint64_t passed = 0;

    for (unsigned place = 0; place <= LAST; place++) {
        passed += histogram->in[place];
        if (passed > 0 && (double)passed >= wanted)
            return fmin(value_at(place), histogram->most);
    }
    return histogram->most;
}
