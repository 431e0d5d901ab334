#include "foxglove.h"

#include <jansson.h>
#include <stdio.h>
#include <string.h>

enum { OP_MESSAGE_DATA = 1, OP_TIME = 2 };
enum { LEVEL_ERROR = 2 };

static json_int_t channel_of(enum topic topic)
{
    return (json_int_t)topic + 1; /* clients have taken 0 for a missing one */
}

/* Takes the reference. */
static char *text_of(json_t *json)
{
    char *text = json != NULL ? json_dumps(json, JSON_COMPACT) : NULL;

    json_decref(json);
    return text;
}

char *foxglove_server_info(const char *name, const char *session)
{
    return text_of(json_pack("{s:s, s:s, s:[s], s:[s], s:s}", "op", "serverInfo", "name", name,
                             "capabilities", "time", "supportedEncodings", "cdr", "sessionId",
                             session));
}

static json_t *channel(enum topic topic)
{
    const struct topic_kind *kind = &topic_kinds[topic];

    return json_pack("{s:I, s:s, s:s, s:s, s:s, s:s}", "id", channel_of(topic), "topic", kind->name,
                     "encoding", "cdr", "schemaName", kind->type, "schema", kind->definition,
                     "schemaEncoding", "ros2msg");
}

char *foxglove_advertise(void)
{
    json_t *channels = json_array();

    for (enum topic topic = 0; topic < TOPIC_COUNT; topic++)
        json_array_append_new(channels, channel(topic));
    return text_of(json_pack("{s:s, s:o}", "op", "advertise", "channels", channels));
}

/* `words` need no escape. */
static bool refuse(char *reply, const char *words)
{
    snprintf(reply, FOXGLOVE_REPLY_MAX, "{\"op\":\"status\",\"level\":%d,\"message\":\"%s\"}",
             LEVEL_ERROR, words);
    return false;
}

static bool is_id(const json_t *json)
{
    return json_is_integer(json) && json_integer_value(json) >= 0 &&
           json_integer_value(json) <= UINT32_MAX;
}

/* TOPIC_COUNT: none has it. */
static enum topic topic_of(const struct foxglove *viewer, uint32_t subscription)
{
    enum topic topic = 0;

    while (topic < TOPIC_COUNT &&
           !(viewer->wanted[topic] && viewer->subscription[topic] == subscription))
        topic++;
    return topic;
}

static bool subscribe(struct foxglove *viewer, const json_t *wish, char *reply)
{
    const json_t *id = json_object_get(wish, "id");
    const json_t *channel = json_object_get(wish, "channelId");

    if (!is_id(id) || !is_id(channel))
        return refuse(reply, "a subscription is an id and a channelId");
    uint32_t subscription = (uint32_t)json_integer_value(id);
    json_int_t number = json_integer_value(channel) - channel_of(0);
    if (number < 0 || number >= TOPIC_COUNT)
        return refuse(reply, "no such channel is advertised");
    if (viewer->wanted[number])
        return refuse(reply, "this channel is already subscribed to");
    if (topic_of(viewer, subscription) != TOPIC_COUNT)
        return refuse(reply, "this id has a subscription already");
    viewer->wanted[number] = true;
    viewer->fresh[number] = true;
    viewer->subscription[number] = subscription;
    return true;
}

static bool unsubscribe(struct foxglove *viewer, const json_t *id, char *reply)
{
    if (!is_id(id))
        return refuse(reply, "subscriptionIds are numbers");
    enum topic topic = topic_of(viewer, (uint32_t)json_integer_value(id));
    if (topic == TOPIC_COUNT)
        return refuse(reply, "no subscription has this id");
    viewer->wanted[topic] = false;
    viewer->fresh[topic] = false;
    return true;
}

/* What can be done is done, and the last that cannot is told. */
static bool for_each(struct foxglove *viewer, const json_t *list, char *reply,
                     bool (*act)(struct foxglove *viewer, const json_t *item, char *reply))
{
    bool good = true;

    if (!json_is_array(list))
        return refuse(reply, "subscriptions and subscriptionIds are arrays");
    for (size_t i = 0; i < json_array_size(list); i++)
        if (!act(viewer, json_array_get(list, i), reply))
            good = false;
    return good;
}

static bool obey(struct foxglove *viewer, const json_t *message, char *reply)
{
    const char *op = json_string_value(json_object_get(message, "op"));

    if (op == NULL)
        return refuse(reply, "a message is a JSON object with an op");
    if (strcmp(op, "subscribe") == 0)
        return for_each(viewer, json_object_get(message, "subscriptions"), reply, subscribe);
    if (strcmp(op, "unsubscribe") == 0)
        return for_each(viewer, json_object_get(message, "subscriptionIds"), reply, unsubscribe);
    return refuse(reply, "this server knows the ops subscribe and unsubscribe");
}

bool foxglove_hear_text(struct foxglove *viewer, const char *text, size_t count, char *reply)
{
    json_t *message = json_loadb(text, count, 0, NULL);
    bool good = obey(viewer, message, reply);

    json_decref(message);
    return good;
}

bool foxglove_hear_binary(char *reply)
{
    return refuse(reply, "this server takes no messages and has no services");
}

static void put(uint8_t *bytes, uint64_t value, size_t count)
{
    for (size_t i = 0; i < count; i++)
        bytes[i] = (uint8_t)(value >> 8 * i);
}

static uint64_t nanoseconds(int32_t time_ms)
{
    return time_ms < 0 ? 0 : (uint64_t)time_ms * 1000000;
}

void foxglove_head(const struct foxglove *viewer, enum topic topic, int32_t time_ms, uint8_t *head)
{
    head[0] = OP_MESSAGE_DATA;
    put(head + 1, viewer->subscription[topic], 4);
    put(head + 5, nanoseconds(time_ms), 8);
}

void foxglove_time(int32_t time_ms, uint8_t *bytes)
{
    bytes[0] = OP_TIME;
    put(bytes + 1, nanoseconds(time_ms), 8);
}
