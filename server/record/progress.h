/* progress.h: a bar for people who wait. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct progress {
    bool shown;
    int64_t started, drawn; /* ns */
};

/* Shown only where stderr is a terminal, and not with `quiet`. */
void progress_begin(struct progress *progress, bool quiet);

/* `part` of the work is done, 0 to 1; the words stand beside the bar. Draws ten times a second at
 * most. */
void progress_show(struct progress *progress, double part, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Seconds since it began, above 0. */
double progress_elapsed(const struct progress *progress);

void progress_end(struct progress *progress);

/* Monotonic time in ns. */
int64_t wall_ns(void);

#endif
