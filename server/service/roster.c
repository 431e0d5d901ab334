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

    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &told) == 0 && told.ws_row > 2 && told.ws_col > 0)
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

static void draw_line(const struct roster_line *line, unsigned columns)
{
    char bar[BAR + 1], text[LINE_BYTES];

    for (int i = 0; i < BAR; i++)
        bar[i] = i < line->progress * BAR ? '#' : '.';
    bar[BAR] = '\0';
    snprintf(text, sizeof text, "%-11s [%s] %3.0f %%  %s", line->name, bar, line->progress * 100,
             line->words);
    /* A line that wraps would count twice. */
    fprintf(stderr, "%.*s\033[K\n", (int)columns - 1, text);
}

void roster_draw(struct roster *roster, const struct roster_line *lines, size_t count)
{
    struct winsize size = window();
    size_t fit = size.ws_row - 2u, shown = count <= fit ? count : fit;

    if (!roster->live)
        return;
    if (roster->drawn > 0)
        fprintf(stderr, "\033[%uA\r", roster->drawn);
    for (size_t i = 0; i < shown; i++)
        draw_line(&lines[i], size.ws_col);
    roster->drawn = (unsigned)shown;
    if (shown < count) {
        fprintf(stderr, "and %zu more\033[K\n", count - shown);
        roster->drawn++;
    }
    fputs("\033[J", stderr);
}
