#define _GNU_SOURCE /* accept4() */
#include "endpoint.h"

#include "endpoint_kinds.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

/* A pty's host that has said nothing so many times is taken for gone. */
#define SILENCES_MAX 50

static void tell(const struct endpoint *endpoint, const char *words)
{
    if (!endpoint->quiet)
        fprintf(stderr, "muster robot: robot %u: %s\n", endpoint->robot, words);
}

static void hang_up(struct endpoint *endpoint, const char *words)
{
    close(endpoint->host);
    endpoint->host = -1;
    tell(endpoint, words);
}

static void accept_host(struct watch *listener, uint32_t events)
{
    struct endpoint *endpoint = (struct endpoint *)listener;
    int host = accept4(listener->fd, NULL, NULL, SOCK_NONBLOCK | SOCK_CLOEXEC);

    (void)events;
    if (host < 0)
        return;
    if (endpoint->host >= 0)
        hang_up(endpoint, "another host takes the place of the one that was there");
    endpoint->host = host;
    tell(endpoint, "its host is there");
}

/* The text with the first %d replaced. False when it does not fit. */
static bool put_id(const char *where, uint16_t robot, char *out, size_t room)
{
    const char *id = strstr(where, "%d");
    int length = id == NULL
                     ? snprintf(out, room, "%s", where)
                     : snprintf(out, room, "%.*s%u%s", (int)(id - where), where, robot, id + 2);

    return length < (int)room;
}

static bool open_kind(struct endpoint *endpoint, const char *where, char *error, size_t room)
{
    if (strncmp(where, "pty:", 4) == 0)
        return endpoint_open_pty(endpoint, where + 4, error, room);
    if (strncmp(where, "tcp:", 4) == 0)
        return endpoint_open_tcp(endpoint, where + 4, error, room);
    if (strcmp(where, "rfcomm") == 0)
        return endpoint_open_rfcomm(endpoint, "", error, room);
    if (strncmp(where, "rfcomm:", 7) == 0)
        return endpoint_open_rfcomm(endpoint, where + 7, error, room);
    snprintf(error, room,
             "'%s' is no link; pty:PATH, tcp:HOST:PORT and rfcomm[:CHANNEL[@ADDRESS]] are allowed",
             where);
    return false;
}

bool endpoint_open(struct endpoint *endpoint, struct loop *loop, const char *where, uint16_t robot,
                   bool quiet, char *error, size_t room)
{
    char text[256];

    *endpoint = (struct endpoint){
        .listener = {.fd = -1, .ready = accept_host},
        .loop = loop,
        .robot = robot,
        .quiet = quiet,
        .host = -1,
        .slave = -1,
        .claim = -1,
    };
    if (!put_id(where, robot, text, sizeof text)) {
        snprintf(error, room, "the link's text is too long");
        return false;
    }
    if (!open_kind(endpoint, text, error, room))
        return false;
    if (endpoint->listener.fd < 0 || loop_watch(loop, &endpoint->listener, EPOLLIN))
        return true;
    snprintf(error, room, "cannot wait for hosts: %s", strerror(errno));
    return false;
}

/* What a pty's host leaves unread waits for the next one, which is not to hear of the past. A pty
 * does not tell whether anybody holds its other end, so silence has to. */
static void judge_silence(struct endpoint *endpoint, bool silent)
{
    endpoint->silences = silent ? endpoint->silences + 1 : 0;
    if (endpoint->slave >= 0 && endpoint->silences > SILENCES_MAX)
        tcflush(endpoint->slave, TCIFLUSH);
}

size_t endpoint_receive(struct endpoint *endpoint, uint8_t *bytes, size_t room)
{
    if (endpoint->host < 0)
        return 0;
    ssize_t count = read(endpoint->host, bytes, room);
    judge_silence(endpoint, count <= 0);
    if (count > 0)
        return (size_t)count;
    if (count == 0)
        hang_up(endpoint, "its host is gone");
    else if (errno != EAGAIN && errno != EINTR)
        hang_up(endpoint, strerror(errno));
    return 0;
}

void endpoint_send(struct endpoint *endpoint, const uint8_t *bytes, size_t count)
{
    if (endpoint->host < 0 || count == 0)
        return;
    ssize_t sent = endpoint->slave >= 0 ? write(endpoint->host, bytes, count)
                                        : send(endpoint->host, bytes, count, MSG_NOSIGNAL);
    if (sent < 0 && errno != EAGAIN && errno != EINTR)
        hang_up(endpoint, strerror(errno));
}

/* Only if it is still ours: a link that leads to another pty is another robot's. */
static void remove_link(const struct endpoint *endpoint)
{
    char mine[64], there[64];
    ssize_t length = readlink(endpoint->path, there, sizeof there - 1);

    if (length < 0 || ttyname_r(endpoint->slave, mine, sizeof mine) != 0)
        return;
    there[length] = '\0';
    if (strcmp(there, mine) == 0)
        unlink(endpoint->path);
}

void endpoint_close(struct endpoint *endpoint)
{
    if (endpoint->path[0] != '\0')
        remove_link(endpoint);
    if (endpoint->listener.fd >= 0) {
        loop_forget(endpoint->loop, &endpoint->listener);
        close(endpoint->listener.fd);
    }
    if (endpoint->host >= 0)
        close(endpoint->host);
    if (endpoint->slave >= 0)
        close(endpoint->slave);
    if (endpoint->claim >= 0)
        close(endpoint->claim);
}
