/* comparison.h: the mean distance errors of runs, side by side. */
#ifndef COMPARISON_H
#define COMPARISON_H

#include "archive.h"

#include <stdio.h>

/* Whether a file's name has one of the ends that comparison_draw() knows: .svg, .png, .pdf. */
bool comparison_knows(const char *name);

/* Draws DIR/NAME. A few runs have a style each; many are thin lines with their median. What befell
 * the team is marked when there is one run. False, and words in `error`, when it cannot be drawn:
 * gnuplot may be missing. */
bool comparison_draw(struct archive *const *archives, size_t count, const char *dir,
                     const char *name, char *error, size_t room);

/* A line for each run: its end, and the mean distance error at the end, at its peak and
 * integrated. */
void comparison_print(struct archive *const *archives, size_t count, FILE *out);

/* Their median at a time, of those that last so long. NAN when none does or there is no memory. */
double comparison_median(struct archive *const *archives, size_t count, double t);

#endif
