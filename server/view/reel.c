#include "reel.h"

#include <stdlib.h>
#include <string.h>

#define EVENTS_SHARE 8
#define SCENES_AT_LEAST 2

struct kept {
    uint32_t number;
    int32_t time_ms;
    size_t count;     /* bytes of the message */
    uint8_t record[]; /* its head, the message, zeros */
};

/* Messages of one kind, in the order of their numbers. */
struct strand {
    struct kept **kept;
    size_t count, room;
    size_t bytes, limit;
    size_t largest;
    uint32_t next;   /* number */
    uint32_t stride; /* scenes: numbers that are multiples of it are kept */
};

struct reel {
    struct strand scenes, events;
};

struct reel *reel_open(size_t bytes)
{
    struct reel *reel = calloc(1, sizeof *reel);

    if (reel == NULL)
        return NULL;
    reel->events.limit = bytes / EVENTS_SHARE;
    reel->scenes.limit = bytes - reel->events.limit;
    reel->scenes.stride = 1;
    return reel;
}

static void clear(struct strand *strand)
{
    for (size_t i = 0; i < strand->count; i++)
        free(strand->kept[i]);
    free(strand->kept);
}

void reel_close(struct reel *reel)
{
    if (reel == NULL)
        return;
    clear(&reel->scenes);
    clear(&reel->events);
    free(reel);
}

/* ---- keeping --------------------------------------------------------------------------- */

static size_t record_bytes(size_t count)
{
    return (REEL_HEAD + count + 7) & ~(size_t)7;
}

static size_t cost(const struct kept *kept)
{
    return sizeof *kept + record_bytes(kept->count) + sizeof kept;
}

static void put_u32(uint8_t *bytes, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        bytes[i] = (uint8_t)(value >> 8 * i);
}

static struct kept *make(enum reel_kind kind, uint32_t number, int32_t time_ms,
                         const uint8_t *message, size_t count)
{
    size_t bytes = record_bytes(count);
    struct kept *kept = malloc(sizeof *kept + bytes);

    if (kept == NULL)
        return NULL;
    *kept = (struct kept){.number = number, .time_ms = time_ms, .count = count};
    memset(kept->record, 0, REEL_HEAD);
    kept->record[0] = (uint8_t)kind;
    put_u32(kept->record + 4, number);
    put_u32(kept->record + 8, (uint32_t)count);
    memcpy(kept->record + REEL_HEAD, message, count);
    memset(kept->record + REEL_HEAD + count, 0, bytes - REEL_HEAD - count);
    return kept;
}

static void drop_last(struct strand *strand)
{
    struct kept *last = strand->kept[--strand->count];

    strand->bytes -= cost(last);
    free(last);
}

static bool append(struct strand *strand, struct kept *kept)
{
    if (strand->count == strand->room) {
        size_t room = strand->room == 0 ? 1024 : strand->room * 2;
        struct kept **larger = realloc(strand->kept, room * sizeof(struct kept *));

        if (larger == NULL)
            return false;
        strand->kept = larger;
        strand->room = room;
    }
    strand->kept[strand->count++] = kept;
    strand->bytes += cost(kept);
    if (record_bytes(kept->count) > strand->largest)
        strand->largest = record_bytes(kept->count);
    return true;
}

/* Every other one; not the newest. */
static void thin(struct strand *scenes)
{
    size_t count = 0;

    scenes->stride *= 2;
    scenes->bytes = 0;
    for (size_t i = 0; i < scenes->count; i++) {
        struct kept *kept = scenes->kept[i];

        if (kept->number % scenes->stride != 0 && i + 1 < scenes->count) {
            free(kept);
            continue;
        }
        scenes->kept[count++] = kept;
        scenes->bytes += cost(kept);
    }
    scenes->count = count;
}

static void forget_older_half(struct strand *events)
{
    size_t gone = events->count / 2;

    for (size_t i = 0; i < gone; i++) {
        events->bytes -= cost(events->kept[i]);
        free(events->kept[i]);
    }
    events->count -= gone;
    memmove(events->kept, events->kept + gone, events->count * sizeof *events->kept);
}

/* The newest scene is there whatever its number is; when it is the newest no more, it may go. */
static bool gives_way(const struct strand *scenes, int32_t time_ms)
{
    const struct kept *last = scenes->count > 0 ? scenes->kept[scenes->count - 1] : NULL;

    return last != NULL && (last->time_ms == time_ms || last->number % scenes->stride != 0);
}

