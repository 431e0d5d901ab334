#define _GNU_SOURCE /* SOCK_NONBLOCK */

#include "stream.h"

#include <errno.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

/* Names are looked up once, before anything moves: the resolver blocks. */
static bool look_up(struct stream *stream, char *error, size_t room)
{
    const struct link_address *address = &stream->settings->address;
    struct addrinfo hints = {.ai_socktype = SOCK_STREAM};
    char port[8];

    snprintf(port, sizeof port, "%u", address->port);
    int rc = getaddrinfo(address->name, port, &hints, &stream->addresses);
    if (rc != 0) {
        snprintf(error, room, "tcp:%s:%s: %s (an address in digits needs no name service)",
                 address->name, port, gai_strerror(rc));
        return false;
    }
    stream->next = stream->addresses;
    return true;
}

static void release(struct stream *stream)
{
    if (stream->addresses != NULL)
        freeaddrinfo(stream->addresses);
    stream->addresses = NULL;
}

/* A dial to a port of this host that nobody listens on may be given that same port as its own, and
 * is then connected to itself: it would hear all it says, and keep the robot from its port. */
static bool met_itself(int fd)
{
    struct sockaddr_storage own = {0}, other = {0};
    socklen_t own_length = sizeof own;
    socklen_t other_length = sizeof other;

    return getsockname(fd, (struct sockaddr *)&own, &own_length) == 0 &&
           getpeername(fd, (struct sockaddr *)&other, &other_length) == 0 &&
           own_length == other_length && memcmp(&own, &other, own_length) == 0;
}

static enum stream_step judge(const struct stream *stream)
{
    if (!met_itself(stream->watch.fd))
        return STREAM_CONNECTED;
    errno = ECONNREFUSED;
    return STREAM_FAILED;
}

/* Each dial takes the next of the host's addresses: `localhost` has two. */
static enum stream_step dial(struct stream *stream)
{
    const struct addrinfo *to = stream->next;
    int on = 1;
    int fd = socket(to->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);

    stream->next = to->ai_next != NULL ? to->ai_next : stream->addresses;
    stream->watch.fd = fd;
    stream->awaited = EPOLLOUT;
    if (fd < 0 || setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on) != 0)
        return STREAM_FAILED;
    if (connect(fd, to->ai_addr, to->ai_addrlen) == 0)
        return judge(stream);
    return errno == EINPROGRESS ? STREAM_UNDER_WAY : STREAM_FAILED;
}

static enum stream_step go_on(struct stream *stream, uint32_t events, int64_t now_us)
{
    (void)now_us;
    if (events == 0)
        return STREAM_UNDER_WAY;
    return stream_connected(stream) == STREAM_CONNECTED ? judge(stream) : STREAM_FAILED;
}

static const char *words(int error)
{
    switch (error) {
    case ECONNREFUSED: return "nothing listens on this port: is the robot's program running?";
    case ECONNRESET:
    case EPIPE: return "the robot's side broke the connection off";
    case ETIMEDOUT: return "no answer: is the robot on, and in this network?";
    case EHOSTUNREACH: return "no such host in reach: is the robot on, and in this network?";
    case ENETUNREACH: return "no way to this network: is this host's network up?";
    default: return NULL;
    }
}

const struct stream_kind stream_tcp = {
    .is_socket = true,
    .patience_us = 3000000,
    .prepare = look_up,
    .release = release,
    .dial = dial,
    .go_on = go_on,
    .hang_up = stream_close,
    .words = words,
};
