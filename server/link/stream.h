/* stream.h: what differs between the kinds of links: how one is dialled and how its errors are
 * called. What they have in common is in link.c. Private to this room. */
#ifndef STREAM_H
#define STREAM_H

#include "link.h"

struct addrinfo;
struct stream;

enum stream_step {
    STREAM_FAILED,    /* with errno */
    STREAM_UNDER_WAY, /* `awaited` says for what */
    STREAM_CONNECTED
};

struct stream_kind {
    bool is_socket;
    int64_t patience_us; /* with one dial */

    /* What has to be known before the first dial; it alone may block. May be NULL. */
    bool (*prepare)(struct stream *stream, char *error, size_t room);
    void (*release)(struct stream *stream); /* what prepare() took. May be NULL */

    /* Opens watch.fd, without blocking, and begins. */
    enum stream_step (*dial)(struct stream *stream);

    /* Goes on with a dial: something has happened to watch.fd, or (events 0) time has passed. May
     * put another descriptor into watch.fd, the old one being forgotten and closed. */
    enum stream_step (*go_on)(struct stream *stream, uint32_t events, int64_t now_us);

    /* What a new connection needs beside bytes. NULL, or in words what is amiss. May be NULL. */
    const char *(*settle)(struct stream *stream);

    /* Ends a dial or a connection. watch.fd is forgotten already. */
    void (*hang_up)(struct stream *stream);

    const char *(*words)(int error); /* NULL when strerror() says it as well */
};

/* The search for a robot's channel, rfcomm.c's. */
struct channel_search {
    void *session; /* NULL: none is going on */
    bool asked;
    int64_t until_us;
    uint8_t found;   /* by the one that is going on; 0: nothing yet */
    uint8_t channel; /* remembered for later dials; 0: never found */
};

struct stream {
    struct watch watch; /* the first: the loop hands this back */
    struct loop *loop;
    const struct stream_kind *kind;
    const struct link_settings *settings;
    uint32_t awaited;
    struct addrinfo *addresses, *next; /* tcp.c's */
    uint8_t adapter[6];                /* rfcomm: to dial by, as it is written */
    struct channel_search search;
};

extern const struct stream_kind stream_tcp, stream_tty, stream_rfcomm;

/* SO_ERROR: 0 when all is well. Reading it clears it. */
int stream_error(const struct stream *stream);

/* The end of a dial that waited for EPOLLOUT. */
enum stream_step stream_connected(const struct stream *stream);

/* Closes the descriptor: the hang_up() of kinds that hold nothing else. */
void stream_close(struct stream *stream);

#endif
