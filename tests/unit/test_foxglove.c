#include "foxglove.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

static struct foxglove viewer;
static char reply[FOXGLOVE_REPLY_MAX];

void setUp(void)
{
    memset(&viewer, 0, sizeof viewer);
    memset(reply, 'x', sizeof reply);
}

void tearDown(void)
{
}

static json_t *parse(char *text)
{
    TEST_ASSERT_NOT_NULL(text);
    json_t *json = json_loads(text, 0, NULL);
    free(text);
    TEST_ASSERT_NOT_NULL(json);
    return json;
}

static const char *word(const json_t *json, const char *key)
{
    const char *text = json_string_value(json_object_get(json, key));

    TEST_ASSERT_NOT_NULL_MESSAGE(text, key);
    return text;
}

static void test_the_server_says_who_it_is(void)
{
    json_t *info = parse(foxglove_server_info("a \"name\"", "17"));

    TEST_ASSERT_EQUAL_STRING("serverInfo", word(info, "op"));
    TEST_ASSERT_EQUAL_STRING("a \"name\"", word(info, "name"));
    TEST_ASSERT_EQUAL_STRING("17", word(info, "sessionId"));
    const json_t *capabilities = json_object_get(info, "capabilities");
    TEST_ASSERT_EQUAL_UINT(1, json_array_size(capabilities));
    TEST_ASSERT_EQUAL_STRING("time", json_string_value(json_array_get(capabilities, 0)));
    json_decref(info);
}

static json_int_t channel_of(enum topic topic)
{
    json_t *advertise = parse(foxglove_advertise());
    const json_t *channel = json_array_get(json_object_get(advertise, "channels"), topic);
    json_int_t id = json_integer_value(json_object_get(channel, "id"));

    TEST_ASSERT_EQUAL_STRING("advertise", word(advertise, "op"));
    TEST_ASSERT_EQUAL_STRING(topic_kinds[topic].name, word(channel, "topic"));
    TEST_ASSERT_EQUAL_STRING(topic_kinds[topic].type, word(channel, "schemaName"));
    TEST_ASSERT_EQUAL_STRING(topic_kinds[topic].definition, word(channel, "schema"));
    TEST_ASSERT_EQUAL_STRING("ros2msg", word(channel, "schemaEncoding"));
    TEST_ASSERT_EQUAL_STRING("cdr", word(channel, "encoding"));
    json_decref(advertise);
    return id;
}

static void test_every_topic_is_a_channel(void)
{
    for (enum topic topic = 0; topic < TOPIC_COUNT; topic++)
        for (enum topic other = 0; other < topic; other++)
            TEST_ASSERT_TRUE(channel_of(topic) != channel_of(other));
}

static bool hear(const char *text)
{
    bool good = foxglove_hear_text(&viewer, text, strlen(text), reply);

    if (!good) {
        json_t *status = json_loads(reply, JSON_REJECT_DUPLICATES, NULL);

        TEST_ASSERT_NOT_NULL(status);
        TEST_ASSERT_EQUAL_STRING("status", word(status, "op"));
        TEST_ASSERT_EQUAL_INT(2, json_integer_value(json_object_get(status, "level")));
        TEST_ASSERT_TRUE(strlen(word(status, "message")) > 10);
        json_decref(status);
    }
    return good;
}

static bool subscribe(uint32_t id, json_int_t channel)
{
    char text[128];

    snprintf(text, sizeof text,
             "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":%u,\"channelId\":%d}]}", id,
             (int)channel);
    return hear(text);
}

static size_t wanted(void)
{
    size_t count = 0;

    for (size_t i = 0; i < TOPIC_COUNT; i++)
        count += viewer.wanted[i];
    return count;
}

static void test_a_subscription(void)
{
    TEST_ASSERT_TRUE(subscribe(4294967295u, channel_of(TOPIC_TF)));
    TEST_ASSERT_EQUAL_UINT(1, wanted());
    TEST_ASSERT_TRUE(viewer.wanted[TOPIC_TF] && viewer.fresh[TOPIC_TF]);
    TEST_ASSERT_EQUAL_UINT(4294967295u, viewer.subscription[TOPIC_TF]);
    TEST_ASSERT_TRUE(hear("{\"op\":\"unsubscribe\",\"subscriptionIds\":[4294967295]}"));
    TEST_ASSERT_EQUAL_UINT(0, wanted());
    TEST_ASSERT_FALSE(viewer.fresh[TOPIC_TF]);
    TEST_ASSERT_TRUE(subscribe(4294967295u, channel_of(TOPIC_POSES)));
}

static void test_one_message_for_all_channels(void)
{
    char text[1024] = "{\"op\":\"subscribe\",\"subscriptions\":[";

    for (enum topic topic = 0; topic < TOPIC_COUNT; topic++)
        snprintf(text + strlen(text), 64, "%s{\"id\":%d,\"channelId\":%d}", topic == 0 ? "" : ",",
                 100 - (int)topic, (int)channel_of(topic));
    strcat(text, "]}");
    TEST_ASSERT_TRUE(hear(text));
    for (enum topic topic = 0; topic < TOPIC_COUNT; topic++)
        TEST_ASSERT_EQUAL_UINT(100u - topic, viewer.subscription[topic]);
    TEST_ASSERT_EQUAL_UINT(TOPIC_COUNT, wanted());
    TEST_ASSERT_TRUE(hear("{\"op\":\"unsubscribe\",\"subscriptionIds\":[99,98]}"));
    TEST_ASSERT_EQUAL_UINT(TOPIC_COUNT - 2, wanted());
    TEST_ASSERT_TRUE(viewer.wanted[0] && !viewer.wanted[1] && !viewer.wanted[2]);
}

