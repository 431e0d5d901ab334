#include "console.h"

#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#define CHUNK 1024 /* a terminal that is writable takes as much without waiting */
#define LINE_MAX_BYTES 512

static bool ready(int fd, short events)
{
    struct pollfd descriptor = {fd, events, 0};

    return poll(&descriptor, 1, 0) == 1 && (descriptor.revents & events);
}

static void put(int fd, const char *text, size_t length)
{
    while (length > 0 && ready(fd, POLLOUT)) {
        ssize_t written = write(fd, text, length < CHUNK ? length : CHUNK);

        if (written <= 0)
            return;
        text += written;
        length -= (size_t)written;
    }
}

void console_open(struct console *console, bool quiet)
{
    *console = (struct console){.live = !quiet && isatty(STDOUT_FILENO)};
    /* In the background the terminal is somebody else's: to ask for it must not stop the server. */
    signal(SIGTTIN, SIG_IGN);
    signal(SIGTTOU, SIG_IGN);
    if (!isatty(STDIN_FILENO) || tcgetpgrp(STDIN_FILENO) != getpgrp() ||
        tcgetattr(STDIN_FILENO, &console->before) != 0)
        return;
    struct termios keys = console->before;
    keys.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
    keys.c_cc[VMIN] = 0;
    keys.c_cc[VTIME] = 0;
    console->keyed = tcsetattr(STDIN_FILENO, TCSANOW, &keys) == 0;
}

void console_close(struct console *console)
{
    if (console->keyed)
        tcsetattr(STDIN_FILENO, TCSANOW, &console->before);
}

/* Takes the table away: what follows begins where it began. */
static void clear(struct console *console)
{
    char text[32];

    if (console->drawn == 0)
        return;
    int length = snprintf(text, sizeof text, "\033[%uA\r\033[J", console->drawn);
    put(STDOUT_FILENO, text, (size_t)length);
    console->drawn = 0;
}

void console_say(struct console *console, const char *format, ...)
{
    char line[LINE_MAX_BYTES];
    va_list arguments;

    va_start(arguments, format);
    int length = vsnprintf(line, sizeof line - 1, format, arguments);
    va_end(arguments);
    if (length < 0)
        return;
    if ((size_t)length > sizeof line - 2)
        length = sizeof line - 2;
    line[length++] = '\n';
    clear(console);
    put(STDERR_FILENO, line, (size_t)length);
}

/* Written over what stands there, so that it does not flicker. */
void console_print(struct console *console, const char *text, size_t length)
{
    clear(console);
    put(STDOUT_FILENO, text, length);
}

void console_table(struct console *console, const char *text, size_t length)
{
    char up[32] = "\r";
    const char *end = text + length;

    if (!console->live)
        return;
    if (console->drawn > 0)
        snprintf(up, sizeof up, "\033[%uA\r", console->drawn);
    put(STDOUT_FILENO, up, strlen(up));
    console->drawn = 0;
    while (text != end) {
        size_t line = strcspn(text, "\n");

        put(STDOUT_FILENO, text, line);
        put(STDOUT_FILENO, "\033[K\n", 4);
        console->drawn++;
        text += line + 1;
    }
    put(STDOUT_FILENO, "\033[J", 3);
}

static struct winsize window(void)
{
    struct winsize size = {.ws_row = 24, .ws_col = 80};
    struct winsize told;

    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &told) == 0 && told.ws_row > 0 && told.ws_col > 0)
        return told;
    return size;
}

unsigned console_lines(void)
{
    return window().ws_row;
}

unsigned console_columns(void)
{
    return window().ws_col;
}

int console_key(void)
{
    char key;

    if (!ready(STDIN_FILENO, POLLIN))
        return 0;
    ssize_t count = read(STDIN_FILENO, &key, 1);
    return count == 1 ? (unsigned char)key : count == 0 ? -1 : 0;
}
