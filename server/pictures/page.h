/* page.h: an HTML page with its style in it: it refers to nothing outside and runs no script. */
#ifndef PAGE_H
#define PAGE_H

#include <stdio.h>

/* Up to <main>, and from </main> on. */
void page_open(FILE *out, const char *title);
void page_close(FILE *out);

/* <tag class="classes">text</tag> */
void page_element(FILE *out, const char *tag, const char *classes, const char *text);

#endif
