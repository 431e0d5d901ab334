#include "newest.h"

#include <string.h>

static bool same_body(const struct capture_body *a, const struct capture_body *b)
{
    return a->id == b->id && strcmp(a->name, b->name) == 0;
}

/* Systems tell their bodies in the same order, so the first look mostly finds. */
static bool speaks_of(const struct capture_frame *frame, const struct capture_body *body,
                      size_t guess)
{
    if (guess < frame->count && same_body(&frame->body[guess], body))
        return true;
    for (size_t i = 0; i < frame->count; i++)
        if (same_body(&frame->body[i], body))
            return true;
    return false;
}

static bool covers(const struct capture_frame *later, const struct capture_frame *earlier)
{
    if (later->count < earlier->count)
        return false;
    for (size_t i = 0; i < earlier->count; i++)
        if (!speaks_of(later, &earlier->body[i], i))
            return false;
    return true;
}

struct capture_frame *newest_blank(struct newest *newest)
{
    return &newest->frames[newest->blank];
}

const struct capture_frame *newest_hold(struct newest *newest, int64_t arrival_us)
{
    struct capture_frame *filled = &newest->frames[newest->blank];
    struct capture_frame *held = &newest->frames[1 - newest->blank];
    bool was_holding = newest->holding;

    newest->blank = 1 - newest->blank;
    newest->holding = true;
    newest->displaced_us = newest->arrival_us;
    newest->arrival_us = arrival_us;
    if (!was_holding)
        return NULL;
    if (!covers(filled, held))
        return held;
    newest->skipped++;
    return NULL;
}

const struct capture_frame *newest_release(struct newest *newest)
{
    if (!newest->holding)
        return NULL;
    newest->holding = false;
    return &newest->frames[1 - newest->blank];
}
