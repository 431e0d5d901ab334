#include "steer.h"

#include <stdio.h>
#include <string.h>

/* ---- robots ---------------------------------------------------------------------------- */

/* "1 to 4", or some of them where they are not in a row. */
static void name_robots(const struct scenario *scenario, char *words, size_t room)
{
    const struct scenario_robot *robots = scenario->robots;
    size_t count = scenario->robot_count;
    size_t row = 1, used = 0;

    while (row < count && robots[row].id == robots[0].id + row)
        row++;
    if (count > 2 && row == count) {
        snprintf(words, room, "%u to %u", robots[0].id, robots[count - 1].id);
        return;
    }
    for (size_t i = 0; i < count && i < 8; i++)
        used +=
            (size_t)snprintf(words + used, room - used, "%s%u", i > 0 ? ", " : "", robots[i].id);
    if (count > 8)
        snprintf(words + used, room - used, " and %zu more", count - 8);
}

size_t steer_robot(const struct scenario *scenario, uint16_t id, char words[STEER_WORDS_MAX])
{
    char robots[128];

    for (size_t i = 0; i < scenario->robot_count; i++)
        if (scenario->robots[i].id == id)
            return i;
    name_robots(scenario, robots, sizeof robots);
    snprintf(words, STEER_WORDS_MAX, "robot %u is not in this scenario: it has %s", id, robots);
    return SERVER_NOBODY;
}

static enum steer_end act_on(const struct steer *steer, uint16_t robot, enum event_action action,
                             char words[STEER_WORDS_MAX])
{
    struct event event = {.action = action, .robot = robot};

    if (steer_robot(steer->scenario, robot, words) == SERVER_NOBODY)
        return STEER_REFUSED;
    server_act(steer->server, &event);
    return STEER_DONE;
}

/* ---- formations ------------------------------------------------------------------------ */

static enum steer_end take_formation(const struct steer *steer, const char *name,
                                     char words[STEER_WORDS_MAX])
{
    struct event event = {.action = EVENT_FORMATION};

    if (!drawings_find(steer->drawings, name, &event.formation)) {
        snprintf(words, STEER_WORDS_MAX, "no formation is called '%s'", name);
        return STEER_REFUSED;
    }
    server_act(steer->server, &event);
    return STEER_DONE;
}

static enum steer_end draw(const struct steer *steer, const struct act *act,
                           char words[STEER_WORDS_MAX])
{
    char name[SCENE_NAME_MAX];
    double L[ACT_VERTICES_MAX], psi[ACT_VERTICES_MAX];
    struct scenario_formation formation = {name, act->count, L, psi};

    memcpy(name, act->name, sizeof name);
    memcpy(L, act->L, sizeof L);
    memcpy(psi, act->psi, sizeof psi);
    return drawings_draw(steer->drawings, steer->server, &formation, words) ? STEER_DONE
                                                                            : STEER_REFUSED;
}

/* ---- all of them ----------------------------------------------------------------------- */

enum steer_end steer(const struct steer *steer, const struct act *act, char words[STEER_WORDS_MAX])
{
    switch (act->kind) {
    case ACT_KILL: return act_on(steer, act->robot, EVENT_KILL, words);
    case ACT_REVIVE: return act_on(steer, act->robot, EVENT_REVIVE, words);
    case ACT_STALL: return act_on(steer, act->robot, EVENT_STALL, words);
    case ACT_MUTE: return act_on(steer, act->robot, EVENT_MUTE, words);
    case ACT_UNMUTE: return act_on(steer, act->robot, EVENT_UNMUTE, words);
    case ACT_DRAIN: return act_on(steer, act->robot, EVENT_DRAIN, words);
    case ACT_FORMATION: return take_formation(steer, act->name, words);
    case ACT_DRAW: return draw(steer, act, words);
    case ACT_ESTOP: server_act(steer->server, &(struct event){.action = EVENT_ESTOP}); break;
    default: return STEER_OTHER;
    }
    return STEER_DONE;
}
