/* roster.h: the robots that are being worked with, on stderr: a line for each that has ended, and
 * below them, where that is a terminal, one with a bar for each that works. */
#ifndef ROSTER_H
#define ROSTER_H

#include <stdbool.h>
#include <stddef.h>

/* One that works. */
struct roster_line {
    char name[24];
    double progress; /* 0 to 1 */
    const char *words;
};

struct roster {
    bool live;      /* stderr is a terminal: bars are drawn */
    unsigned drawn; /* lines of them that stand there */
};

void roster_begin(struct roster *roster, bool quiet);

/* One line above the bars, to stay there. */
void roster_say(struct roster *roster, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Draws the bars anew; as many as fit. */
void roster_draw(struct roster *roster, const struct roster_line *lines, size_t count);

/* Takes the bars away. */
void roster_end(struct roster *roster);

#endif
