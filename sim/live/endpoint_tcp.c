#include "address.h"
#include "endpoint_kinds.h"

#include <errno.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>

bool endpoint_open_tcp(struct endpoint *endpoint, const char *rest, char *error, size_t room)
{
    struct sockaddr_in address;
    char text[ADDRESS_TEXT_MAX];
    const int on = 1;

    if (!address_read(rest, &address, error, room))
        return false;
    int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    endpoint->listener.fd = fd;
    /* Accepted sockets inherit TCP_NODELAY. */
    if (fd < 0 || setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
        setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on) != 0 ||
        bind(fd, (const struct sockaddr *)&address, sizeof address) != 0 || listen(fd, 4) != 0) {
        snprintf(error, room, "cannot listen on %s: %s", rest, strerror(errno));
        return false;
    }
    address = address_bound(fd);
    address_write(&address, text);
    snprintf(endpoint->link, sizeof endpoint->link, "tcp:%s", text);
    return true;
}
