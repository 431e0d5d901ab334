#include "serve_state.h"

#include "limits.h"

#include <math.h>

/* Cameras' frames come a little early or late; they are to be passed on evenly all the same. */
#define JITTER_US 3000

static void see(struct serve *s, size_t robot)
{
    const struct tracker_view *view = tracker_look(s->tracker, robot);
    int64_t age_ms = (s->tick_us - view->measured_us) / 1000;
    struct server_pose pose = {
        .x = view->x,
        .y = view->y,
        .theta = view->theta,
        .tracked = !s->member[robot].withheld && age_ms <= SERVER_POSE_OLD_MS,
        .age_ms = (int16_t)(age_ms < SERVER_POSE_OLD_MS ? age_ms : SERVER_POSE_OLD_MS),
    };

    server_see(s->core, robot, &pose);
}

void pass_flush(struct serve *s, size_t robot, int64_t now_us)
{
    uint8_t bytes[LINK_SEND_MAX];
    size_t room = links_room(s->links, robot, now_us);

    /* A link that takes nothing now gets the newest pose of then. */
    if (room == 0)
        return;
    size_t count = server_take(s->core, robot, bytes, room);
    if (count > 0)
        links_send(s->links, robot, bytes, count);
}

/* Whether a robot gets this pose or waits for a later one: a radio carries only so many. */
static bool is_due(struct member_link *member, int64_t arrival_us)
{
    if (arrival_us - member->sent_us < member->spacing_us - JITTER_US)
        return false;
    member->sent_us = arrival_us;
    return true;
}

void pass_frame(void *serve, const struct capture_frame *frame, int64_t arrival_us)
{
    struct serve *s = serve;

    s->frame_us = arrival_us;
    if (tracker_take(s->tracker, frame, arrival_us) == 0)
        return;
    int64_t now_us = loop_now();
    for (size_t i = 0; i < s->count; i++) {
        if (!tracker_look(s->tracker, i)->fresh)
            continue;
        see(s, i);
        s->member[i].posed_us = now_us;
        if (is_due(&s->member[i], arrival_us))
            pass_flush(s, i, now_us);
    }
    if (s->phase == PHASE_RUN)
        histogram_add(&s->delay, loop_now() - arrival_us);
    tick_chores(s);
}

static void note(struct serve *s, size_t robot, const char *event, const char *words)
{
    if (s->record != NULL)
        record_note(s->record, server_time(s->core), s->scenario->robots[robot].id, event, words);
}

void pass_up(void *serve, size_t robot)
{
    struct serve *s = serve;
    const struct link_view *link = links_look(s->links, robot);

    server_link(s->core, robot, true);
    note(s, robot, "link_up", link->address);
    if (link->words[0] != '\0')
        console_say(&s->console, "robot %u: %s", s->scenario->robots[robot].id, link->words);
}

void pass_down(void *serve, size_t robot, const char *words)
{
    struct serve *s = serve;

    server_link(s->core, robot, false);
    if (s->phase == PHASE_OVER)
        return; /* we close it ourselves */
    note(s, robot, "link_down", words);
    if (s->phase == PHASE_RUN)
        s->links_lost++;
    console_say(&s->console, "robot %u: %s: %s", s->scenario->robots[robot].id,
                links_look(s->links, robot)->address, words);
}

void pass_received(void *serve, size_t robot, const uint8_t *bytes, size_t count)
{
    struct serve *s = serve;

    server_receive(s->core, robot, bytes, count);
}
