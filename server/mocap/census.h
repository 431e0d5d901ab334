/* census.h: which bodies a motion-capture system has spoken of, how often, and how evenly. */
#ifndef CENSUS_H
#define CENSUS_H

#include "capture.h"

#include <stdio.h>

struct census_body {
    char name[CAPTURE_NAME_MAX];
    int32_t id;
    bool tracked; /* when it was spoken of last */
    uint64_t frames, frames_tracked;
    int64_t tracked_us; /* arrival of the last frame in which it was tracked */
    int64_t gap_us;     /* longest time without one */
};

/* Begins zeroed. */
struct census {
    uint64_t frames;
    int64_t first_us, last_us; /* arrivals */
    int64_t gap_us;            /* longest time without a frame */
    size_t count;              /* bodies; beyond CAPTURE_BODIES_MAX none is counted */
    struct census_body body[CAPTURE_BODIES_MAX];
};

void census_take(struct census *census, const struct capture_frame *frame, int64_t arrival_us);

/* Frames a second, 0 before there are two. */
double census_rate(const struct census *census);

/* Bodies that were tracked when they were spoken of last. */
size_t census_tracked(const struct census *census);

/* A line for each body. */
void census_print(const struct census *census, FILE *out);

#endif
