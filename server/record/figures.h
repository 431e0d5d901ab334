/* figures.h: the pictures of a run. */
#ifndef FIGURES_H
#define FIGURES_H

/* Draws DIR/routes.svg, DIR/distance_error.svg and the same as .png from DIR/trace.csv and
 * DIR/events.csv, by gnuplot. Same files, same pictures. Returns 0, or -1 after saying on stderr
 * why there are none: gnuplot may be missing. */
int figures_write(const char *dir);

#endif
