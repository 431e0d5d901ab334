#define _GNU_SOURCE /* SOCK_NONBLOCK */

#include "place.h"

#include <arpa/inet.h>
#include <errno.h>
#include <netdb.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define BACKLOG 128

/* What a viewer has not taken yet is to wait where newer things can overtake it, not in the kernel.
 */
#define SEND_BUFFER 262144

static bool read_port(const char *text, uint16_t *port)
{
    size_t digits = strspn(text, "0123456789");
    unsigned long value = strtoul(text, NULL, 10);

    *port = (uint16_t)value;
    return digits >= 1 && digits <= 5 && text[digits] == '\0' && value <= UINT16_MAX;
}

/* Cuts "ADDRESS:PORT" and the like in two; the port is NULL where there is none. */
static bool cut(char *place, const char **address, const char **port)
{
    char *end = place[0] == '[' ? strchr(place, ']') : strchr(place, ':');

    *address = place;
    *port = NULL;
    if (place[0] == '[') {
        if (end == NULL || (end[1] != ':' && end[1] != '\0'))
            return false;
        *address = place + 1;
        *port = end[1] == ':' ? end + 2 : NULL;
        *end = '\0';
    } else if (end != NULL && strchr(end + 1, ':') == NULL) {
        *port = end + 1;
        *end = '\0';
    }
    return **address != '\0';
}

bool view_place(struct view_options *options, char *place, char *error, size_t room)
{
    const char *address, *port;

    *options = (struct view_options){.port = VIEW_PORT};
    if (read_port(place, &options->port))
        return true;
    snprintf(error, room, "'%s': PORT, ADDRESS, ADDRESS:PORT or [ADDRESS]:PORT is allowed", place);
    options->port = VIEW_PORT;
    if (place[strspn(place, "0123456789")] == '\0' || !cut(place, &address, &port))
        return false;
    options->address = address;
    return port == NULL || read_port(port, &options->port);
}

/* ---- listening ------------------------------------------------------------------------- */

static void tell(const struct view_options *options, const char *address, char *error, size_t room)
{
    switch (errno) {
    case EADDRINUSE:
        snprintf(error, room,
                 "port %u is taken, by another muster perhaps: --view=0 takes any that is free",
                 options->port);
        break;
    case EADDRNOTAVAIL: snprintf(error, room, "%s is no address of this machine", address); break;
    case EACCES:
        snprintf(error, room, "port %u is not for everyone: take one from 1024 on", options->port);
        break;
    default:
        snprintf(error, room, "%s, port %u: %s", address, options->port, strerror(errno));
        break;
    }
}

static bool set_up(int fd, const struct addrinfo *at)
{
    int on = 1;
    int bytes = SEND_BUFFER;

    return setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
           setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &bytes, sizeof bytes) == 0 &&
           bind(fd, at->ai_addr, at->ai_addrlen) == 0 && listen(fd, BACKLOG) == 0;
}

int place_listen(const struct view_options *options, char *error, size_t room)
{
    const char *address = options->address != NULL ? options->address : "127.0.0.1";
    const struct addrinfo hints = {.ai_socktype = SOCK_STREAM, .ai_flags = AI_PASSIVE};
    struct addrinfo *at;
    char port[8];

    snprintf(port, sizeof port, "%u", options->port);
    int failure = getaddrinfo(address, port, &hints, &at);
    if (failure != 0) {
        snprintf(error, room, "no address of %s: %s", address, gai_strerror(failure));
        return -1;
    }
    int fd = socket(at->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (fd < 0 || !set_up(fd, at)) {
        tell(options, address, error, room);
        if (fd >= 0)
            close(fd);
        fd = -1;
    }
    freeaddrinfo(at);
    return fd;
}

void place_name(int listener, char *name, size_t room)
{
    struct sockaddr_storage at = {0};
    const struct sockaddr_in *v4 = (const struct sockaddr_in *)&at;
    const struct sockaddr_in6 *v6 = (const struct sockaddr_in6 *)&at;
    char host[PLACE_HOST_MAX] = "localhost";

    getsockname(listener, (struct sockaddr *)&at, &(socklen_t){sizeof at});
    bool any = at.ss_family == AF_INET6 ? IN6_IS_ADDR_UNSPECIFIED(&v6->sin6_addr)
                                        : v4->sin_addr.s_addr == htonl(INADDR_ANY);
    if (any)
        gethostname(host, sizeof host - 1);
    else if (at.ss_family == AF_INET6)
        inet_ntop(AF_INET6, &v6->sin6_addr, host, sizeof host);
    else
        inet_ntop(AF_INET, &v4->sin_addr, host, sizeof host);
    const char *form = strchr(host, ':') != NULL ? "[%s]:%u" : "%s:%u";
    snprintf(name, room, form, host, ntohs(v4->sin_port)); /* where v6 has it too */
}
