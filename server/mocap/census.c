#include "census.h"

#include <string.h>

static bool is(const struct census_body *known, const struct capture_body *body)
{
    return known->id == body->id && strcmp(known->name, body->name) == 0;
}

/* Systems speak of their bodies in the same order every time, so the guess is mostly right. */
static struct census_body *find(struct census *census, const struct capture_body *body,
                                size_t guess)
{
    if (guess < census->count && is(&census->body[guess], body))
        return &census->body[guess];
    for (size_t i = 0; i < census->count; i++)
        if (is(&census->body[i], body))
            return &census->body[i];
    if (census->count == CAPTURE_BODIES_MAX)
        return NULL;

    struct census_body *fresh = &census->body[census->count++];
    memcpy(fresh->name, body->name, sizeof fresh->name);
    fresh->id = body->id;
    return fresh;
}

static void widen(int64_t *gap_us, int64_t since_us, int64_t now_us)
{
    if (now_us - since_us > *gap_us)
        *gap_us = now_us - since_us;
}

static void take_body(struct census_body *known, bool tracked, int64_t arrival_us)
{
    known->frames++;
    known->tracked = tracked;
    if (!tracked)
        return;
    if (known->frames_tracked > 0)
        widen(&known->gap_us, known->tracked_us, arrival_us);
    known->frames_tracked++;
    known->tracked_us = arrival_us;
}

void census_take(struct census *census, const struct capture_frame *frame, int64_t arrival_us)
{
    if (census->frames == 0)
        census->first_us = arrival_us;
    else
        widen(&census->gap_us, census->last_us, arrival_us);
    census->frames++;
    census->last_us = arrival_us;
    for (size_t i = 0; i < frame->count; i++) {
        struct census_body *known = find(census, &frame->body[i], i);

        if (known != NULL)
            take_body(known, frame->body[i].tracked, arrival_us);
    }
}

double census_rate(const struct census *census)
{
    int64_t span_us = census->last_us - census->first_us;

    return span_us > 0 ? (double)(census->frames - 1) * 1e6 / (double)span_us : 0;
}

size_t census_tracked(const struct census *census)
{
    size_t count = 0;

    for (size_t i = 0; i < census->count; i++)
        count += census->body[i].tracked;
    return count;
}

void census_print(const struct census *census, FILE *out)
{
    if (census->count > 0)
        fprintf(out, "%-24s %6s %9s %8s %12s\n", "body", "id", "frames", "tracked", "longest gap");
    for (size_t i = 0; i < census->count; i++) {
        const struct census_body *body = &census->body[i];
        char id[16] = "-";

        if (body->id != CAPTURE_ID_NONE)
            snprintf(id, sizeof id, "%ld", (long)body->id);
        fprintf(out, "%-24s %6s %9llu %6.1f %% %9.1f ms\n",
                body->name[0] != '\0' ? body->name : "-", id, (unsigned long long)body->frames,
                100.0 * (double)body->frames_tracked / (double)body->frames,
                (double)body->gap_us / 1e3);
    }
}
