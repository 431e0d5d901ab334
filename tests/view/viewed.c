#include "viewed.h"

#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

void viewed_open(struct viewed *viewed, uint32_t acts)
{
    const struct view_options options = {.port = 0};
    const struct view_about about = {"sim", "a \"test\"", 60, acts};
    char error[300] = "";

    viewed->view = view_open(&options, &about, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(viewed->view, error);
    viewed->url = view_url(viewed->view);
    viewed->token = strchr(viewed->url, '#') + 1;
    TEST_ASSERT_EQUAL_INT(1, sscanf(viewed->url, "http://%63[0-9.:]", viewed->host));
    snprintf(viewed->origin, sizeof viewed->origin, "http://%s", viewed->host);
}

void viewed_close(struct viewed *viewed)
{
    view_close(viewed->view);
    viewed->view = NULL;
}

void viewed_join(const struct viewed *viewed, struct client *client)
{
    client_connect(client, viewed->url);
    TEST_ASSERT_EQUAL_INT(101, client_upgrade(client, viewed->host, VIEWED_PAGE, NULL));
    struct client_message hello = client_receive(client);
    TEST_ASSERT_EQUAL_INT(CLIENT_TEXT, hello.opcode);
    TEST_ASSERT_EQUAL_INT(0, memcmp(hello.bytes, "{\"hello\":", 9));
}

void viewed_scene(const struct viewed *viewed, int32_t time_ms, size_t count)
{
    static uint8_t fleet[65536];

    memset(fleet, time_ms / 20 % 251, count);
    memcpy(fleet + 4, &time_ms, sizeof time_ms);
    view_scene(viewed->view, time_ms, fleet, count);
}

void viewed_ask(const struct viewed *viewed, struct client *client, unsigned number,
                const char *rest)
{
    char text[500];

    snprintf(text, sizeof text, "{\"number\":%u,\"token\":\"%s\",\"act\":%s}", number,
             viewed->token, rest);
    client_send_text(client, text);
}

struct act viewed_act(const struct viewed *viewed)
{
    struct pollfd wait = {view_descriptor(viewed->view), POLLIN, 0};
    struct act act;

    TEST_ASSERT_EQUAL_INT_MESSAGE(1, poll(&wait, 1, CLIENT_PATIENCE_S * 1000), "no act");
    TEST_ASSERT_TRUE(view_next_act(viewed->view, &act));
    return act;
}

void viewed_expect(struct client *client, const char *text)
{
    struct client_message message = client_receive(client);

    TEST_ASSERT_EQUAL_INT(CLIENT_TEXT, message.opcode);
    TEST_ASSERT_EQUAL_STRING_LEN(text, message.bytes, message.count);
    TEST_ASSERT_EQUAL_UINT(strlen(text), message.count);
}

void viewed_text(struct client *client, char *text, size_t room)
{
    struct client_message message;

    do
        message = client_receive(client);
    while (message.opcode == CLIENT_BINARY);
    TEST_ASSERT_EQUAL_INT(CLIENT_TEXT, message.opcode);
    TEST_ASSERT_LESS_THAN_UINT(room, message.count);
    snprintf(text, room, "%.*s", (int)message.count, (const char *)message.bytes);
}
