/* reel.h: what is kept of a run for those who look at it: scenes and events, in bounded memory.
 *
 * When there is no room for more, every other scene is dropped, and from then on half as many are
 * kept: all of a run stays there, coarser. Of the events the older half is dropped. The newest of
 * both is always there. Kept are records as the page gets them (docs/VIEWING.md). */
#ifndef REEL_H
#define REEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* As a record says it. */
enum reel_kind {
    REEL_SCENE = 1,
    REEL_EVENT = 2,
};

#define REEL_HEAD 12 /* bytes of a record before its message */
#define REEL_GAPS 16

struct reel;

/* Keeps records of so many bytes, an eighth of it events. NULL: no memory. */
struct reel *reel_open(size_t bytes);
void reel_close(struct reel *reel);

/* A scene of the same mission time as the one before takes its place. False: no memory, it is not
 * kept. */
bool reel_add(struct reel *reel, enum reel_kind kind, int32_t time_ms, const uint8_t *message,
              size_t count);

/* Good until the next reel_add(). */
struct reel_message {
    uint32_t number; /* counts all that were added, kept or not */
    int32_t time_ms;
    const uint8_t *bytes;
    size_t count;
};

/* The newest scene. False: there is none. */
bool reel_newest(const struct reel *reel, struct reel_message *message);

/* The first event kept whose number is at least `number`. */
bool reel_event(const struct reel *reel, uint32_t number, struct reel_message *message);

/* What somebody has read so far; begins as zeros. Numbers that came faster than he took them are
 * gaps, which are filled later. */
struct reel_place {
    struct reel_gap {
        uint32_t from, to; /* to: the first behind it */
    } gap[REEL_GAPS];      /* in order; where there are more, the last ones become one */
    size_t gaps;
    uint32_t next;
};

struct reel_reader {
    struct reel_place scenes, events;
};

/* The least room that reel_take() needs. */
size_t reel_room(const struct reel *reel);

/* Copies records that the reader has not got: the newest ones, and when there are none, those of
 * the last gap, from its end. Returns the bytes, 0: he has got all. */
size_t reel_take(const struct reel *reel, struct reel_reader *reader, uint8_t *bytes, size_t room);

#endif
