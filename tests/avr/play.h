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

/* What the robot is told to be, and among whom. */
struct play_part {
    bool candidate; /* it is given the trajectory */
    enum motion_law law;
    enum allocation allocation;
    uint8_t vertices; /* of both formations, 5..VERTICES_MAX_CHIP */
    uint8_t others;   /* neighbours besides the leader */
};

/* The paper's law and allocation among six others. */
extern const struct play_part play_candidate, play_follower;

struct play {
    struct play_part part;
    uint32_t state; /* of what is random: losses, flipped bits, what the others do */
    unsigned period;
    uint8_t sequence;  /* of the next ordered message */
    uint8_t formation; /* the last one that was sent, or begun */
    uint8_t placed;    /* vertices of it that were sent */
    int32_t knot_time;
    double x, y, theta; /* of the robot: m, rad */
    uint8_t bytes[256];
    size_t count;
    size_t room;
};

void play_begin(struct play *play, const struct play_part *part, uint32_t seed);

/* The bytes of the next period are then in play->bytes. */
void play_next(struct play *play, const struct link_timing *timing);

/* The robot has driven for a period with these set-points. */
void play_drive(struct play *play, int16_t left, int16_t right);

#endif