static void test_a_channel_and_an_id_can_be_had_once(void)
{
    TEST_ASSERT_TRUE(subscribe(7, channel_of(TOPIC_TF)));
    TEST_ASSERT_FALSE(subscribe(8, channel_of(TOPIC_TF)));
    TEST_ASSERT_FALSE(subscribe(7, channel_of(TOPIC_POSES)));
    TEST_ASSERT_EQUAL_UINT(1, wanted());
    TEST_ASSERT_EQUAL_UINT(7, viewer.subscription[TOPIC_TF]);
    TEST_ASSERT_FALSE(hear("{\"op\":\"unsubscribe\",\"subscriptionIds\":[8]}"));
    TEST_ASSERT_EQUAL_UINT(1, wanted());
}

static void test_an_id_that_nobody_has_any_more_is_free(void)
{
    TEST_ASSERT_TRUE(subscribe(0, channel_of(TOPIC_TF)));
    TEST_ASSERT_TRUE(hear("{\"op\":\"unsubscribe\",\"subscriptionIds\":[0]}"));
    TEST_ASSERT_FALSE(hear("{\"op\":\"unsubscribe\",\"subscriptionIds\":[0]}"));
}

static void test_the_good_part_of_a_message_is_done(void)
{
    TEST_ASSERT_FALSE(hear("{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1,\"channelId\":1},"
                           "{\"id\":2,\"channelId\":99},{\"id\":3,\"channelId\":2}]}"));
    TEST_ASSERT_EQUAL_UINT(2, wanted());
}

static void test_what_is_no_request_changes_nothing(void)
{
    static const char *const texts[] = {
        "",
        "{",
        "null",
        "[]",
        "7",
        "\"subscribe\"",
        "{}",
        "{\"op\":7}",
        "{\"op\":\"advertise\",\"channels\":[]}",
        "{\"op\":\"subscribe\"}",
        "{\"op\":\"subscribe\",\"subscriptions\":{\"id\":1,\"channelId\":1}}",
        "{\"op\":\"subscribe\",\"subscriptions\":[7]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1}]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[{\"channelId\":1}]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":-1,\"channelId\":1}]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":4294967296,\"channelId\":1}]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1.5,\"channelId\":1}]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1,\"channelId\":0}]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1,\"channelId\":9}]}",
        "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1,\"channelId\":4294967297}]}",
        "{\"op\":\"unsubscribe\",\"subscriptionIds\":7}",
        "{\"op\":\"unsubscribe\",\"subscriptionIds\":[\"7\"]}",
        "{\"op\":\"\\u0000\"}",
        "\xFF",
    };

    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        TEST_ASSERT_FALSE_MESSAGE(hear(texts[i]), texts[i]);
        TEST_ASSERT_EQUAL_UINT_MESSAGE(0, wanted(), texts[i]);
    }
    TEST_ASSERT_FALSE(foxglove_hear_binary(reply));
    TEST_ASSERT_NOT_NULL(strstr(reply, "\"level\":2"));
}

static void test_the_head_of_a_message(void)
{
    static const uint8_t expected[FOXGLOVE_HEAD] = {
        1, 4, 3, 2, 1, 0, 0x75, 0x85, 0xDF, 0x02, 0, 0, 0, /* 12340 ms are 0x2DF857500 ns */
    };
    uint8_t head[FOXGLOVE_HEAD];

    TEST_ASSERT_TRUE(subscribe(0x01020304, channel_of(TOPIC_LINKS)));
    foxglove_head(&viewer, TOPIC_LINKS, 12340, head);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, head, sizeof head);
}

static void test_the_time(void)
{
    static const uint8_t last[FOXGLOVE_TIME] = {2, 0xC0, 0xBD, 0xF0, 0xFF, 0x1F, 0xA1, 0x07};
    static const uint8_t none[FOXGLOVE_TIME] = {2};
    uint8_t bytes[FOXGLOVE_TIME];

    foxglove_time(INT32_MAX, bytes); /* 2147483647000000 ns */
    TEST_ASSERT_EQUAL_HEX8_ARRAY(last, bytes, sizeof bytes);
    foxglove_time(-500, bytes);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(none, bytes, sizeof bytes);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_server_says_who_it_is);
    RUN_TEST(test_every_topic_is_a_channel);
    RUN_TEST(test_a_subscription);
    RUN_TEST(test_one_message_for_all_channels);
    RUN_TEST(test_a_channel_and_an_id_can_be_had_once);
    RUN_TEST(test_an_id_that_nobody_has_any_more_is_free);
    RUN_TEST(test_the_good_part_of_a_message_is_done);
    RUN_TEST(test_what_is_no_request_changes_nothing);
    RUN_TEST(test_the_head_of_a_message);
    RUN_TEST(test_the_time);
    return UNITY_END();
}
