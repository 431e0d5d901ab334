/* upload.h: the messages that one robot must get, in order, and what it has acknowledged.
 *
 * Go-back-N with numbers modulo 256: what is not acknowledged UPLOAD_PATIENCE_TICKS after it
 * was sent is sent again from the first one missing. Items are names; their bytes are made when
 * they are sent. */
#ifndef UPLOAD_H
#define UPLOAD_H

#include <stdbool.h>
#include <stdint.h>

#define UPLOAD_WINDOW 32         /* sent and not acknowledged, at most */
#define UPLOAD_PATIENCE_TICKS 10 /* 200 ms */

enum upload_kind { UPLOAD_MISSION, UPLOAD_VERTICES, UPLOAD_KNOT, UPLOAD_ASSIGN };

struct upload_item {
    uint8_t kind;
    uint8_t formation; /* vertices: the formation's number */
    uint32_t index;    /* vertices: the first; knot: which; assign: the vertex */
};

struct upload {
    uint8_t acknowledged, next, end; /* sequence numbers */
    uint8_t waited;                  /* ticks without progress */
    bool taken;                      /* the mission message is acknowledged */
    struct upload_item item[256];    /* by sequence number */
};

/* Starts anew with the mission message as number 0. */
void upload_begin(struct upload *upload);

/* How many more items fit. */
uint8_t upload_room(const struct upload *upload);

/* Appends one; there must be room. */
void upload_add(struct upload *upload, struct upload_item item);

/* The robot expects number `expected` next. False when that is not one that was sent: the
 * robot and this upload do not speak of the same thing. */
bool upload_acknowledge(struct upload *upload, uint8_t expected);

/* Once a tick: runs out of patience when nothing is acknowledged. */
void upload_wait(struct upload *upload);

/* The next item to send, with its sequence number. False when there is none to send now. */
bool upload_next(struct upload *upload, struct upload_item *item, uint8_t *sequence);

/* A part of the formation with this number is not acknowledged yet. */
bool upload_mentions(const struct upload *upload, uint8_t formation);

/* Everything is acknowledged. */
bool upload_done(const struct upload *upload);

#endif