bool reel_add(struct reel *reel, enum reel_kind kind, int32_t time_ms, const uint8_t *message,
              size_t count)
{
    struct strand *strand = kind == REEL_SCENE ? &reel->scenes : &reel->events;
    struct kept *kept = make(kind, strand->next, time_ms, message, count);

    strand->next++;
    if (kept == NULL)
        return false;
    if (kind == REEL_SCENE && gives_way(strand, time_ms))
        drop_last(strand);
    if (!append(strand, kept)) {
        free(kept);
        return false;
    }
    while (kind == REEL_SCENE && strand->bytes > strand->limit && strand->count > SCENES_AT_LEAST)
        thin(strand);
    while (kind == REEL_EVENT && strand->bytes > strand->limit && strand->count > 1)
        forget_older_half(strand);
    return true;
}

/* ---- reading --------------------------------------------------------------------------- */

/* The first whose number is at least `number`; the count where there is none. */
static size_t index_of(const struct strand *strand, uint32_t number)
{
    size_t low = 0;
    size_t high = strand->count;

    while (low < high) {
        size_t middle = low + (high - low) / 2;

        if (strand->kept[middle]->number < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static struct reel_message message_of(const struct kept *kept)
{
    return (struct reel_message){
        .number = kept->number,
        .time_ms = kept->time_ms,
        .bytes = kept->record + REEL_HEAD,
        .count = kept->count,
    };
}

bool reel_newest(const struct reel *reel, struct reel_message *message)
{
    const struct strand *scenes = &reel->scenes;

    if (scenes->count == 0)
        return false;
    *message = message_of(scenes->kept[scenes->count - 1]);
    return true;
}

bool reel_event(const struct reel *reel, uint32_t number, struct reel_message *message)
{
    size_t i = index_of(&reel->events, number);

    if (i == reel->events.count)
        return false;
    *message = message_of(reel->events.kept[i]);
    return true;
}

/* Of [first, end) the last ones that fit. Returns where they begin. */
static size_t last_that_fit(const struct strand *strand, size_t first, size_t end, size_t room)
{
    size_t at = end;

    while (at > first && record_bytes(strand->kept[at - 1]->count) <= room) {
        at--;
        room -= record_bytes(strand->kept[at]->count);
    }
    return at;
}

static size_t copy(const struct strand *strand, size_t first, size_t end, uint8_t *bytes)
{
    size_t used = 0;

    for (size_t i = first; i < end; i++) {
        size_t count = record_bytes(strand->kept[i]->count);

        memcpy(bytes + used, strand->kept[i]->record, count);
        used += count;
    }
    return used;
}

static void leave_gap(struct reel_place *place, uint32_t from, uint32_t to)
{
    if (place->gaps == REEL_GAPS)
        place->gap[REEL_GAPS - 1].to = to;
    else
        place->gap[place->gaps++] = (struct reel_gap){from, to};
}

static size_t take_news(const struct strand *strand, struct reel_place *place, uint8_t *bytes,
                        size_t room)
{
    size_t first = index_of(strand, place->next);
    size_t from = last_that_fit(strand, first, strand->count, room);

    if (from == strand->count)
        return 0;
    if (from > first)
        leave_gap(place, place->next, strand->kept[from]->number);
    place->next = strand->kept[strand->count - 1]->number + 1;
    return copy(strand, from, strand->count, bytes);
}

static size_t fill_gap(const struct strand *strand, struct reel_place *place, uint8_t *bytes,
                       size_t room)
{
    while (place->gaps > 0) {
        struct reel_gap *gap = &place->gap[place->gaps - 1];
        size_t first = index_of(strand, gap->from);
        size_t end = index_of(strand, gap->to);
        size_t from = last_that_fit(strand, first, end, room);

        if (first == end) {
            place->gaps--;
            continue;
        }
        if (from < end)
            gap->to = strand->kept[from]->number;
        return copy(strand, from, end, bytes);
    }
    return 0;
}

/* Two of the largest: so news of one kind leave room for the other. */
size_t reel_room(const struct reel *reel)
{
    return 2 * (reel->scenes.largest + reel->events.largest);
}

size_t reel_take(const struct reel *reel, struct reel_reader *reader, uint8_t *bytes, size_t room)
{
    size_t used = take_news(&reel->events, &reader->events, bytes, room / 2);

    used += take_news(&reel->scenes, &reader->scenes, bytes + used, room - used);
    used += fill_gap(&reel->events, &reader->events, bytes + used, room - used);
    used += fill_gap(&reel->scenes, &reader->scenes, bytes + used, room - used);
    return used;
}
