#include "progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

#define WIDTH 40
#define REDRAW_NS 100000000

int64_t wall_ns(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

void progress_begin(struct progress *progress, bool quiet)
{
    *progress = (struct progress){.shown = !quiet && isatty(STDERR_FILENO),
                                  .started = wall_ns()};
}

void progress_show(struct progress *progress, double done, double whole)
{
    int64_t now;

    if (!progress->shown || (now = wall_ns()) - progress->drawn < REDRAW_NS)
        return;
    progress->drawn = now;

    char bar[WIDTH + 1];
    double part = whole > 0 ? done / whole : 1;
    for (int i = 0; i < WIDTH; i++)
        bar[i] = i < part * WIDTH ? '#' : '.';
    bar[WIDTH] = '\0';
    double elapsed = (double)(now - progress->started) / 1e9;
    fprintf(stderr, "\r[%s] %3.0f %%  t = %.1f of %g s, %.1f times real time ", bar, part * 100,
            done, whole, elapsed > 0 ? done / elapsed : 0);
}

void progress_end(struct progress *progress)
{
    if (progress->shown && progress->drawn != 0)
        fprintf(stderr, "\r%*s\r", WIDTH + 60, "");
}
