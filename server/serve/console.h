/* console.h: the operator's terminal: lines of words, a table below them, keys.
 *
 * What the terminal does not take at once is dropped: robots never wait for a reader. */
#ifndef CONSOLE_H
#define CONSOLE_H

#include <stdbool.h>
#include <stddef.h>
#include <termios.h>

struct console {
    bool keyed;     /* stdin is a terminal and set to single keys */
    bool live;      /* stdout is a terminal: the table is drawn in place */
    unsigned drawn; /* lines of the table that stand there */
    struct termios before;
};

/* Sets the terminal to single keys where stdin is one; a `quiet` console has no table. */
void console_open(struct console *console, bool quiet);

/* Leaves the terminal as it was. */
void console_close(struct console *console);

/* One line on stderr, above the table. */
void console_say(struct console *console, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Puts the table, lines that end with '\n', in place of the one before; none where stdout is no
 * terminal. */
void console_table(struct console *console, const char *text, size_t length);

/* Puts text below all else, to stay there. */
void console_print(struct console *console, const char *text, size_t length);

/* Lines and columns that a table may have. */
unsigned console_lines(void);
unsigned console_columns(void);

/* The next key, 0 when there is none; -1 when there will be none any more. */
int console_key(void);

#endif
