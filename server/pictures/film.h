/* film.h: a run as an animated SVG: no script, nothing outside, the same bytes from the same run.
 *
 * It moves by SMIL, so also inside of an <img>, and is drawn in light or dark colours as its reader
 * likes; who asked for less motion sees its last moment. */
#ifndef FILM_H
#define FILM_H

#include "archive.h"

#include <stdio.h>

#define FILM_WIDTH 860
#define FILM_WIDTH_MIN 320
#define FILM_WIDTH_MAX 3840

struct film_options {
    double from, to; /* of the run, s */
    double speed;    /* times real time; 0: so that it lasts some 15 s */
    double width;    /* pixels */
};

/* False when there is no memory, or what is written cannot be. */
bool film_write(const struct archive *archive, const struct film_options *options, FILE *out);

#endif
