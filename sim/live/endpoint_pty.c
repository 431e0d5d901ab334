#define _GNU_SOURCE /* posix_openpt() and what belongs to it */
#include "endpoint_kinds.h"

#include <errno.h>
#include <fcntl.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

/* Bytes pass as they are, both ways. */
static bool make_raw(int tty)
{
    struct termios settings;

    if (tcgetattr(tty, &settings) != 0)
        return false;
    cfmakeraw(&settings);
    return tcsetattr(tty, TCSANOW, &settings) == 0;
}

static bool open_pair(struct endpoint *endpoint, char *name, size_t room)
{
    endpoint->host = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (endpoint->host < 0 || grantpt(endpoint->host) != 0 || unlockpt(endpoint->host) != 0 ||
        ptsname_r(endpoint->host, name, room) != 0)
        return false;
    endpoint->slave = open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    return endpoint->slave >= 0 && make_raw(endpoint->slave);
}

/* A path is one living robot's: the name of this socket goes when its process does. */
static bool claim(struct endpoint *endpoint, const char *path)
{
    struct sockaddr_un name = {.sun_family = AF_UNIX};
    int length = snprintf(name.sun_path + 1, sizeof name.sun_path - 1, "muster:%s", path);

    endpoint->claim = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    return endpoint->claim >= 0 &&
           bind(endpoint->claim, (const struct sockaddr *)&name,
                (socklen_t)(offsetof(struct sockaddr_un, sun_path) + 1 + (size_t)length)) == 0;
}

/* Whether it is a symbolic link to a pty, be there one by this name now or not. */
static bool is_left_over(const char *path)
{
    static const char ptys[] = "/dev/pts/";
    char there[sizeof ptys];

    return readlink(path, there, sizeof there) == sizeof there &&
           memcmp(there, ptys, sizeof ptys - 1) == 0;
}

/* Makes the path free: a link to a pty is left over from a robot that was killed. */
static bool clear_path(const char *path, char *error, size_t room)
{
    struct stat status;

    if (lstat(path, &status) != 0)
        return true;
    if (is_left_over(path) && unlink(path) == 0)
        return true;
    snprintf(error, room, "%s is in the way; only a symbolic link to a pty is replaced", path);
    return false;
}

bool endpoint_open_pty(struct endpoint *endpoint, const char *path, char *error, size_t room)
{
    char name[64];

    if (path[0] == '\0' || strlen(path) >= sizeof endpoint->path) {
        snprintf(error, room, "'%s' is no path; 1 to %zu bytes are allowed", path,
                 sizeof endpoint->path - 1);
        return false;
    }
    if (!claim(endpoint, path)) {
        snprintf(error, room, "%s cannot be had%s", path,
                 errno == EADDRINUSE ? ": another robot has it" : "");
        return false;
    }
    if (!clear_path(path, error, room))
        return false;
    if (!open_pair(endpoint, name, sizeof name)) {
        snprintf(error, room, "cannot open a pty: %s", strerror(errno));
        return false;
    }
    if (symlink(name, path) != 0) {
        snprintf(error, room, "cannot make the link %s: %s", path, strerror(errno));
        return false;
    }
    strcpy(endpoint->path, path);
    snprintf(endpoint->link, sizeof endpoint->link, "tty:%s", path);
    return true;
}
