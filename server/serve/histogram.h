/* histogram.h: how long things took, over hours, in a few kilobytes. */
#ifndef HISTOGRAM_H
#define HISTOGRAM_H

#include <stdint.h>

/* 32 steps in every factor of two: percentiles are right to 3 %. */
#define HISTOGRAM_STEPS 32
#define HISTOGRAM_OCTAVES 24

struct histogram {
    uint64_t count;
    uint32_t most; /* us */
    uint64_t in[HISTOGRAM_OCTAVES * HISTOGRAM_STEPS];
};

void histogram_add(struct histogram *histogram, int64_t us);

/* The value, in us, that `part` (0 to 1) of them do not exceed; 0 when there are none. */
double histogram_at(const struct histogram *histogram, double part);

#endif
