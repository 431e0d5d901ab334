#include "address.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

bool address_of(const char *host, uint16_t port, struct sockaddr_in *address, char *error,
                size_t room)
{
    const struct addrinfo hints = {.ai_family = AF_INET, .ai_socktype = SOCK_DGRAM};
    struct addrinfo *found;
    int failure = getaddrinfo(host, NULL, &hints, &found);

    if (failure != 0) {
        snprintf(error, room, "no address of %s: %s", host, gai_strerror(failure));
        return false;
    }
    memcpy(address, found->ai_addr, sizeof *address);
    address->sin_port = htons(port);
    freeaddrinfo(found);
    return true;
}

bool address_read(const char *text, struct sockaddr_in *address, char *error, size_t room)
{
    const char *colon = strrchr(text, ':');
    char host[256], *end;

    if (colon == NULL || colon == text || colon - text >= (long)sizeof host) {
        snprintf(error, room, "'%s': HOST:PORT is allowed", text);
        return false;
    }
    snprintf(host, sizeof host, "%.*s", (int)(colon - text), text);
    unsigned long port = strtoul(colon + 1, &end, 10);
    if (colon[1] < '0' || colon[1] > '9' || *end != '\0' || port > UINT16_MAX) {
        snprintf(error, room, "'%s' is no port; 0 to 65535 is allowed", colon + 1);
        return false;
    }
    return address_of(host, (uint16_t)port, address, error, room);
}

void address_write(const struct sockaddr_in *address, char text[ADDRESS_TEXT_MAX])
{
    char host[INET_ADDRSTRLEN];

    inet_ntop(AF_INET, &address->sin_addr, host, sizeof host);
    snprintf(text, ADDRESS_TEXT_MAX, "%s:%u", host, ntohs(address->sin_port));
}

struct sockaddr_in address_bound(int fd)
{
    struct sockaddr_in address = {.sin_family = AF_INET};

    getsockname(fd, (struct sockaddr *)&address, &(socklen_t){sizeof address});
    return address;
}
