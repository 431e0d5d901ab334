/* cable.h: what lies between `muster serve` and one robot, and how it is spoiled: bytes pass both
 * ways until it is pulled, with noise among them on demand. */
#ifndef CABLE_H
#define CABLE_H

#include "loop.h"

#include <stddef.h>

enum cable_kind {
    CABLE_NONE, /* the server dials the robot's own pty; noise comes from one more who has it open
                 */
    CABLE_TCP,
    CABLE_PTY,
};

enum cable_way { TO_SERVER, TO_ROBOT };

struct cable {
    enum cable_kind kind;
    struct loop *loop;
    struct watch listener; /* tcp: where the server dials */
    struct watch server;   /* the server's end */
    struct watch robot;    /* the robot's end: its TCP port, or one more who has its pty open */
    int slave;             /* pty: kept open while nobody else has it; -1: none */
    uint16_t robot_port;
    char path[100];  /* pty: the symbolic link that the server opens */
    char link[128];  /* as a site file takes it */
    size_t noise[2]; /* bytes still to come, by the way that they go */
    uint32_t random;
};

/* `directory`: of the ptys' symbolic links. The test fails when it cannot be had. */
void cable_open(struct cable *cable, struct loop *loop, enum cable_kind kind, const char *directory,
                unsigned id, uint16_t robot_port);

/* Both ends feel it: TCP is reset, a pty is gone. */
void cable_pull(struct cable *cable);

/* A server may dial again. */
void cable_plug(struct cable *cable);

/* So many random bytes go this way, as fast as they are taken, among what passes. */
void cable_noise(struct cable *cable, enum cable_way way, size_t bytes);

void cable_close(struct cable *cable);

#endif
