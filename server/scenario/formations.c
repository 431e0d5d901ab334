#include "reading.h"

#include "formation_rules.h"
#include "limits.h"

#include <stdlib.h>
#include <string.h>

static const struct limits L_limits = {-FORMATION_L_MAX_M, FORMATION_L_MAX_M, false, "m"};
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
    char words[FORMATION_WORDS_MAX];

    if (!formation_count_judge(count, entry->reading->scenario->robot_count,
                               entry->reading->vertices_max, words))
        return refuse(refusal, node->place, "%s", words);
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

static bool formation_read(struct refusal *refusal, const struct node *node, struct entry *entry)
{
    char words[FORMATION_WORDS_MAX];

    if (node->key->text[0] == '\0')
        return refuse(refusal, node->key->place, "a formation without a name");
    entry->formation->name = strdup(node->key->text);
    if (entry->formation->name == NULL)
        return refuse_memory(refusal, node->place);
    if (!mapping_read(refusal, node, formation_fields, entry))
        return false;
    return formation_judge(entry->formation, words) || refuse(refusal, node->place, "%s", words);
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
