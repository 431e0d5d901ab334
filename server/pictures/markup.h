/* markup.h: text inside of HTML, SVG, JSON and Markdown. */
#ifndef MARKUP_H
#define MARKUP_H

#include <stdio.h>

/* For HTML and SVG, also inside of an attribute's double quotes. */
void markup_text(FILE *out, const char *text);

/* A JSON string, with its quotes. */
void markup_string(FILE *out, const char *text);

/* A cell of a Markdown table. */
void markup_cell(FILE *out, const char *text);

#endif
