/* keyframes.h: a motion told by as few of its moments as an error allows. */
#ifndef KEYFRAMES_H
#define KEYFRAMES_H

#include <stdbool.h>
#include <stddef.h>

#define KEYFRAMES_DIMENSIONS 2

/* A motion, moment by moment; `t` rises. Points of one dimension have 0 in the other. */
struct keyframes_point {
    double t, at[KEYFRAMES_DIMENSIONS];
};

/* Picks points of `count`, the first and the last among them, so that the straight way from each
 * to the next is nowhere, at any point's own time, farther than `error` from that point (Douglas
 * and Peucker's method, with time in place of a direction). Their indices go to `picked`, of
 * `count`. Returns how many; 0 when there is no memory. */
size_t keyframes_pick(const struct keyframes_point *points, size_t count, double error,
                      size_t *picked);

#endif
