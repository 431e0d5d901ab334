/* play.h: a server and a world in little, for one robot: what it is sent, period by period, and
 * where its wheels carry it. */
#ifndef PLAY_H
#define PLAY_H

#include "message.h"
#include "robot.h"

#include <stddef.h>

#define PLAY_ROBOT 3

/* The period in which the mission is sent. */
#define PLAY_MISSION 1

struct play {
    bool candidate; /* the robot is one, and is given the trajectory */
    uint32_t state; /* of what is random: losses, flipped bits, what the others do */
    unsigned period;
    uint8_t sequence; /* of the next ordered message */
    int32_t knot_time;
    double x, y, theta; /* of the robot: m, rad */
    uint8_t bytes[256];
    size_t count;
    size_t room;
};

void play_begin(struct play *play, bool candidate, uint32_t seed);

/* The bytes of the next period are then in play->bytes. */
void play_next(struct play *play, const struct link_timing *timing);

/* The robot has driven for a period with these set-points. */
void play_drive(struct play *play, int16_t left, int16_t right);

#endif
