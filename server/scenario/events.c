#include "reading.h"

#include "limits.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One item of `events`. */
struct item {
    struct reading *reading;
    struct event *event;
    const char *action; /* the key that says what happens, NULL until it is found */
};

static bool holds(const void *condition, const struct event_view *view)
{
    const double values[] = {view->t, view->x, view->y, view->theta};
    double value = expression_value(condition, values);

    return isfinite(value) && value != 0;
}

/* The first control tick at or after `at`; what rounding added to a tick's own time is taken off
 * again. */
static int64_t tick_of(double at)
{
    return (int64_t)ceil(at * TICKS_PER_S - 1e-6);
}

static bool read_at(struct refusal *refusal, const struct node *node, const struct field *field,
                    void *into)
{
    struct item *item = into;
    /* A time after the end is none of the file's faults: --set duration may have cut the run. */
    static const struct limits limits = {0, SCENARIO_DURATION_MAX, false, "s"};
    double at;

    (void)field;
    if (!number_read(refusal, node, 0, &limits, &at))
        return false;
    item->event->at_tick = tick_of(at);
    return true;
}

static bool read_when(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    static const char *const names[] = {"t", "leader.x", "leader.y", "leader.theta", NULL};
    static const double unused[EXPRESSION_NAMES_MAX];
    static const struct limits finite = {-DBL_MAX, DBL_MAX, false, ""};
    struct event *event = ((struct item *)into)->event;
    struct expression *condition;

    (void)field;
    if (!expression_read(refusal, node, names, &condition))
        return false;
    event->condition = condition;
    event->when = holds;
    return !expression_is_constant(condition) ||
           value_judge(refusal, node, expression_value(condition, unused), &finite, "");
}

/* An action's reader sets this first, and with it the one action of the event. */
static bool set_action(struct refusal *refusal, const struct node *node, struct item *item,
                       enum event_action action)
{
    if (item->action != NULL)
        return refuse(refusal, node->key->place,
                      "'%s' beside '%s' in one event; one action is allowed", node_title(node),
                      item->action);
    item->action = node_title(node);
    item->event->action = action;
    return true;
}

static bool find_robot(struct refusal *refusal, const struct node *node,
                       const struct reading *reading, int64_t id)
{
    if (reading->position_of[id] != 0)
        return true;
    return refuse(refusal, node->place, "no robot has the id %d; one of the robots' is allowed",
                  (int)id);
}

static bool read_robot(struct refusal *refusal, const struct node *node, struct item *item)
{
    int64_t id;

    if (node->kind == NODE_SCALAR && strcmp(node->text, "leader") == 0) {
        item->event->robot = EVENT_LEADER;
        return true;
    }
    if (!integer_read(refusal, node, 0, 1, ROBOT_ID_MAX, &id) ||
        !find_robot(refusal, node, item->reading, id))
        return false;
    item->event->robot = (uint16_t)id;
    return true;
}

/* The fields of actions carry their enum event_action where field_number() has its offset. */
static bool act_on_robot(struct refusal *refusal, const struct node *node,
                         const struct field *field, void *into)
{
    return set_action(refusal, node, into, (enum event_action)field->offset) &&
           read_robot(refusal, node, into);
}

static bool act_on_network(struct refusal *refusal, const struct node *node,
                           const struct field *field, void *into)
{
    struct item *item = into;

    return set_action(refusal, node, item, (enum event_action)field->offset) &&
           number_read(refusal, node, 0, field->limits, &item->event->value);
}

static bool act_on_all(struct refusal *refusal, const struct node *node, const struct field *field,
                       void *into)
{
    if (!set_action(refusal, node, into, (enum event_action)field->offset))
        return false;
    if (node->kind == NODE_SCALAR && (node->text[0] == '\0' || strcmp(node->text, "true") == 0))
        return true;
    return refuse(refusal, node->place, "%s takes no value; true or nothing is allowed",
                  node_title(node));
}

static bool change_formation(struct refusal *refusal, const struct node *node,
                             const struct field *field, void *into)
{
    struct item *item = into;
    size_t formation;

    if (!set_action(refusal, node, item, (enum event_action)field->offset) ||
        !formation_find(refusal, node, item->reading->scenario, &formation))
        return false;
    item->event->formation = (uint16_t)formation;
    return true;
}

