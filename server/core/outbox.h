/* outbox.h: what waits for one robot's link.
 *
 * The pose goes first, then what must arrive, then beacons in the order of their arrival. A
 * beacon that still waits is replaced by a newer one of the same sender; what finds no room is
 * dropped. Both are counted. A frame may be cut at the end of a tick: its rest goes first in
 * the next one. */
#ifndef OUTBOX_H
#define OUTBOX_H

#include "frame.h"

#include <stddef.h>
#include <stdint.h>

#define OUTBOX_BEACONS 128
#define BEACON_FRAME_MAX 32

struct beacon_frame {
    uint16_t sender;
    uint8_t length;
    uint8_t bytes[BEACON_FRAME_MAX];
};

struct outbox {
    uint64_t frames, dropped;
    uint8_t rest[FRAME_BYTES_MAX]; /* of a frame that was cut */
    uint8_t rest_length;
    uint8_t head, count;
    struct beacon_frame beacon[OUTBOX_BEACONS];
};

/* The room left on a link in this tick. */
struct outbox_room {
    uint8_t *next;
    size_t left;
};

void outbox_clear(struct outbox *outbox);

void outbox_put_beacon(struct outbox *outbox, const struct beacon_frame *beacon);

/* Sends the rest of a frame that was cut. */
void outbox_resume(struct outbox *outbox, struct outbox_room *room);

/* Sends a frame, or its beginning. Needs room->left > 0; overwrites any of the room. */
void outbox_send(struct outbox *outbox, struct outbox_room *room,
                 const uint8_t frame[FRAME_BYTES_MAX], uint8_t length);

/* Sends beacons while there is room; overwrites any of it. */
void outbox_send_beacons(struct outbox *outbox, struct outbox_room *room);

#endif
