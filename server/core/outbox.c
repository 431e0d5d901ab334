#include "outbox.h"

#include <string.h>

void outbox_clear(struct outbox *outbox)
{
    outbox->rest_length = 0;
    outbox->head = 0;
    outbox->count = 0;
}

static struct beacon_frame *waiting(struct outbox *outbox, uint8_t place)
{
    return &outbox->beacon[(outbox->head + place) % OUTBOX_BEACONS];
}

void outbox_put_beacon(struct outbox *outbox, const struct beacon_frame *beacon)
{
    for (uint8_t i = 0; i < outbox->count; i++) {
        if (waiting(outbox, i)->sender == beacon->sender) {
            *waiting(outbox, i) = *beacon;
            outbox->dropped++;
            return;
        }
    }
    if (outbox->count == OUTBOX_BEACONS) {
        outbox->dropped++;
        return;
    }
    *waiting(outbox, outbox->count++) = *beacon;
}

static uint8_t copy(struct outbox_room *room, const uint8_t *bytes, uint8_t length)
{
    uint8_t part = length < room->left ? length : (uint8_t)room->left;

    memcpy(room->next, bytes, part);
    room->next += part;
    room->left -= part;
    return part;
}

void outbox_resume(struct outbox *outbox, struct outbox_room *room)
{
    if (outbox->rest_length == 0)
        return;
    uint8_t sent = copy(room, outbox->rest, outbox->rest_length);

    outbox->rest_length -= sent;
    memmove(outbox->rest, outbox->rest + sent, outbox->rest_length);
}

/* The frame stands in an array of `size` bytes. Where there is room for all of it, all of it is
 * copied: a constant size takes two or four moves, its own length a string instruction. */
static inline void send_frame(struct outbox *outbox, struct outbox_room *room, const uint8_t *frame,
                              uint8_t length, size_t size)
{
    outbox->frames++;
    if (room->left >= size) {
        memcpy(room->next, frame, size);
        room->next += length;
        room->left -= length;
        return;
    }
    uint8_t sent = copy(room, frame, length);
    outbox->rest_length = length - sent;
    memcpy(outbox->rest, frame + sent, outbox->rest_length);
}

void outbox_send(struct outbox *outbox, struct outbox_room *room,
                 const uint8_t frame[FRAME_BYTES_MAX], uint8_t length)
{
    send_frame(outbox, room, frame, length, FRAME_BYTES_MAX);
}

void outbox_send_beacons(struct outbox *outbox, struct outbox_room *room)
{
    while (outbox->count > 0 && room->left > 0) {
        const struct beacon_frame *beacon = waiting(outbox, 0);

        send_frame(outbox, room, beacon->bytes, beacon->length, BEACON_FRAME_MAX);
        outbox->head = (outbox->head + 1) % OUTBOX_BEACONS;
        outbox->count--;
    }
    /* Mostly it is empty now: the next ones are put where the cache still is. */
    if (outbox->count == 0)
        outbox->head = 0;
}
