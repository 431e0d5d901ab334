#include "server_state.h"

static size_t index_of(const struct server *s, uint16_t id)
{
    if (id == EVENT_LEADER)
        return s->leader;
    for (size_t i = 0; i < s->config->robot_count; i++)
        if (s->config->robots[i].id == id)
            return i;
    return SERVER_NOBODY;
}

static bool event_holds(const struct server *s, const struct event *event)
{
    if (s->time < 0 || (int64_t)(s->time / TICK_MS) < event->at_tick)
        return false;
    if (event->when == NULL)
        return true;
    if (s->leader == SERVER_NOBODY)
        return false;
    const struct server_pose *pose = &s->member[s->leader].pose;
    struct event_view view = {s->time / 1000.0, pose->x, pose->y, pose->theta};
    return event->when(event->condition, &view);
}

static void set_groups(struct server *s, const uint16_t *groups)
{
    for (size_t i = 0; i < s->config->robot_count; i++)
        s->network.station[i].group = groups == NULL ? 0 : groups[i];
}

/* False when it names a robot that there is not now: the leader, before one is elected. */
static bool carry_out(struct server *s, const struct event *event)
{
    size_t robot = SERVER_NOBODY;

    switch (event->action) {
    case EVENT_KILL:
    case EVENT_REVIVE:
    case EVENT_STALL:
    case EVENT_DRAIN:
        robot = index_of(s, event->robot);
        if (robot == SERVER_NOBODY)
            return false;
        server_add_order(s, event->action, robot);
        break;
    case EVENT_MUTE:
    case EVENT_UNMUTE:
        robot = index_of(s, event->robot);
        if (robot == SERVER_NOBODY)
            return false;
        s->network.station[robot].muted = event->action == EVENT_MUTE;
        break;
    case EVENT_FORMATION: server_take_formation(s, event->formation); break;
    case EVENT_LOSS: s->network.loss = event->value; break;
    case EVENT_DELAY: s->network.delay_ticks = server_ticks_of(event->value); break;
    case EVENT_RANGE: s->network.range = event->value; break;
    case EVENT_ESTOP: server_estop(s); break;
    case EVENT_PARTITION: set_groups(s, event->groups); break;
    case EVENT_HEAL: set_groups(s, NULL); break;
    }
    server_add_report(s, REPORT_EVENT, robot, event->action, 0);
    return true;
}

bool server_act(struct server *s, const struct event *event)
{
    return carry_out(s, event);
}

void events_run(struct server *s)
{
    for (size_t i = 0; i < s->config->event_count; i++)
        if (!s->event_done[i] && event_holds(s, &s->config->events[i]))
            s->event_done[i] = carry_out(s, &s->config->events[i]);
}
