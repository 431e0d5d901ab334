/* address.h: an IPv4 address and port, as people write it: HOST:PORT. */
#ifndef ADDRESS_H
#define ADDRESS_H

#include <netinet/in.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define ADDRESS_TEXT_MAX 24

/* Looks the host up; it may be a name, and a name server may take its time. False, and what is
 * allowed or missing in `error`. */
bool address_read(const char *text, struct sockaddr_in *address, char *error, size_t room);

/* A host without a port behind it. */
bool address_of(const char *host, uint16_t port, struct sockaddr_in *address, char *error,
                size_t room);

void address_write(const struct sockaddr_in *address, char text[ADDRESS_TEXT_MAX]);

/* Where a socket is bound. */
struct sockaddr_in address_bound(int fd);

#endif
