#include "reading.h"

#include "limits.h"
#include "setting.h"
#include "yaml.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the wire carries (fixed.h): narrow for speeds, rate for turning. */
static const struct limits v_limits = {-8.19, 8.19, false, "m/s"};
static const struct limits omega_limits = {-31.9, 31.9, false, "rad/s"};

/* As robots of this kind come from the workshop. */
#define SMALL_SCATTER 0.1

static const struct limits scatter_limits = {0, 0.3, false, ""};
static const struct limits duration_limits = {0, SCENARIO_DURATION_MAX, false, "s"};
static const struct limits gain_limits = {0, 255, true, "1/s"};
static const struct limits v_max_limits = {0, 6, true, "m/s"};
static const struct limits omega_max_limits = {0, 30, true, "rad/s"};

const struct limits range_limits = {0, 10000, false, "m"};
const struct limits loss_limits = {0, 1, false, ""};
const struct limits delay_limits = {0, 10, false, "s"};

bool schema_read(struct refusal *refusal, const struct node *node, const struct field *field,
                 void *into)
{
    int64_t schema;

    (void)field;
    (void)into;
    return integer_read(refusal, node, 0, 1, 1, &schema);
}

bool name_read(struct refusal *refusal, const struct node *node, char **out)
{
    static const char allowed[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";

    if (!is_kind(refusal, node, NODE_SCALAR))
        return false;
    size_t length = strlen(node->text);
    bool first = length > 0 && node->text[0] != '.' && node->text[0] != '-';
    if (!first || length > SCENARIO_NAME_MAX || strspn(node->text, allowed) != length)
        return refuse(refusal, node->place,
                      "name is '%.100s'; 1 to %d letters, digits, '.', '_' and '-' are allowed, "
                      "the first a letter, digit or '_'",
                      node->text, SCENARIO_NAME_MAX);
    *out = strdup(node->text);
    return *out != NULL || refuse_memory(refusal, node->place);
}

static bool read_name(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    (void)field;
    return name_read(refusal, node, &((struct reading *)into)->scenario->name);
}

static bool read_duration(struct refusal *refusal, const struct node *node,
                          const struct field *field, void *into)
{
    return number_read(refusal, node, 0, field->limits,
                       &((struct reading *)into)->scenario->duration);
}

static bool read_body(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    static const char *const choices[] = {"ideal", "small", NULL};
    struct scenario *scenario = ((struct reading *)into)->scenario;
    unsigned choice;

    (void)field;
    if (!choice_read(refusal, node, choices, &choice))
        return false;
    scenario->body = (enum scenario_body)choice;
    scenario->scatter = scenario->body == BODY_SMALL ? SMALL_SCATTER : 0;
    return true;
}

static bool read_scatter(struct refusal *refusal, const struct node *node,
                         const struct field *field, void *into)
{
    struct scenario *scenario = ((struct reading *)into)->scenario;

    if (!number_read(refusal, node, 0, field->limits, &scenario->scatter))
        return false;
    return scenario->scatter == 0 || scenario->body == BODY_SMALL ||
           refuse(refusal, node->place,
                  "scatter is %.10g, but ideal robots are all alike; 0 is allowed, or body: small",
                  scenario->scatter);
}

static bool read_network(struct refusal *refusal, const struct node *node,
                         const struct field *field, void *into)
{
    static const struct field fields[] = {
        {"range", false, field_number, offsetof(struct scenario, range), &range_limits},
        {"loss", false, field_number, offsetof(struct scenario, loss), &loss_limits},
        {"delay", false, field_number, offsetof(struct scenario, delay), &delay_limits},
        {NULL, false, NULL, 0, NULL},
    };

    (void)field;
    return mapping_read(refusal, node, fields, ((struct reading *)into)->scenario);
}

static bool read_allocation(struct refusal *refusal, const struct node *node,
                            const struct field *field, void *into)
{
    static const char *const choices[] = {"cpa", "cpa-literal", "rigid", "optimal", NULL};
    unsigned choice;

    (void)field;
    if (!choice_read(refusal, node, choices, &choice))
        return false;
    ((struct reading *)into)->scenario->allocation = (enum scenario_allocation)choice;
    return true;
}

static bool read_law(struct refusal *refusal, const struct node *node, const struct field *field,
                     void *into)
{
    static const char *const choices[] = {"fl", "kanayama", "pid", NULL};
    unsigned choice;

    (void)field;
    if (!choice_read(refusal, node, choices, &choice))
        return false;
    ((struct scenario *)into)->law = (enum motion_law)choice;
    return true;
}

static bool read_motion(struct refusal *refusal, const struct node *node, const struct field *field,
                        void *into)
{
    static const struct field fields[] = {
        {"law", false, read_law, 0, NULL},
        {"k", false, field_number, offsetof(struct scenario, k), &gain_limits},
        {"k_theta", false, field_number, offsetof(struct scenario, k_theta), &gain_limits},
        {"v_max", false, field_number, offsetof(struct scenario, v_max), &v_max_limits},
        {"omega_max", false, field_number, offsetof(struct scenario, omega_max), &omega_max_limits},
        {NULL, false, NULL, 0, NULL},
    };

    (void)field;
    return mapping_read(refusal, node, fields, ((struct reading *)into)->scenario);
}

/* The trajectory's parts, until they become one. */
struct parts {
    double start[3];
    struct expression *v, *omega;
};

static bool read_start(struct refusal *refusal, const struct node *node, const struct field *field,
                       void *into)
{
    (void)field;
    return pose_read(refusal, node, 0, ((struct parts *)into)->start);
}

static bool read_speed(struct refusal *refusal, const struct node *node, const struct field *field,
                       void *into)
{
    static const char *const names[] = {"t", NULL};

    return expression_read(refusal, node, names,
                           (struct expression **)((char *)into + field->offset));
}

static bool judge_state(struct refusal *refusal, const struct node *node,
                        const struct reference_state *state)
{
    char when[32];

    snprintf(when, sizeof when, " at t = %.10g s", state->t);
    if (!value_judge(refusal, tree_find(node, "v"), state->v, &v_limits, when) ||
        !value_judge(refusal, tree_find(node, "omega"), state->omega, &omega_limits, when))
        return false;
    if (fabs(state->x) <= POSITION_MAX_M && fabs(state->y) <= POSITION_MAX_M)
        return true;
    return refuse(refusal, node->place,
                  "the reference is at (%.10g, %.10g) m%s; positions from %g to %g m are allowed",
                  state->x, state->y, when, -POSITION_MAX_M, POSITION_MAX_M);
}

/* Looks at every control tick up to the first one at or after the end. */
static bool judge_trajectory(struct refusal *refusal, const struct node *node,
                             const struct scenario *scenario)
{
    struct reference_state state = trajectory_start(scenario->trajectory);

    while (judge_state(refusal, node, &state)) {
        if (state.t >= scenario->duration)
            return true;
        state = trajectory_step(scenario->trajectory, &state);
    }
    return false;
}

static bool read_trajectory(struct refusal *refusal, const struct node *node,
                            const struct field *field, void *into)
{
    static const struct field fields[] = {
        {"start", true, read_start, 0, NULL},
        {"v", true, read_speed, offsetof(struct parts, v), NULL},
        {"omega", true, read_speed, offsetof(struct parts, omega), NULL},
        {NULL, false, NULL, 0, NULL},
    };
    struct scenario *scenario = ((struct reading *)into)->scenario;
    struct parts parts = {{0}, NULL, NULL};

    (void)field;
    if (mapping_read(refusal, node, fields, &parts)) {
        scenario->trajectory = trajectory_new(parts.start, parts.v, parts.omega);
        if (scenario->trajectory != NULL)
            return judge_trajectory(refusal, node, scenario);
        refuse_memory(refusal, node->place);
    }
    expression_free(parts.v);
    expression_free(parts.omega);
    return false;
}

static bool read_formation(struct refusal *refusal, const struct node *node,
                           const struct field *field, void *into)
{
    struct scenario *scenario = ((struct reading *)into)->scenario;

    (void)field;
    return formation_find(refusal, node, scenario, &scenario->formation);
}

static const struct field scenario_fields[] = {
    {"schema", true, schema_read, 0, NULL},
    {"name", true, read_name, 0, NULL},
    {"duration", true, read_duration, 0, &duration_limits},
    {"robots", true, robots_read, 0, NULL},
    {"body", false, read_body, 0, NULL},
    {"scatter", false, read_scatter, 0, &scatter_limits},
    {"network", false, read_network, 0, NULL},
    {"trajectory", true, read_trajectory, 0, NULL},
    {"formations", true, formations_read, 0, NULL},
    {"formation", true, read_formation, 0, NULL},
    {"allocation", false, read_allocation, 0, NULL},
    {"motion", false, read_motion, 0, NULL},
    {"events", false, events_read, 0, NULL},
    {NULL, false, NULL, 0, NULL},
};

static struct scenario *scenario_new(void)
{
    struct scenario *scenario = malloc(sizeof *scenario);

    if (scenario != NULL)
        *scenario = (struct scenario){
            .body = BODY_IDEAL,
            .range = 1.0,
            .allocation = ASSIGN_CPA,
            .law = LAW_FL,
            .k = 1.0,
            .k_theta = 3.0,
            .v_max = 4.0,
            .omega_max = 10.0,
        };
    return scenario;
}

size_t scenario_largest(const struct scenario *scenario)
{
    size_t largest = 0;

    for (size_t i = 0; i < scenario->formation_count; i++)
        if (scenario->formations[i].count > largest)
            largest = scenario->formations[i].count;
    return largest;
}

void scenario_free(struct scenario *scenario)
{
    if (scenario == NULL)
        return;
    for (size_t i = 0; i < scenario->event_count; i++) {
        expression_free((struct expression *)scenario->events[i].condition);
        free((void *)scenario->events[i].groups);
    }
    for (size_t i = 0; i < scenario->formation_count; i++) {
        free(scenario->formations[i].name);
        free(scenario->formations[i].L);
        free(scenario->formations[i].psi);
    }
    free(scenario->events);
    free(scenario->formations);
    free(scenario->robots);
    trajectory_free(scenario->trajectory);
    free(scenario->name);
    free(scenario);
}

static struct scenario *scenario_of(struct refusal *refusal, const struct node *root,
                                    size_t vertices_max)
{
    struct reading reading = {
        .scenario = scenario_new(),
        .vertices_max = vertices_max,
        .position_of = calloc(ROBOT_ID_MAX + 1, sizeof *reading.position_of),
    };
    bool good = false;

    if (reading.scenario == NULL || reading.position_of == NULL)
        refuse_memory(refusal, root->place);
    else
        good = mapping_read(refusal, root, scenario_fields, &reading);
    free(reading.position_of);
    if (good)
        return reading.scenario;
    scenario_free(reading.scenario);
    return NULL;
}

static struct scenario *scenario_from(struct refusal *refusal, struct node *root,
                                      const char *const *settings, size_t count,
                                      size_t vertices_max)
{
    struct scenario *scenario = NULL;

    if (root != NULL && settings_apply(root, settings, count, refusal))
        scenario = scenario_of(refusal, root, vertices_max);
    tree_free(root);
    return scenario;
}

struct scenario *scenario_parse(const char *name, const char *text, size_t length,
                                const char *const *settings, size_t setting_count,
                                size_t vertices_max, char *error, size_t room)
{
    struct refusal refusal = {error, room};
    struct node *root = yaml_parse(name, text, length, &refusal);

    return scenario_from(&refusal, root, settings, setting_count, vertices_max);
}

struct scenario *scenario_read(const char *path, const char *const *settings, size_t setting_count,
                               size_t vertices_max, char *error, size_t room)
{
    struct refusal refusal = {error, room};
    struct node *root = yaml_read_file(path, &refusal);

    return scenario_from(&refusal, root, settings, setting_count, vertices_max);
}
