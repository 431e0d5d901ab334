#include "roster.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#define BAR 20
#define LINE_BYTES 512

void roster_begin(struct roster *roster, bool quiet)
{
    *roster = (struct roster){.live = !quiet && isatty(STDERR_FILENO)};
}

static struct winsize window(void)
{
    struct winsize size = {.ws_row = 24, .ws_col = 80};
    struct winsize told;

    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &told) == 0 && told.ws_row > 1 && told.ws_col > 0)
        return told;
    return size;
}

void roster_end(struct roster *roster)
{
    if (roster->drawn > 0)
        fprintf(stderr, "\033[%uA\r\033[J", roster->drawn);
    roster->drawn = 0;
}

void roster_say(struct roster *roster, const char *format, ...)
{
    va_list arguments;

    roster_end(roster);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

static void draw_job(const struct job *job, const char *link, unsigned columns)
{
    char bar[BAR + 1], name[48], line[LINE_BYTES];

    for (int i = 0; i < BAR; i++)
        bar[i] = i < job->progress * BAR ? '#' : '.';
    bar[BAR] = '\0';
    snprintf(name, sizeof name, "robot %u", job->robot);
    snprintf(line, sizeof line, "%-11s [%s] %3.0f %%  %s", job->robot != 0 ? name : link, bar,
             job->progress * 100, job->words);
    /* A line that wraps would count twice. */
    fprintf(stderr, "%.*s\033[K\n", (int)columns - 1, line);
}

void roster_draw(struct roster *roster, struct job *const *jobs, const char *const *links,
                 size_t count)
{
    struct winsize size = window();
    unsigned drawn = 0, more = 0;

    if (!roster->live)
        return;
    if (roster->drawn > 0)
        fprintf(stderr, "\033[%uA\r", roster->drawn);
    for (size_t i = 0; i < count; i++) {
        if (jobs[i]->state != JOB_WORKING)
            continue;
        if (drawn + 2 < size.ws_row) {
            draw_job(jobs[i], links[i], size.ws_col);
            drawn++;
        } else {
            more++;
        }
    }
    if (more > 0) {
        fprintf(stderr, "and %u more\033[K\n", more);
        drawn++;
    }
    fputs("\033[J", stderr);
    roster->drawn = drawn;
}
