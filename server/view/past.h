/* past.h: what is kept of a run for those who look at it: scenes and events, in bounded memory.
 *
 * When there is no room for more, every other scene is dropped, and from then on half as many are
 * kept: all of a run stays there, coarser. Of the events the older half is dropped. The newest of
 * both is always there. Kept are records as the page gets them (docs/VIEWING.md). */
#ifndef PAST_H
#define PAST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* As a record says it. */
enum past_kind {
    PAST_SCENE = 1,
    PAST_EVENT = 2,
};

#define PAST_HEAD 12 /* bytes of a record before its message */
#define PAST_GAPS 16

struct past;

/* Keeps records of so many bytes, an eighth of it events. NULL: no memory. */
struct past *past_open(size_t bytes);
void past_close(struct past *past);

/* A scene of the same mission time as the one before takes its place. False: no memory, it is not
 * kept. */
bool past_add(struct past *past, enum past_kind kind, int32_t time_ms, const uint8_t *message,
              size_t count);

/* Good until the next past_add(). */
struct past_message {
    uint32_t number; /* counts all that were added, kept or not */
    int32_t time_ms;
    const uint8_t *bytes;
    size_t count;
};

/* The newest scene. False: there is none. */
bool past_newest(const struct past *past, struct past_message *message);

/* The first event kept whose number is at least `number`. */
bool past_event(const struct past *past, uint32_t number, struct past_message *message);

/* What somebody has read so far; begins as zeros. Numbers that came faster than he took them are
 * gaps, which are filled later. */
struct past_place {
    struct past_gap {
        uint32_t from, to; /* to: the first behind it */
    } gap[PAST_GAPS];      /* in order; where there are more, the last ones become one */
    size_t gaps;
    uint32_t next;
};

struct past_reader {
    struct past_place scenes, events;
};

/* The least room that past_take() needs. */
size_t past_room(const struct past *past);

/* Copies records that the reader has not got: the newest ones, and when there are none, those of
 * the last gap, from its end. Returns the bytes, 0: he has got all. */
size_t past_take(const struct past *past, struct past_reader *reader, uint8_t *bytes, size_t room);

#endif
