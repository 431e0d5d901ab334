/* mission.h: what the server has told this robot to do, message by message, in order. */
#ifndef MISSION_H
#define MISSION_H

#include "formation.h"
#include "message.h"
#include "trajectory.h"

struct mission {
    uint8_t number;   /* 0 = none */
    uint8_t expected; /* sequence number of the next ordered message */
    bool refused;     /* asked for what this robot cannot do */
    struct message_mission parameters;
    uint16_t assigned; /* vertex to hold when the host allocates; 0 = none */

    /* The formation in force. While another one arrives its number is 0. */
    struct formation formation;
    uint8_t arriving; /* its number */
    uint16_t arrived; /* vertices of it so far */

    /* The newest knots of the trajectory, a ring; times rise by 1..KNOT_SPACING_MAX_MS. */
    uint8_t knots;  /* held */
    uint8_t newest; /* index of the last one */
    struct knot knot[KNOTS_MAX];
};

enum mission_change {
    MISSION_SAME,  /* not the expected message, or nothing that changes what to do */
    MISSION_BEGUN, /* another mission: all that was known of the old one is void */
    MISSION_TOLD,  /* a message in order; it wants an acknowledgement */
};

/* Takes a MISSION, VERTICES, KNOT or ASSIGN message. */
enum mission_change mission_take(struct mission *mission, const struct message *message);

/* The reference at `time`. Before the first knot it stands there; after the last it goes on as
 * reference_after() says. False when there is no knot. */
bool mission_reference(const struct mission *mission, int32_t time, struct reference *reference);

#endif
