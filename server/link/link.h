/* link.h: byte streams to robots, which come and go.
 *
 * Each link is dialled at once and again, with back-off, for as long as it is down; none waits for
 * another one. Nothing blocks; what is sent is one write, and what the kernel did not take of it
 * waits in the link, a few hundred bytes at most. */
#ifndef LINK_H
#define LINK_H

#include "loop.h"

#include <stddef.h>

enum link_kind { LINK_RFCOMM, LINK_TTY, LINK_TCP };

#define LINK_WORDS_MAX 160
#define LINK_SEND_MAX 512 /* bytes in one send */

/* Where a robot is: `rfcomm:00:11:22:33:44:55`, with `/3` for a fixed channel behind it;
 * `tty:/dev/ttyUSB0` (a pty too); `tcp:HOST:PORT`. */
struct link_address {
    enum link_kind kind;
    char name[108];       /* path, or host; "" for rfcomm */
    uint16_t port;        /* tcp */
    uint8_t bluetooth[6]; /* as it is written: first byte first */
    uint8_t channel;      /* rfcomm: 1 to 30; 0: looked up by SDP, 1 where that fails */
};

/* False, and what is allowed in `words`, when the text is none. */
bool link_address_read(const char *text, struct link_address *address, char words[LINK_WORDS_MAX]);

/* For people, as it is written in a site file but without the channel. */
void link_address_write(const struct link_address *address, char *text, size_t room);

struct link_settings {
    struct link_address address;
    int adapter; /* rfcomm: n of hciN; -1: the one with the fewest robots */
    uint32_t
        baud; /* 10 at least; of a tty, and what paces every link: a robot's UART is behind it */
};

struct link_owner {
    void *context;
    void (*up)(void *context, size_t robot);
    void (*down)(void *context, size_t robot, const char *words);
    void (*received)(void *context, size_t robot, const uint8_t *bytes, size_t count);
};

enum link_state { LINK_WAITING, LINK_DIALLING, LINK_UP };

struct link_view {
    enum link_state state;
    char words[LINK_WORDS_MAX]; /* why it is not up, or what is amiss though it is; or "" */
    char address[128];          /* for people, with the adapter where there is one */
    uint64_t sent, received;    /* bytes */
    uint32_t connects;
    int64_t heard_us; /* when something came last; 0: never */
};

struct links;

#define LINK_ADAPTER_ROBOTS 7 /* Bluetooth: active members of a piconet beside its master */

/* Every link of a site; dialling begins at the next links_tick(). NULL and words in `error` when
 * memory is short or the adapters are not enough (seven robots each). Settings and owner must
 * outlive them. */
struct links *links_open(struct loop *loop, const struct link_settings *settings, size_t count,
                         const struct link_owner *owner, char *error, size_t room);

/* At least ten times a second: dials, gives up, and drops links that have been silent for
 * LINK_SILENCE_US. */
#define LINK_SILENCE_US 2000000
void links_tick(struct links *links, int64_t now_us);

/* Bytes that may be sent to a robot now: what its UART has taken by now of what was sent before, at
 * its baud rate, LINK_SEND_MAX at most. 0 while the link is down or still has bytes waiting. */
size_t links_room(struct links *links, size_t robot, int64_t now_us);

/* Sends at most links_room() bytes in one write. */
void links_send(struct links *links, size_t robot, const uint8_t *bytes, size_t count);

const struct link_view *links_look(const struct links *links, size_t robot);

/* A Bluetooth adapter of this host. */
struct link_adapter {
    int number;         /* n of hciN */
    uint8_t address[6]; /* as it is written */
    bool up;
    size_t robots; /* whose links are its own to dial */
};

/* The adapters, by number; none where there is no Bluetooth. `links` may be NULL: then no robots
 * are theirs. */
#define LINK_ADAPTERS_MAX 16
size_t links_adapters(const struct links *links, struct link_adapter adapters[LINK_ADAPTERS_MAX]);

/* Closes every link at once; what a tty has not sent yet is lost. down() is called for those that
 * are up. */
void links_close(struct links *links);

#endif
