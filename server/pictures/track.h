/* track.h: one thing that moves or changes in an animated SVG: its values at moments, written as
 * SMIL's `keyTimes` and `values`. Everything loops in the same time. */
#ifndef TRACK_H
#define TRACK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* When which part of a run is shown. */
struct timeline {
    double from, to;    /* of the run, s */
    double play, total; /* of the picture, s: until `to` is shown, and until it begins again */
};

/* The moment at which a time of the run is shown, as a share of the whole. */
double timeline_share(const struct timeline *timeline, double t);

#define TRACK_VALUE_MAX 40

struct track {
    const struct timeline *timeline;
    FILE *times, *values;
    char *times_text, *values_text;
    size_t times_length, values_length;
    char last[TRACK_VALUE_MAX]; /* value */
    bool begun;                 /* the first value is there, from the beginning on */
};

/* False when there is no memory. */
bool track_open(struct track *track, const struct timeline *timeline);

/* A value from a time of the run on; times rise. The first one also holds before it, the last one
 * until the end. */
void track_key(struct track *track, double t, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Writes <ELEMENT dur="..." repeatCount="indefinite" keyTimes="..." values="..."/> and forgets all.
 * `element` has its attributes but for these. */
void track_close(struct track *track, FILE *out, const char *element);

#endif
