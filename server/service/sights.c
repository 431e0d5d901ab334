#include "sights.h"

#include <stdio.h>
#include <stdlib.h>

struct sights {
    const struct sights_owner *owner;
    size_t count;
    struct tracker_body *bodies;
    struct tracker *tracker;
    struct source_owner from_source;
    struct source *source;
};

static void on_frame(void *context, const struct capture_frame *frame, int64_t arrival_us)
{
    struct sights *s = context;

    if (tracker_take(s->tracker, frame, arrival_us) == 0)
        return;
    for (size_t i = 0; i < s->count; i++) {
        const struct tracker_view *view = tracker_look(s->tracker, i);
        struct job_pose pose = {view->x, view->y, view->theta, view->measured_us};

        if (view->fresh)
            s->owner->seen(s->owner->context, i, &pose);
    }
}

static void on_words(void *context, bool problem, const char *words)
{
    struct sights *s = context;

    (void)problem;
    s->owner->say(s->owner->context, words);
}

static bool build(struct sights *s, const struct site *site)
{
    void *memory = malloc(tracker_footprint(s->count));

    s->bodies = calloc(s->count, sizeof *s->bodies);
    if (memory == NULL || s->bodies == NULL) {
        free(memory);
        return false;
    }
    for (size_t i = 0; i < s->count; i++) {
        const struct site_robot *robot = &site->robots[i];

        s->bodies[i] = (struct tracker_body){robot->name, robot->body, robot->heading};
    }
    s->tracker = tracker_init(memory, &site->tracker, s->bodies, s->count);
    return true;
}

struct sights *sights_open(struct loop *loop, const struct site *site,
                           const struct sights_owner *owner, char *error, size_t room)
{
    struct sights *s = calloc(1, sizeof *s);

    if (s == NULL) {
        snprintf(error, room, "no memory");
        return NULL;
    }
    s->owner = owner;
    s->count = site->robot_count;
    s->from_source = (struct source_owner){s, on_frame, on_words};
    if (!build(s, site))
        snprintf(error, room, "no memory");
    else
        s->source = source_open(loop, &site->mocap, &s->from_source, error, room);
    if (s->source != NULL)
        return s;
    sights_close(s);
    return NULL;
}

void sights_tick(struct sights *sights, int64_t now_us)
{
    source_tick(sights->source, now_us);
}

void sights_close(struct sights *sights)
{
    if (sights == NULL)
        return;
    if (sights->source != NULL)
        source_close(sights->source);
    free(sights->tracker);
    free(sights->bodies);
    free(sights);
}
