#include "site.h"

#include "limits.h"
#include "reading.h"
#include "sections.h"
#include "setting.h"
#include "yaml.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TEXT_MAX 1000 /* bytes */

static const struct limits position_limits = {-POSITION_MAX_M, POSITION_MAX_M, false, "m"};
static const struct limits track_limits = {0, 10, true, "m"};
static const struct limits wheel_limits = {0, 6, true, "m/s"};
static const struct limits latency_limits = {0, 0.255, false, "s"}; /* a byte of ms on the wire */
static const struct limits separation_limits = {0, 10, false, "m"};
static const struct limits battery_limits = {0, 30, false, "V"};
/* Fewer, and robots take motion capture for lost. */
static const struct limits poses_limits = {10, 1000, false, "Hz"};
static const struct limits patience_limits = {0, 3600, false, "s"};

bool field_text(struct refusal *refusal, const struct node *node, const struct field *field,
                void *into)
{
    if (!is_kind(refusal, node, NODE_SCALAR))
        return false;
    size_t length = strlen(node->text);
    if (length == 0 || length > TEXT_MAX)
        return refuse(refusal, node->place, "%.60s has %zu bytes; 1 to %d are allowed",
                      node_title(node), length, TEXT_MAX);
    char *copy = strdup(node->text);
    *(char **)((char *)into + field->offset) = copy;
    return copy != NULL || refuse_memory(refusal, node->place);
}

bool field_path(struct refusal *refusal, const struct node *node, const struct field *field,
                void *into)
{
    const char *slash = strrchr(node->place.source, '/');
    char **path = (char **)((char *)into + field->offset);

    if (!field_text(refusal, node, field, into))
        return false;
    if (node->place.setting || slash == NULL || node->text[0] == '/')
        return true;
    size_t folder = (size_t)(slash + 1 - node->place.source);
    size_t room = folder + strlen(node->text) + 1;
    char *whole = malloc(room);
    if (whole == NULL)
        return refuse_memory(refusal, node->place);
    snprintf(whole, room, "%.*s%s", (int)folder, node->place.source, node->text);
    free(*path);
    *path = whole;
    return true;
}

static bool read_name(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    (void)field;
    return name_read(refusal, node, &((struct site *)into)->name);
}

static bool read_network(struct refusal *refusal, const struct node *node,
                         const struct field *field, void *into)
{
    static const struct field fields[] = {
        {"range", false, field_number, offsetof(struct site, range), &range_limits},
        {"loss", false, field_number, offsetof(struct site, loss), &loss_limits},
        {"delay", false, field_number, offsetof(struct site, delay), &delay_limits},
        {NULL, false, NULL, 0, NULL},
    };

    (void)field;
    return mapping_read(refusal, node, fields, into);
}

static bool read_wheels(struct refusal *refusal, const struct node *node, const struct field *field,
                        void *into)
{
    static const struct field fields[] = {
        {"track", false, field_number, offsetof(struct site, track), &track_limits},
        {"max", false, field_number, offsetof(struct site, wheel_max), &wheel_limits},
        {NULL, false, NULL, 0, NULL},
    };

    (void)field;
    return mapping_read(refusal, node, fields, into);
}

static bool read_fence(struct refusal *refusal, const struct node *node, const struct field *field,
                       void *into)
{
    struct site *site = into;
    double *fence = site->fence;

    (void)field;
    if (!is_kind(refusal, node, NODE_LIST))
        return false;
    if (node->count != 4)
        return refuse(refusal, node->place,
                      "fence holds %zu numbers; [x_min, y_min, x_max, y_max] is allowed",
                      node->count);
    if (!numbers_read(refusal, node, 4, &position_limits, fence))
        return false;
    site->fenced = true;
    return (fence[0] < fence[2] && fence[1] < fence[3]) ||
           refuse(
               refusal, node->place,
               "the fence encloses nothing; x_min below x_max and y_min below y_max are allowed");
}

static const struct field site_fields[] = {
    {"schema", true, schema_read, 0, NULL},
    {"name", true, read_name, 0, NULL},
    {"scenario", false, field_path, offsetof(struct site, scenario), NULL},
    {"mocap", true, mocap_read, 0, NULL},
    {"robots", true, site_robots_read, 0, NULL},
    {"network", false, read_network, 0, NULL},
    {"wheels", false, read_wheels, 0, NULL},
    {"latency", false, field_number, offsetof(struct site, latency), &latency_limits},
    {"fence", false, read_fence, 0, NULL},
    {"separation", false, field_number, offsetof(struct site, separation), &separation_limits},
    {"poses", false, field_number, offsetof(struct site, poses), &poses_limits},
    {"battery", false, field_number, offsetof(struct site, battery), &battery_limits},
    {"patience", false, field_number, offsetof(struct site, patience), &patience_limits},
    {NULL, false, NULL, 0, NULL},
};

static struct site *site_new(void)
{
    struct site *site = malloc(sizeof *site);

    if (site != NULL)
        *site = (struct site){
            .tracker = {.scale = 1, .jump = 0.3},
            .range = NAN,
            .loss = NAN,
            .delay = NAN,
            .track = NAN,
            .wheel_max = NAN,
            .latency = NAN,
            .poses = NAN,
            .patience = 10,
        };
    return site;
}

void site_free(struct site *site)
{
    if (site == NULL)
        return;
    for (size_t i = 0; i < site->robot_count; i++)
        free(site->robots[i].name);
    free(site->robots);
    free((char *)site->mocap.server);
    free((char *)site->mocap.interface);
    free((char *)site->mocap.group);
    free((char *)site->mocap.file);
    free(site->scenario);
    free(site->name);
    free(site);
}

static struct site *site_of(struct refusal *refusal, const struct node *root)
{
    struct site *site = site_new();

    if (site == NULL)
        refuse_memory(refusal, root->place);
    else if (mapping_read(refusal, root, site_fields, site))
        return site;
    site_free(site);
    return NULL;
}

static struct site *site_from(struct refusal *refusal, struct node *root,
                              const char *const *settings, size_t count)
{
    struct site *site = NULL;

    if (root != NULL && settings_apply(root, settings, count, refusal))
        site = site_of(refusal, root);
    tree_free(root);
    return site;
}

struct site *site_parse(const char *name, const char *text, size_t length,
                        const char *const *settings, size_t setting_count, char *error, size_t room)
{
    struct refusal refusal = {error, room};

    return site_from(&refusal, yaml_parse(name, text, length, &refusal), settings, setting_count);
}

struct site *site_read(const char *path, const char *const *settings, size_t setting_count,
                       char *error, size_t room)
{
    struct refusal refusal = {error, room};

    return site_from(&refusal, yaml_read_file(path, &refusal), settings, setting_count);
}
