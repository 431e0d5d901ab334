#include "sections.h"

#include <arpa/inet.h>
#include <stdlib.h>
#include <string.h>

static const struct limits scale_limits = {0, 1000, true, ""};
static const struct limits jump_limits = {0, 100, false, "m"};
static const struct limits latency_limits = {0, 1, false, "s"};

static bool read_port(struct refusal *refusal, const struct node *node, const struct field *field,
                      void *into)
{
    int64_t port;

    if (!integer_read(refusal, node, 0, 1, UINT16_MAX, &port))
        return false;
    *(uint16_t *)((char *)into + field->offset) = (uint16_t)port;
    return true;
}

static bool read_group(struct refusal *refusal, const struct node *node, const struct field *field,
                       void *into)
{
    struct in_addr address;

    if (!field_text(refusal, node, field, into))
        return false;
    if (inet_pton(AF_INET, node->text, &address) == 1 && IN_MULTICAST(ntohl(address.s_addr)))
        return true;
    return refuse(refusal, node->place,
                  "group is '%.60s'; an IPv4 multicast address, 224.0.0.0 to 239.255.255.255, is "
                  "allowed",
                  node->text);
}

/* "3.0", which is no number: 2.11 is later than 2.5. */
static bool read_version(struct refusal *refusal, const struct node *node,
                         const struct field *field, void *into)
{
    static const char digits[] = "0123456789";
    uint8_t *version = ((struct site *)into)->mocap.options.version;

    (void)field;
    if (!is_kind(refusal, node, NODE_SCALAR))
        return false;
    size_t major = strspn(node->text, digits);
    const char *rest = node->text + major + 1;
    bool good = major == 1 && node->text[major] == '.' && strspn(rest, digits) == strlen(rest) &&
                strlen(rest) >= 1 && strlen(rest) <= 2;
    int value = good ? atoi(node->text) * 100 + atoi(rest) : 0;
    if (value < 205 || value > 402)
        return refuse(refusal, node->place, "version is '%.60s'; 2.5 to 4.2 are allowed",
                      node->text);
    version[0] = (uint8_t)(value / 100);
    version[1] = (uint8_t)(value % 100);
    return true;
}

static const char *const protocol_names[] = {"natnet", "vrpn",  "vicon", "qtm",
                                             "dtrack", "poses", NULL};

/* The keys of each beside those that all have, and the one that it cannot do without. */
static const struct {
    const struct capture_protocol *protocol;
    const char *needs;
    const char *has[8];
} protocols[] = {
    {&natnet_protocol,
     NULL,
     {"server", "port", "interface", "group", "unicast", "version", "data_port"}},
    {&vrpn_protocol, "server", {"server", "port"}},
    {&vicon_protocol, NULL, {"port"}},
    {&qtm_protocol, "server", {"server", "port", "data_port"}},
    {&dtrack_protocol, NULL, {"port"}},
    {&poses_protocol, "file", {"file", "repeat"}},
};

static const char *const common_keys[] = {"protocol", "up", "scale", "jump", "latency", NULL};

/* The first that is read: which way is up depends on it where nobody says. */
static bool read_protocol(struct refusal *refusal, const struct node *node,
                          const struct field *field, void *into)
{
    struct site *site = into;
    unsigned choice;

    (void)field;
    if (!choice_read(refusal, node, protocol_names, &choice))
        return false;
    site->mocap.protocol = protocols[choice].protocol;
    site->tracker.up = site->mocap.protocol == &natnet_protocol ? UP_Y : UP_Z;
    return true;
}

static bool read_up(struct refusal *refusal, const struct node *node, const struct field *field,
                    void *into)
{
    static const char *const choices[] = {[UP_Z] = "z", [UP_Y] = "y", NULL};
    unsigned choice;

    (void)field;
    if (!choice_read(refusal, node, choices, &choice))
        return false;
    ((struct site *)into)->tracker.up = (enum tracker_up)choice;
    return true;
}

#define IN_SITE(member) offsetof(struct site, member)

static const struct field mocap_fields[] = {
    {"protocol", true, read_protocol, 0, NULL},
    {"server", false, field_text, IN_SITE(mocap.server), NULL},
    {"port", false, read_port, IN_SITE(mocap.port), NULL},
    {"interface", false, field_text, IN_SITE(mocap.interface), NULL},
    {"group", false, read_group, IN_SITE(mocap.group), NULL},
    {"unicast", false, field_bool, IN_SITE(mocap.options.unicast), NULL},
    {"version", false, read_version, 0, NULL},
    {"data_port", false, read_port, IN_SITE(mocap.options.data_port), NULL},
    {"file", false, field_path, IN_SITE(mocap.file), NULL},
    {"repeat", false, field_bool, IN_SITE(mocap.repeat), NULL},
    {"up", false, read_up, 0, NULL},
    {"scale", false, field_number, IN_SITE(tracker.scale), &scale_limits},
    {"jump", false, field_number, IN_SITE(tracker.jump), &jump_limits},
    {"latency", false, field_number, IN_SITE(tracker.latency), &latency_limits},
    {NULL, false, NULL, 0, NULL},
};

static bool is_among(const char *key, const char *const *list)
{
    while (*list != NULL && strcmp(*list, key) != 0)
        list++;
    return *list != NULL;
}

static bool refuse_key(struct refusal *refusal, const struct node *key, const char *protocol,
                       const char *const *has)
{
    char list[128] = "";

    for (; *has != NULL; has++) {
        strncat(list, ", ", sizeof list - strlen(list) - 1);
        strncat(list, *has, sizeof list - strlen(list) - 1);
    }
    return refuse(refusal, key->place,
                  "%s has no '%.60s'; protocol, up, scale, jump, latency%s are "
                  "allowed",
                  protocol, key->text, list);
}

static bool judge_keys(struct refusal *refusal, const struct node *mapping,
                       const struct capture_protocol *protocol)
{
    size_t which = 0;

    while (protocols[which].protocol != protocol)
        which++;
    const char *name = protocol_names[which];
    const char *needs = protocols[which].needs;
    if (needs != NULL && tree_find(mapping, needs) == NULL)
        return refuse(refusal, mapping->place, "the key '%s' is missing; %s needs it", needs, name);
    for (const struct node *value = mapping->first; value != NULL; value = value->next) {
        const char *key = value->key->text;
        if (!is_among(key, common_keys) && !is_among(key, protocols[which].has))
            return refuse_key(refusal, value->key, name, protocols[which].has);
    }
    return true;
}

/* What of NatNet does not go together. */
static bool judge_natnet(struct refusal *refusal, const struct node *mapping,
                         const struct source_settings *mocap)
{
    if (mocap->server == NULL && mocap->options.version[0] == 0)
        return refuse(refusal, mapping->place,
                      "natnet has no server; the server's address, or the version of one that is "
                      "only listened to, is allowed");
    return !mocap->options.unicast || mocap->group == NULL ||
           refuse(refusal, tree_find(mapping, "group")->place,
                  "a group and unicast; either of them is allowed");
}

bool mocap_read(struct refusal *refusal, const struct node *node, const struct field *field,
                void *into)
{
    struct site *site = into;

    (void)field;
    if (!mapping_read(refusal, node, mocap_fields, site) ||
        !judge_keys(refusal, node, site->mocap.protocol))
        return false;
    return site->mocap.protocol != &natnet_protocol || judge_natnet(refusal, node, &site->mocap);
}
