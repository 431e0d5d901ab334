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

/* `done` of `whole` seconds are simulated. Draws ten times a second at most. */
void progress_show(struct progress *progress, double done, double whole);

void progress_end(struct progress *progress);

/* Monotonic time in ns. */
int64_t wall_ns(void);

#endif
