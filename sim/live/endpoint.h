/* endpoint.h: where a robot's host reaches it: a pty, a TCP port, an RFCOMM channel.
 *
 * One host at a time: who comes takes the place of who was there. Nothing blocks; what the host
 * does not take at once is lost, as on the air. */
#ifndef LIVE_ENDPOINT_H
#define LIVE_ENDPOINT_H

#include "loop.h"

#include <stddef.h>
#include <stdint.h>

#define ENDPOINT_LINK_MAX 128

struct endpoint {
    struct watch listener; /* of a socket: hosts that come; -1: none */
    struct loop *loop;
    uint16_t robot;
    bool quiet;                   /* does not tell on stderr who comes and goes */
    int host;                     /* what its host speaks through; -1: nobody is there */
    int slave;                    /* of a pty, kept open so that hosts may come and go; else -1 */
    int claim;                    /* of a pty, what keeps other robots from its path; else -1 */
    unsigned silences;            /* pty: times in a row that nothing had come */
    char path[100];               /* pty: the symbolic link to its slave; "": none made */
    char link[ENDPOINT_LINK_MAX]; /* as the `link:` of a site file takes it */
};

/* `where` is pty:PATH, tcp:HOST:PORT (port 0: any), or rfcomm[:CHANNEL[@ADDRESS]] with the address
 * of a local adapter; the first `%d` stands for the robot's id. False, and words in `error`, when
 * it is none of them or cannot be had. The endpoint must stay where it is. */
bool endpoint_open(struct endpoint *endpoint, struct loop *loop, const char *where, uint16_t robot,
                   bool quiet, char *error, size_t room);

/* Takes what has come, at most `room` bytes. To be called once a tick, and again while there is
 * more: a pty gives little at a time. */
size_t endpoint_receive(struct endpoint *endpoint, uint8_t *bytes, size_t room);

void endpoint_send(struct endpoint *endpoint, const uint8_t *bytes, size_t count);

/* Also one that could not be opened. */
void endpoint_close(struct endpoint *endpoint);

#endif
