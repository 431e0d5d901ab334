#include "limits.h"
#include "sections.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ADAPTERS_MAX 16 /* hci0 to hci15 */
#define BAUD_MIN 1200
#define BAUD_MAX 1000000
#define BAUD_DEFAULT 115200

/* A turn either way: degrees are noticed. */
static const struct limits heading_limits = {-6.2832, 6.2832, false, "rad"};

static bool read_id(struct refusal *refusal, const struct node *node, const struct field *field,
                    void *into)
{
    int64_t id;

    (void)field;
    if (!integer_read(refusal, node, 0, 1, ROBOT_ID_MAX, &id))
        return false;
    ((struct site_robot *)into)->id = (uint16_t)id;
    return true;
}

static bool read_body(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    if (!field_text(refusal, node, field, into))
        return false;
    size_t length = strlen(node->text);
    return length < CAPTURE_NAME_MAX ||
           refuse(refusal, node->place, "body has %zu bytes; 1 to %d are allowed", length,
                  CAPTURE_NAME_MAX - 1);
}

static bool read_link(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    struct site_robot *robot = into;
    char words[LINK_WORDS_MAX];

    (void)field;
    if (!is_kind(refusal, node, NODE_SCALAR))
        return false;
    return link_address_read(node->text, &robot->link.address, words) ||
           refuse(refusal, node->place, "link is '%.100s'; %s", node->text, words);
}

/* Its link is known already. */
static bool read_adapter(struct refusal *refusal, const struct node *node,
                         const struct field *field, void *into)
{
    struct site_robot *robot = into;
    char name[8];

    (void)field;
    if (!is_kind(refusal, node, NODE_SCALAR))
        return false;
    if (robot->link.address.kind != LINK_RFCOMM)
        return refuse(refusal, node->place,
                      "an adapter for a link that is not rfcomm:; only those have one");
    for (int i = 0; i < ADAPTERS_MAX; i++) {
        snprintf(name, sizeof name, "hci%d", i);
        if (strcmp(node->text, name) == 0) {
            robot->link.adapter = i;
            return true;
        }
    }
    return refuse(refusal, node->place, "adapter is '%.60s'; hci0 to hci%d are allowed", node->text,
                  ADAPTERS_MAX - 1);
}

static bool read_body_id(struct refusal *refusal, const struct node *node,
                         const struct field *field, void *into)
{
    int64_t id;

    (void)field;
    if (!integer_read(refusal, node, 0, 0, INT32_MAX, &id))
        return false;
    ((struct site_robot *)into)->body = (int32_t)id;
    return true;
}

static bool read_baud(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    int64_t baud;

    (void)field;
    if (!integer_read(refusal, node, 0, BAUD_MIN, BAUD_MAX, &baud))
        return false;
    ((struct site_robot *)into)->link.baud = (uint32_t)baud;
    return true;
}

static const struct field robot_fields[] = {
    {"id", true, read_id, 0, NULL},
    {"body", false, read_body, offsetof(struct site_robot, name), NULL},
    {"link", true, read_link, 0, NULL},
    {"adapter", false, read_adapter, 0, NULL},
    {"heading", false, field_number, offsetof(struct site_robot, heading), &heading_limits},
    {"body_id", false, read_body_id, 0, NULL},
    {"baud", false, read_baud, 0, NULL},
    {NULL, false, NULL, 0, NULL},
};

static bool is_same_link(const struct link_address *a, const struct link_address *b)
{
    return a->kind == b->kind && strcmp(a->name, b->name) == 0 && a->port == b->port &&
           memcmp(a->bluetooth, b->bluetooth, sizeof a->bluetooth) == 0;
}

static struct place place_of(const struct node *item, const char *key)
{
    const struct node *value = tree_find(item, key);

    return value != NULL ? value->place : item->place;
}

/* Only VRPN numbers bodies within a name: they are the sensors of a tracker. */
static bool is_sensor_beside(const struct site *site, const struct site_robot *a,
                             const struct site_robot *b)
{
    return site->mocap.protocol == &vrpn_protocol && a->body != CAPTURE_ID_NONE &&
           b->body != CAPTURE_ID_NONE && a->body != b->body;
}

static bool judge_pair(struct refusal *refusal, const struct node *item, const struct site *site,
                       const struct site_robot *earlier, const struct site_robot *robot)
{
    if (is_same_link(&earlier->link.address, &robot->link.address))
        return refuse(refusal, place_of(item, "link"),
                      "robots %u and %u have the same link; each has its own", earlier->id,
                      robot->id);
    bool named = earlier->name != NULL && robot->name != NULL;
    if (named && strcmp(earlier->name, robot->name) == 0 && !is_sensor_beside(site, earlier, robot))
        return refuse(refusal, place_of(item, "body"),
                      "robots %u and %u have the same body '%.63s'; each has its own", earlier->id,
                      robot->id, robot->name);
    if (robot->body != CAPTURE_ID_NONE && earlier->body == robot->body &&
        site->mocap.protocol != &vrpn_protocol)
        return refuse(refusal, place_of(item, "body_id"),
                      "robots %u and %u have the same body_id %d; each has its own", earlier->id,
                      robot->id, robot->body);
    return true;
}

static const char *title(const struct site_robot *robot)
{
    return robot->name != NULL ? robot->name : "by number";
}

/* The newest robot beside all before it. */
static bool judge_twins(struct refusal *refusal, const struct node *item, const struct site *site,
                        size_t newest)
{
    const struct site_robot *robots = site->robots;
    const struct site_robot *robot = &robots[newest];

    for (size_t i = 0; i < newest; i++) {
        if (robots[i].id == robot->id)
            return refuse(refusal, place_of(item, "id"),
                          "robots '%.63s' and '%.63s' have the same id %u; each has its own",
                          title(&robots[i]), title(robot), robot->id);
        if (!judge_pair(refusal, item, site, &robots[i], robot))
            return false;
    }
    return true;
}

/* Without a number it needs a name. */
static bool name_body(struct refusal *refusal, const struct node *item, struct site_robot *robot)
{
    char name[sizeof "Robot65534"];

    if (robot->name != NULL || robot->body != CAPTURE_ID_NONE)
        return true;
    snprintf(name, sizeof name, "Robot%u", robot->id);
    robot->name = strdup(name);
    return robot->name != NULL || refuse_memory(refusal, item->place);
}

bool site_robots_read(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    struct site *site = into;

    (void)field;
    if (!is_kind(refusal, node, NODE_LIST))
        return false;
    if (node->count == 0 || node->count > CAPTURE_BODIES_MAX)
        return refuse(refusal, node->place, "%zu robots; 1 to %d are allowed", node->count,
                      CAPTURE_BODIES_MAX);
    site->robots = calloc(node->count, sizeof *site->robots);
    if (site->robots == NULL)
        return refuse_memory(refusal, node->place);
    for (const struct node *item = node->first; item != NULL; item = item->next) {
        struct site_robot *robot = &site->robots[site->robot_count++];

        robot->body = CAPTURE_ID_NONE;
        robot->link = (struct link_settings){.adapter = -1, .baud = BAUD_DEFAULT};
        if (!mapping_read(refusal, item, robot_fields, robot) || !name_body(refusal, item, robot) ||
            !judge_twins(refusal, item, site, site->robot_count - 1))
            return false;
    }
    return true;
}
