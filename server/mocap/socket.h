/* socket.h: sockets that never wait, as motion capture needs them. IPv4, as all its systems speak.
 */
#ifndef SOCKET_H
#define SOCKET_H

#include <netinet/in.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#define SOCKET_WORDS_MAX 64

/* An interface of ours. */
struct socket_interface {
    unsigned index;         /* 0: as the kernel chooses */
    struct in_addr address; /* INADDR_ANY: as the kernel chooses */
};

/* By address or name. False, and the interfaces that there are in `error`, when it is none. */
bool socket_interface_find(const char *text, struct socket_interface *interface, char *error,
                           size_t room);

/* Ours that the kernel reaches a system by: without an address when it does not know any. */
struct socket_interface socket_interface_towards(const struct sockaddr_in *system);

/* "10.0.0.5:1510", or without a port where it is 0. Returns `words`. */
const char *socket_words(const struct sockaddr_in *address, char words[SOCKET_WORDS_MAX]);

/* A UDP socket of its own port that tells when datagrams arrived, and that nobody listened where
 * one was sent. A descriptor, or -1 with errno; so with the next two. */
int socket_ask(void);

/* A UDP socket that listens on a port of all interfaces. */
int socket_listen(uint16_t port);

/* As socket_listen(), for what is sent to a group; others may listen to it as well. */
int socket_join(struct in_addr group, uint16_t port, const struct socket_interface *interface);

/* A TCP socket that is connecting: writable when it has ended, with socket_error(). */
int socket_connect(const struct sockaddr_in *address);

/* The error that waits at a socket, as an errno; 0: none. Takes it away. */
int socket_error(int fd);

/* Receives a datagram. Its arrival by loop_now()'s clock is the kernel's where that can be true:
 * not before `since_us`, when there was nothing, and not in the future, whatever was done to the
 * date meanwhile. As recvfrom() else. */
ssize_t socket_receive(int fd, void *bytes, size_t room, struct sockaddr_in *from, int64_t since_us,
                       int64_t *arrival_us);

#endif
