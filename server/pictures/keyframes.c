#include "keyframes.h"

#include <math.h>
#include <stdlib.h>

struct span {
    size_t first, last;
};

/* How far a point is from the straight way between two others at its time. */
static double distance(const struct keyframes_point *from, const struct keyframes_point *to,
                       const struct keyframes_point *point)
{
    double share = (point->t - from->t) / (to->t - from->t);
    double squares = 0;

    for (size_t i = 0; i < KEYFRAMES_DIMENSIONS; i++) {
        double away = from->at[i] + share * (to->at[i] - from->at[i]) - point->at[i];
        squares += away * away;
    }
    return sqrt(squares);
}

/* The point that is farthest off, or `span.first` when none is farther off than `error`. */
static size_t farthest(const struct keyframes_point *points, struct span span, double error)
{
    size_t chosen = span.first;

    for (size_t i = span.first + 1; i < span.last; i++) {
        double off = distance(&points[span.first], &points[span.last], &points[i]);
        if (off > error) {
            error = off;
            chosen = i;
        }
    }
    return chosen;
}

/* The pile holds the spans that are yet to be looked at, the earliest on top. */
static size_t pick(const struct keyframes_point *points, size_t count, double error, size_t *picked,
                   struct span *pile)
{
    size_t high = 0, used = 0;

    picked[used++] = 0;
    pile[high++] = (struct span){0, count - 1};
    while (high > 0) {
        struct span span = pile[--high];
        size_t middle = farthest(points, span, error);

        if (middle != span.first) {
            pile[high++] = (struct span){middle, span.last};
            pile[high++] = (struct span){span.first, middle};
        } else if (span.last != span.first) {
            picked[used++] = span.last;
        }
    }
    return used;
}

size_t keyframes_pick(const struct keyframes_point *points, size_t count, double error,
                      size_t *picked)
{
    struct span *pile = calloc(count + 1, sizeof *pile);

    if (pile == NULL)
        return 0;
    size_t used = pick(points, count, error, picked, pile);
    free(pile);
    return used;
}
