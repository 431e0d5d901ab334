#include "visitor.h"

#include "viewed.h"

#include <stdio.h>
#include <string.h>
#include <unity.h>

#define RECORD_HEAD 12

/* What a view is asked by. */
static struct viewed viewed_of(const struct visitor *visitor)
{
    struct viewed viewed = {.url = visitor->url, .token = strchr(visitor->url, '#') + 1};

    TEST_ASSERT_EQUAL_INT(1, sscanf(visitor->url, "http://%63[0-9.:]", viewed.host));
    return viewed;
}

void visitor_join(struct visitor *visitor, const struct process *process)
{
    *visitor = (struct visitor){.scene.time_ms = INT32_MIN};
    TEST_ASSERT_EQUAL_INT(1, sscanf(process_said(process, "view: "), "view: %127s", visitor->url));
    struct viewed viewed = viewed_of(visitor);
    viewed_join(&viewed, &visitor->client);
}

void visitor_leave(struct visitor *visitor)
{
    client_close(&visitor->client);
}

static uint32_t u32_at(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* The last scene of a binary message, if there is one. */
static void take_scenes(struct visitor *visitor, const struct client_message *message)
{
    size_t at = 0;

    while (message->opcode == CLIENT_BINARY && at + RECORD_HEAD <= message->count) {
        const uint8_t *record = message->bytes + at;
        size_t count = u32_at(record + 8);

        if (record[0] == 1) {
            TEST_ASSERT_TRUE(scene_read(&visitor->scene, visitor->robots, VISITOR_ROBOTS,
                                        visitor->vertices, VISITOR_ROBOTS, record + RECORD_HEAD,
                                        count));
        }
        at += (RECORD_HEAD + count + 7) / 8 * 8;
    }
}

void visitor_see(struct visitor *visitor, bool (*seen)(const struct scene *scene))
{
    while (visitor->scene.time_ms == INT32_MIN || !seen(&visitor->scene)) {
        struct client_message message = client_receive(&visitor->client);

        TEST_ASSERT_TRUE_MESSAGE(message.opcode != CLIENT_GONE, "the view has gone");
        take_scenes(visitor, &message);
    }
}

void visitor_ask(struct visitor *visitor, const char *request, const char *expected)
{
    struct viewed viewed = viewed_of(visitor);
    char begin[64], text[512] = "";

    viewed_ask(&viewed, &visitor->client, ++visitor->asked, request);
    if (expected == NULL)
        return;
    snprintf(begin, sizeof begin, "{\"answer\":{\"number\":%u,", visitor->asked);
    while (strncmp(text, begin, strlen(begin)) != 0) {
        struct client_message message = client_receive(&visitor->client);

        TEST_ASSERT_TRUE_MESSAGE(message.opcode != CLIENT_GONE, "the view has gone");
        take_scenes(visitor, &message);
        if (message.opcode == CLIENT_TEXT)
            snprintf(text, sizeof text, "%.*s", (int)message.count, (const char *)message.bytes);
    }
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(text, expected), text);
}