/* A group of a partition that is being filled. */
struct group {
    const struct reading *reading;
    uint16_t *groups;
    uint16_t number;
};

static bool add_to_group(struct refusal *refusal, const struct node *node, int64_t id, void *into)
{
    struct group *group = into;

    if (!find_robot(refusal, node, group->reading, id))
        return false;

    uint16_t *number = &group->groups[group->reading->position_of[id] - 1];
    if (*number != 0)
        return refuse(refusal, node->place, "robot %d is named twice; once is allowed", (int)id);
    *number = group->number;
    return true;
}

/* Groups count from 1; 0 is the group of the robots that are not named. */
static bool partition(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    struct item *item = into;
    struct group group = {item->reading, NULL, 0};

    if (!set_action(refusal, node, item, (enum event_action)field->offset) ||
        !is_kind(refusal, node, NODE_LIST))
        return false;
    group.groups = calloc(item->reading->scenario->robot_count, sizeof *group.groups);
    if (group.groups == NULL)
        return refuse_memory(refusal, node->place);
    item->event->groups = group.groups;
    for (const struct node *part = node->first; part != NULL; part = part->next) {
        if (++group.number == 0)
            return refuse(refusal, part->place, "too many groups; %u are allowed", UINT16_MAX);
        if (!set_read(refusal, part, 1, ROBOT_ID_MAX, add_to_group, &group))
            return false;
    }
    return node->count > 0 ||
           refuse(refusal, node->place, "no group; [[1, 2], [3, 4]] and the like is allowed");
}

static const struct field event_fields[] = {
    {"at", false, read_at, 0, NULL},
    {"when", false, read_when, 0, NULL},
    {"kill", false, act_on_robot, EVENT_KILL, NULL},
    {"revive", false, act_on_robot, EVENT_REVIVE, NULL},
    {"stall", false, act_on_robot, EVENT_STALL, NULL},
    {"drain", false, act_on_robot, EVENT_DRAIN, NULL},
    {"mute", false, act_on_robot, EVENT_MUTE, NULL},
    {"unmute", false, act_on_robot, EVENT_UNMUTE, NULL},
    {"formation", false, change_formation, EVENT_FORMATION, NULL},
    {"loss", false, act_on_network, EVENT_LOSS, &loss_limits},
    {"delay", false, act_on_network, EVENT_DELAY, &delay_limits},
    {"range", false, act_on_network, EVENT_RANGE, &range_limits},
    {"estop", false, act_on_all, EVENT_ESTOP, NULL},
    {"partition", false, partition, EVENT_PARTITION, NULL},
    {"heal", false, act_on_all, EVENT_HEAL, NULL},
    {NULL, false, NULL, 0, NULL},
};

static bool event_read(struct refusal *refusal, const struct node *node, struct item *item)
{
    if (!mapping_read(refusal, node, event_fields, item))
        return false;
    bool at = tree_find(node, "at") != NULL;
    bool when = tree_find(node, "when") != NULL;
    if (at == when)
        return refuse(refusal, node->place,
                      "%s 'at' %s 'when' in one event; one of them is allowed",
                      at ? "both" : "neither", at ? "and" : "nor");
    return item->action != NULL ||
           refuse(refusal, node->place, "nothing happens; one action such as kill is allowed");
}

bool events_read(struct refusal *refusal, const struct node *node, const struct field *field,
                 void *into)
{
    struct reading *reading = into;
    struct scenario *scenario = reading->scenario;

    (void)field;
    if (!is_kind(refusal, node, NODE_LIST))
        return false;
    if (node->count == 0)
        return true;
    scenario->events = calloc(node->count, sizeof *scenario->events);
    if (scenario->events == NULL)
        return refuse_memory(refusal, node->place);
    for (const struct node *part = node->first; part != NULL; part = part->next) {
        struct item item = {reading, &scenario->events[scenario->event_count++], NULL};
        if (!event_read(refusal, part, &item))
            return false;
    }
    return true;
}
