/* qtm_names.h: the names of the bodies in what QTM answers to `GetParameters 6d`.
 *
 * The answer is XML, and grows with the bodies' points beyond what is sensible to keep, so it is
 * read piece by piece. Only Name directly in Body, in The_6D, in the outermost element counts:
 * meshes and points have names too. XML that does not close what it opens, or has entities of its
 * own, fails. */
#ifndef QTM_NAMES_H
#define QTM_NAMES_H

#include "capture.h"

#define QTM_WORD_MAX 16

struct qtm_names {
    size_t count;
    char name[CAPTURE_BODIES_MAX][CAPTURE_NAME_MAX]; /* in the order of the bodies in every frame */

    /* Where reading stands; of no concern outside. */
    int state;
    bool begun, failed;
    char quote, last;        /* in a tag: the quote that is open; the byte before */
    unsigned depth, matched; /* elements open; those of them that are on the way to a name */
    size_t word_length;      /* beyond QTM_WORD_MAX: too long to matter */
    char word[QTM_WORD_MAX]; /* an element's or entity's name */
    size_t name_length, dashes;
};

void qtm_names_begin(struct qtm_names *names);
void qtm_names_take(struct qtm_names *names, const uint8_t *bytes, size_t count);

/* All is there, and well-formed as far as it matters. */
bool qtm_names_done(const struct qtm_names *names);

#endif
