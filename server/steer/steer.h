/* steer.h: what those who look on want of a fleet, put to the server core. */
#ifndef STEER_H
#define STEER_H

#include "act.h"
#include "drawings.h"

struct steer {
    const struct scenario *scenario;
    struct server *server;
    struct drawings *drawings; /* of this scenario */
};

#define STEER_WORDS_MAX FORMATION_WORDS_MAX

enum steer_end {
    STEER_DONE,    /* the core has reports and orders about it */
    STEER_REFUSED, /* `words` say why; nothing was done */
    STEER_OTHER,   /* is nothing that the core can do by itself: whoever runs the fleet may */
};

enum steer_end steer(const struct steer *steer, const struct act *act, char words[STEER_WORDS_MAX]);

/* The index of the robot with this id, SERVER_NOBODY with words when there is none. */
size_t steer_robot(const struct scenario *scenario, uint16_t id, char words[STEER_WORDS_MAX]);

#endif
