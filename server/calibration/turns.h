/* turns.h: which robots may drive at a time, and where: what a calibration's jobs share.
 *
 * Pure. A robot drives within DRIVE_ROOM of where it begins; nobody else is in there, and it is
 * within the fence. */
#ifndef TURNS_H
#define TURNS_H

#include "drive.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Robots that stand are at least so far from where one begins that drives, m. */
#define TURNS_CLEAR (DRIVE_ROOM + 0.1)

/* Robots that drive at the same time begin at least so far apart, m. */
#define TURNS_APART (2 * DRIVE_ROOM + 0.2)

struct turns_place {
    uint16_t id;
    bool seen; /* ever; then it is, or has begun to drive, at */
    double x, y;
    bool drives;
};

struct turns {
    bool together; /* those that are far enough apart drive at the same time; else one by one */
    bool fenced;
    double fence[4]; /* x_min, y_min, x_max, y_max, m */
    size_t count;
    struct turns_place *place;
};

/* Where motion capture sees it. */
void turns_see(struct turns *turns, size_t robot, double x, double y);

enum turn {
    TURN_TAKEN, /* it drives, until turns_leave() */
    TURN_LATER,
    TURN_NEVER, /* from where it stands */
};

/* Asks for a robot that has been seen; `words` say why not now. */
enum turn turns_take(struct turns *turns, size_t robot, char *words, size_t room);

/* False, and `words` say who, when another one stands where this one needs room. To be asked while
 * it drives, too: people carry robots about. */
bool turns_is_clear(const struct turns *turns, size_t robot, char *words, size_t room);

void turns_leave(struct turns *turns, size_t robot);

#endif
