#include "reading.h"

#include "limits.h"

#include <stdlib.h>

static const struct limits position_limits = {-POSITION_MAX_M, POSITION_MAX_M, false, "m"};
static const struct limits heading_limits = {-ANGLE_MAX_RAD, ANGLE_MAX_RAD, false, "rad"};

static bool is_pose(struct refusal *refusal, const struct node *node)
{
    if (!is_kind(refusal, node, NODE_LIST))
        return false;
    return node->count == 3 ||
           refuse(refusal, node->place, "%s holds %zu numbers; [x, y, theta] is allowed",
                  node_title(node), node->count);
}

bool pose_read(struct refusal *refusal, const struct node *node, size_t index, double pose[3])
{
    if (!is_pose(refusal, node))
        return false;

    const struct node *x = node->first, *y = x->next, *theta = y->next;
    return number_read(refusal, x, index, &position_limits, &pose[0]) &&
           number_read(refusal, y, index, &position_limits, &pose[1]) &&
           number_read(refusal, theta, index, &heading_limits, &pose[2]);
}

static bool robots_make(struct refusal *refusal, const struct node *node, size_t count,
                        struct scenario *scenario)
{
    scenario->robots = calloc(count, sizeof *scenario->robots);
    scenario->robot_count = count;
    return scenario->robots != NULL || refuse_memory(refusal, node->place);
}

/* One item of the list. */
struct item {
    struct reading *reading;
    struct scenario_robot *robot;
    size_t index; /* from 1 */
};

static bool read_id(struct refusal *refusal, const struct node *node, const struct field *field,
                    void *into)
{
    struct item *item = into;
    uint16_t *position_of = item->reading->position_of;
    int64_t id;

    (void)field;
    if (!integer_read(refusal, node, item->index, 1, ROBOT_ID_MAX, &id))
        return false;
    if (position_of[id] != 0)
        return refuse(refusal, node->place, "two robots with the id %d; each has its own", (int)id);
    position_of[id] = (uint16_t)item->index;
    item->robot->id = (uint16_t)id;
    return true;
}

static bool read_pose(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    struct item *item = into;
    double pose[3];

    (void)field;
    if (!pose_read(refusal, node, item->index, pose))
        return false;
    item->robot->x = pose[0];
    item->robot->y = pose[1];
    item->robot->theta = pose[2];
    return true;
}

static bool read_candidate(struct refusal *refusal, const struct node *node,
                           const struct field *field, void *into)
{
    return field_bool(refusal, node, field, ((struct item *)into)->robot);
}

static const struct field item_fields[] = {
    {"id", true, read_id, 0, NULL},
    {"pose", true, read_pose, 0, NULL},
    {"candidate", false, read_candidate, offsetof(struct scenario_robot, candidate), NULL},
    {NULL, false, NULL, 0, NULL},
};

static bool read_list(struct refusal *refusal, const struct node *list, struct reading *reading)
{
    struct item item = {reading, NULL, 0};

    if (list->count == 0 || list->count > ROBOT_ID_MAX)
        return refuse(refusal, list->place, "%zu robots; 1 to %u are allowed", list->count,
                      ROBOT_ID_MAX);
    if (!robots_make(refusal, list, list->count, reading->scenario))
        return false;
    for (const struct node *node = list->first; node != NULL; node = node->next) {
        item.robot = &reading->scenario->robots[item.index++];
        if (!mapping_read(refusal, node, item_fields, &item))
            return false;
    }
    return true;
}

static bool read_count(struct refusal *refusal, const struct node *node, const struct field *field,
                       void *into)
{
    struct reading *reading = into;
    int64_t count;

    (void)field;
    if (!integer_read(refusal, node, 0, 1, ROBOT_ID_MAX, &count) ||
        !robots_make(refusal, node, (size_t)count, reading->scenario))
        return false;
    for (int64_t id = 1; id <= count; id++) {
        reading->scenario->robots[id - 1].id = (uint16_t)id;
        reading->position_of[id] = (uint16_t)id;
    }
    return true;
}

/* One of x, y and theta, for all robots: `offset` is its place in a struct scenario_robot. */
static bool read_part(struct refusal *refusal, const struct node *node, const struct limits *limits,
                      struct scenario *scenario, size_t offset)
{
    double *values = calloc(scenario->robot_count, sizeof *values);

    if (values == NULL)
        return refuse_memory(refusal, node->place);
    bool good = is_kind(refusal, node, NODE_SCALAR) &&
                numbers_read(refusal, node, scenario->robot_count, limits, values);
    for (size_t i = 0; i < scenario->robot_count; i++)
        *(double *)((char *)&scenario->robots[i] + offset) = values[i];
    free(values);
    return good;
}

static bool read_poses(struct refusal *refusal, const struct node *node, const struct field *field,
                       void *into)
{
    struct scenario *scenario = ((struct reading *)into)->scenario;

    (void)field;
    if (!is_pose(refusal, node))
        return false;

    const struct node *x = node->first, *y = x->next, *theta = y->next;
    return read_part(refusal, x, &position_limits, scenario, offsetof(struct scenario_robot, x)) &&
           read_part(refusal, y, &position_limits, scenario, offsetof(struct scenario_robot, y)) &&
           read_part(refusal, theta, &heading_limits, scenario,
                     offsetof(struct scenario_robot, theta));
}

static bool add_candidate(struct refusal *refusal, const struct node *node, int64_t id, void *into)
{
    struct scenario_robot *robot = &((struct scenario_robot *)into)[id - 1];

    if (robot->candidate)
        return refuse(refusal, node->place, "robot %d is named twice; once is allowed", (int)id);
    robot->candidate = true;
    return true;
}

static bool read_candidates(struct refusal *refusal, const struct node *node,
                            const struct field *field, void *into)
{
    struct scenario *scenario = ((struct reading *)into)->scenario;

    (void)field;
    return set_read(refusal, node, 1, (int64_t)scenario->robot_count, add_candidate,
                    scenario->robots);
}

static const struct field rule_fields[] = {
    {"count", true, read_count, 0, NULL},
    {"pose", true, read_poses, 0, NULL},
    {"candidates", true, read_candidates, 0, NULL},
    {NULL, false, NULL, 0, NULL},
};

static bool has_candidate(const struct scenario *scenario)
{
    for (size_t i = 0; i < scenario->robot_count; i++) {
        if (scenario->robots[i].candidate)
            return true;
    }
    return false;
}

bool robots_read(struct refusal *refusal, const struct node *node, const struct field *field,
                 void *into)
{
    struct reading *reading = into;

    (void)field;
    if (node->kind == NODE_SCALAR)
        return refuse(refusal, node->place,
                      "robots is a single value; a list of {id, pose, candidate} or a rule "
                      "{count, pose, candidates} is allowed");
    bool read = node->kind == NODE_LIST ? read_list(refusal, node, reading)
                                        : mapping_read(refusal, node, rule_fields, reading);
    if (!read)
        return false;
    return has_candidate(reading->scenario) ||
           refuse(refusal, node->place,
                  "no robot may lead; at least one with candidate: true is allowed");
}
