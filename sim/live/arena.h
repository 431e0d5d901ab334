/* arena.h: the arena of virtual robots in real time: moves their bodies by the set-points that
 * their processes send, and tells of them as a NatNet server. */
#ifndef LIVE_ARENA_H
#define LIVE_ARENA_H

#include "scenario.h"

struct arena_options {
    const struct scenario *scenario;       /* where the robots start, and their bodies */
    unsigned rate;                         /* frames a second */
    const char *interface;                 /* address of ours for everything */
    uint16_t port, data_port, robots_port; /* 0: any */
    const char *group;                     /* NULL: unicast */
    uint8_t version[2];                    /* of NatNet, as natnet_server_speaks() it */
    bool y_up;
    bool quiet; /* does not tell of clients on stderr */
};

enum arena_end { ARENA_DONE, ARENA_FAILED, ARENA_REFUSED };

/* Tells its addresses on stdout, and runs until SIGTERM or SIGINT comes. Lines on stdin are
 * commands (cameras.h). Words in `error` unless it is done. */
enum arena_end arena_run(const struct arena_options *options, char *error, size_t room);

#endif
