#include "progress.h"

#include <stdarg.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#define WIDTH 24
#define WORDS 46 /* bar, percentage and words fit into 80 columns */
#define REDRAW_NS 100000000

int64_t wall_ns(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

void progress_begin(struct progress *progress, bool quiet)
{
    *progress = (struct progress){.shown = !quiet && isatty(STDERR_FILENO), .started = wall_ns()};
}

double progress_elapsed(const struct progress *progress)
{
    return (double)(wall_ns() - progress->started + 1) / 1e9;
}

void progress_show(struct progress *progress, double part, const char *format, ...)
{
    int64_t now;
    char bar[WIDTH + 1], words[WORDS];
    va_list arguments;

    if (!progress->shown || (now = wall_ns()) - progress->drawn < REDRAW_NS)
        return;
    progress->drawn = now;
    for (int i = 0; i < WIDTH; i++)
        bar[i] = i < part * WIDTH ? '#' : '.';
    bar[WIDTH] = '\0';
    va_start(arguments, format);
    vsnprintf(words, sizeof words, format, arguments);
    va_end(arguments);
    /* Words that have become shorter leave nothing behind. */
    fprintf(stderr, "\r[%s] %3.0f %%  %-*s", bar, part * 100, WORDS - 1, words);
}

void progress_end(struct progress *progress)
{
    if (progress->shown && progress->drawn != 0)
        fprintf(stderr, "\r%*s\r", WIDTH + WORDS + 8, "");
}
