/* gnuplot.h: pictures by gnuplot. */
#ifndef GNUPLOT_H
#define GNUPLOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Okabe and Ito's colours and two of Tol's, told apart by colour-blind people too. Black is a
 * mean's. */
#define GNUPLOT_COLOURS 8
extern const unsigned gnuplot_colours[GNUPLOT_COLOURS];

/* Runs a script, from its beginning, in `dir`, so that no name has to be quoted for it. False and
 * words in `error` when it did not get done: gnuplot may be missing. */
bool gnuplot_run(const char *dir, FILE *script, char *error, size_t room);

#endif
