#include "reading.h"

#include "limits.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define VERTEX_SPACING_M 0.010

static const struct limits L_limits = {-2000, 2000, false, "m"};
static const struct limits psi_limits = {-ANGLE_MAX_RAD, ANGLE_MAX_RAD, false, "rad"};

/* One member of `formations`. */
struct entry {
    struct reading *reading;
    struct scenario_formation *formation;
};

static bool formation_make(struct refusal *refusal, const struct node *node, size_t count,
                           const struct entry *entry)
{
    struct scenario_formation *formation = entry->formation;
    size_t robots = entry->reading->scenario->robot_count;

    if (count == 0)
        return refuse(refusal, node->place, "no vertex; the leader's at least is needed");
    if (count > robots)
        return refuse(refusal, node->place,
                      "more vertices than robots: %zu for %zu; as many or fewer are allowed", count,
                      robots);
    if (count > entry->reading->vertices_max)
        return refuse(refusal, node->place, "%zu vertices; the robots have room for %zu", count,
                      entry->reading->vertices_max);
    formation->count = count;
    formation->L = calloc(count, sizeof *formation->L);
    formation->psi = calloc(count, sizeof *formation->psi);
    return (formation->L != NULL && formation->psi != NULL) || refuse_memory(refusal, node->place);
}

static bool read_count(struct refusal *refusal, const struct node *node, const struct field *field,
                       void *into)
{
    int64_t count;

    (void)field;
    return integer_read(refusal, node, 0, 1, ROBOT_ID_MAX, &count) &&
           formation_make(refusal, node, (size_t)count, into);
}

/* Without a count the list L tells how many vertices there are. */
static bool read_L(struct refusal *refusal, const struct node *node, const struct field *field,
                   void *into)
{
    struct entry *entry = into;

    if (entry->formation->count == 0) {
        if (node->kind != NODE_LIST)
            return refuse(refusal, node->place,
                          "L is no list, and there is no count; L: [...] or count: N is allowed");
        if (!formation_make(refusal, node, node->count, entry))
            return false;
    }
    return numbers_read(refusal, node, entry->formation->count, field->limits, entry->formation->L);
}

static bool read_psi(struct refusal *refusal, const struct node *node, const struct field *field,
                     void *into)
{
    struct entry *entry = into;

    return numbers_read(refusal, node, entry->formation->count, field->limits,
                        entry->formation->psi);
}

static const struct field formation_fields[] = {
    {"count", false, read_count, 0, NULL},
    {"L", true, read_L, 0, &L_limits},
    {"psi", true, read_psi, 0, &psi_limits},
    {NULL, false, NULL, 0, NULL},
};

static bool judge_leader(struct refusal *refusal, const struct node *node,
                         const struct scenario_formation *formation)
{
    size_t first = 0;

    for (size_t i = 0; i < formation->count; i++) {
        if (formation->L[i] != 0)
            continue;
        if (first != 0)
            return refuse(refusal, node->place,
                          "vertices %zu and %zu both have L = 0; one, the leader's, is allowed",
                          first, i + 1);
        first = i + 1;
    }
    return first != 0 ||
           refuse(refusal, node->place, "no vertex has L = 0; exactly one, the leader's, does");
}

static double distance(const struct scenario_formation *formation, size_t a, size_t b)
{
    double ax = formation->L[a] * cos(formation->psi[a]);
    double ay = formation->L[a] * sin(formation->psi[a]);
    double bx = formation->L[b] * cos(formation->psi[b]);
    double by = formation->L[b] * sin(formation->psi[b]);

    return hypot(ax - bx, ay - by);
}

static bool judge_spacing(struct refusal *refusal, const struct node *node,
                          const struct scenario_formation *formation)
{
    for (size_t b = 1; b < formation->count; b++) {
        for (size_t a = 0; a < b; a++) {
            if (distance(formation, a, b) <= VERTEX_SPACING_M)
                return refuse(refusal, node->place,
                              "vertices %zu and %zu of %.60s are in one place; more than %g mm "
                              "apart is allowed",
                              a + 1, b + 1, formation->name, 1000 * VERTEX_SPACING_M);
        }
    }
    return true;
}

static bool formation_read(struct refusal *refusal, const struct node *node, struct entry *entry)
{
    if (node->key->text[0] == '\0')
        return refuse(refusal, node->key->place, "a formation without a name");
    entry->formation->name = strdup(node->key->text);
    if (entry->formation->name == NULL)
        return refuse_memory(refusal, node->place);
    return mapping_read(refusal, node, formation_fields, entry) &&
           judge_leader(refusal, node, entry->formation) &&
           judge_spacing(refusal, node, entry->formation);
}

bool formations_read(struct refusal *refusal, const struct node *node, const struct field *field,
                     void *into)
{
    struct reading *reading = into;
    struct scenario *scenario = reading->scenario;
    struct entry entry = {reading, NULL};

    (void)field;
    if (!is_kind(refusal, node, NODE_MAPPING))
        return false;
    if (node->count == 0)
        return refuse(refusal, node->place, "no formation; one at least is needed");
    scenario->formations = calloc(node->count, sizeof *scenario->formations);
    if (scenario->formations == NULL)
        return refuse_memory(refusal, node->place);
    for (const struct node *item = node->first; item != NULL; item = item->next) {
        entry.formation = &scenario->formations[scenario->formation_count++];
        if (!formation_read(refusal, item, &entry))
            return false;
    }
    return true;
}

bool formation_find(struct refusal *refusal, const struct node *node,
                    const struct scenario *scenario, size_t *out)
{
    char list[256] = "";

    if (!is_kind(refusal, node, NODE_SCALAR))
        return false;
    for (size_t i = 0; i < scenario->formation_count; i++) {
        const char *name = scenario->formations[i].name;
        if (strcmp(node->text, name) == 0) {
            *out = i;
            return true;
        }
        strncat(list, i > 0 ? ", " : "", sizeof list - strlen(list) - 1);
        strncat(list, name, sizeof list - strlen(list) - 1);
    }
    return refuse(refusal, node->place, "no formation is called '%.60s'; allowed: %s", node->text,
                  list);
}
