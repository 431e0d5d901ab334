/* supervisor.h: may this robot move? A pure function over a table, and the stall detector. */
#ifndef SUPERVISOR_H
#define SUPERVISOR_H

#include "fixed.h"
#include "message.h"

#include <stdbool.h>
#include <stdint.h>

enum supervisor_condition {
    HAS_ID = 1,
    HAS_MISSION = 2,
    STARTED = 4, /* mission time is 0 or later */
    POSE_FRESH = 8,
    LINK_UP = 16,
    ESTOPPED = 32,
    DRIVEN = 64, /* MESSAGE_DRIVE comes */
    SPENT = 128, /* so is the battery, and nobody waits for this robot */
};

/* The oldest pose and the longest silence that are not a fault. */
#define POSE_STALE_TICKS 15 /* 300 ms */
#define LINK_LOST_TICKS 25  /* 500 ms */

/* How long the wheels turn as the last MESSAGE_DRIVE says. */
#define DRIVE_TICKS 10 /* 200 ms */

/* The state that follows `state` under `conditions` (a set of enum supervisor_condition). */
enum supervisor_state supervisor_next(enum supervisor_state state, uint8_t conditions);

/* Commanded over 50 mm/s for 500 ms, and in that time moved under 10 mm and turned under 1/32
 * turn: something holds the robot. Raised until it moves or turns that far again. */
struct stall {
    struct pose anchor;
    uint8_t ticks; /* since it was there */
    bool raised;
};

#define STALL_SPEED (NARROW_PER_M / 20)     /* 50 mm/s */
#define STALL_DISTANCE (NARROW_PER_M / 100) /* 10 mm */
#define STALL_TURN (ANGLE_TURN / 32)
#define STALL_TICKS 25 /* 500 ms */

/* Once a tick, with the measured pose and the speed commanded (narrow). */
void stall_watch(struct stall *stall, const struct pose *pose, int16_t v);

#endif
