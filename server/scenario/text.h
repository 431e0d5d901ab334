/* text.h: whether bytes are text, and which word was meant. */
#ifndef SCENARIO_TEXT_H
#define SCENARIO_TEXT_H

#include <stddef.h>

/* The number of bytes before the first one that is not text: no control character but tab, line
 * feed and carriage return, and well-formed UTF-8. */
size_t text_length(const char *bytes, size_t length);

/* Changes that turn one word into the other: letters added, left out, changed or swapped with
 * the next. Words beyond 31 letters count as wholly different. */
unsigned text_distance(const char *a, const char *b);

/* The word most like `word` in a list that ends with NULL; NULL when none is near. */
const char *text_nearest(const char *word, const char *const *list);

#endif
