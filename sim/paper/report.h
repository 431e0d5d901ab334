/* report.h: the figures written down: for readers, for programs, for the documentation. */
#ifndef PAPER_REPORT_H
#define PAPER_REPORT_H

#include "figure.h"
#include "runs.h"

#include <stddef.h>
#include <stdio.h>

struct report {
    bool avr;    /* the robots are chips, but for runs that are always native */
    double wall; /* s that it all took */
    const struct runs *runs;
    const struct figure *figures;
    size_t count;
};

/* One page, with its style and its pictures in it: it refers to nothing outside and runs no script.
 */
void report_html(const struct report *report, FILE *out);

void report_json(const struct report *report, FILE *out);

/* The same without pictures. Nothing in it depends on how fast or on what kind of robots the runs
 * were, but for the line that begins with "Robots:". */
void report_markdown(const struct report *report, FILE *out);

/* How many figures have this verdict. */
size_t report_verdicts(const struct report *report, enum verdict verdict);

/* What the robots are, in words. */
const char *report_robots(const struct report *report);

#endif
