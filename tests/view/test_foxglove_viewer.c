/* test_foxglove_viewer.c: Foxglove's viewers on the same port. */
#include "viewed.h"

#include "foxglove.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unity.h>

#define ROBOTS 3
#define VERTICES 2
#define SUBSCRIPTION 70 /* and the topic's number: ids that are no channel's */

static struct viewed viewed;
static struct client client;
static struct scene scene;
static struct scene_robot robots[ROBOTS];
static struct scene_point vertices[VERTICES];
static uint8_t fleet[4096];
static size_t fleet_count;

/* A scene of that time, shown. */
static void show(int32_t time_ms)
{
    scene = (struct scene){.time_ms = time_ms,
                           .leader = 2,
                           .mean_distance_error = 0.25,
                           .robot_count = ROBOTS,
                           .robots = robots,
                           .vertex_count = VERTICES,
                           .vertices = vertices,
                           .formation = "v"};
    for (uint16_t i = 0; i < ROBOTS; i++)
        robots[i] = (struct scene_robot){.x = i + time_ms / 1000.0, .id = i + 1, .alive = true};
    fleet_count = scene_write(&scene, fleet, sizeof fleet);
    TEST_ASSERT_GREATER_THAN_UINT(0, fleet_count);
    view_scene(viewed.view, time_ms, fleet, fleet_count);
}

void setUp(void)
{
    viewed_open(&viewed, ACT_BIT(ACT_ESTOP));
}

void tearDown(void)
{
    client_close(&client);
    viewed_close(&viewed);
}

static void join(const char *protocol)
{
    char text[200];

    client_connect(&client, viewed.url);
    TEST_ASSERT_EQUAL_INT(101, client_upgrade(&client, viewed.host, protocol, NULL));
    snprintf(text, sizeof text, "{\"op\":\"serverInfo\",\"name\":\"muster\"");
    struct client_message message = client_receive(&client);
    TEST_ASSERT_EQUAL_INT(CLIENT_TEXT, message.opcode);
    TEST_ASSERT_EQUAL_INT(0, memcmp(message.bytes, text, strlen(text)));
    char *advertise = foxglove_advertise();
    viewed_expect(&client, advertise);
    free(advertise);
}

static void subscribe(enum topic topic)
{
    char text[200];

    snprintf(text, sizeof text,
             "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":%d,\"channelId\":%d}]}",
             SUBSCRIPTION + topic, topic + 1);
    client_send_text(&client, text);
}

static void unsubscribe(enum topic topic)
{
    char text[200];

    snprintf(text, sizeof text, "{\"op\":\"unsubscribe\",\"subscriptionIds\":[%d]}",
             SUBSCRIPTION + topic);
    client_send_text(&client, text);
}

/* The next message is one of this topic, with these bytes. */
static void expect(enum topic topic, int32_t time_ms, const uint8_t *bytes, size_t count)
{
    struct foxglove viewer = {0};
    uint8_t head[FOXGLOVE_HEAD];
    struct client_message message = client_receive(&client);

    viewer.subscription[topic] = SUBSCRIPTION + topic;
    foxglove_head(&viewer, topic, time_ms, head);
    TEST_ASSERT_EQUAL_INT(CLIENT_BINARY, message.opcode);
    TEST_ASSERT_EQUAL_UINT(FOXGLOVE_HEAD + count, message.count);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(head, message.bytes, FOXGLOVE_HEAD);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(bytes, message.bytes + FOXGLOVE_HEAD, count);
}

static void expect_topic(enum topic topic)
{
    static uint8_t bytes[65536];
    size_t count = topic_write(topic, &scene, bytes, sizeof bytes);

    TEST_ASSERT_GREATER_THAN_UINT(0, count);
    expect(topic, scene.time_ms, bytes, count);
}

static void expect_time(void)
{
    uint8_t time[FOXGLOVE_TIME];
    struct client_message message = client_receive(&client);

    foxglove_time(scene.time_ms, time);
    TEST_ASSERT_EQUAL_UINT(sizeof time, message.count);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(time, message.bytes, sizeof time);
}

static void test_what_is_subscribed_to_comes(void)
{
    show(1000);
    join(FOXGLOVE_PROTOCOL);
    expect_time();
    subscribe(TOPIC_FLEET);
    expect(TOPIC_FLEET, 1000, fleet, fleet_count);
    subscribe(TOPIC_POSES);
    expect_topic(TOPIC_POSES);
    show(1020);
    expect_time();
    expect(TOPIC_FLEET, 1020, fleet, fleet_count);
    expect_topic(TOPIC_POSES);
    unsubscribe(TOPIC_FLEET);
    subscribe(TOPIC_LEADER);
    expect_topic(TOPIC_LEADER);
    show(1040);
    expect_time();
    expect_topic(TOPIC_POSES);
    expect_topic(TOPIC_LEADER);
}

static void test_every_topic_has_its_message(void)
{
    join(FOXGLOVE_PROTOCOL_OLD);
    for (enum topic topic = TOPIC_TF; topic < TOPIC_COUNT; topic++)
        subscribe(topic);
    unsubscribe(TOPIC_FLEET); /* refused: when the answer is there, so are the subscriptions */
    struct client_message message = client_receive(&client);
    TEST_ASSERT_EQUAL_INT(CLIENT_TEXT, message.opcode);
    show(500);
    expect_time();
    for (enum topic topic = TOPIC_TF; topic < TOPIC_COUNT; topic++)
        expect_topic(topic);
}

static void test_every_event_comes_also_those_of_before(void)
{
    uint8_t log[SCENE_EVENT_MAX];
    struct scene_event event = {.robot = 3, .event = "vertex_won", .detail = "2"};
    size_t count = 0;

    for (event.time_ms = 0; event.time_ms < 200; event.time_ms++) {
        count = scene_event_write(&event, log, sizeof log);
        view_event(viewed.view, event.time_ms, log, count);
    }
    join(FOXGLOVE_PROTOCOL);
    subscribe(TOPIC_EVENTS);
    for (event.time_ms = 0; event.time_ms < 200; event.time_ms++) {
        count = scene_event_write(&event, log, sizeof log);
        expect(TOPIC_EVENTS, event.time_ms, log, count);
    }
    count = scene_event_write(&event, log, sizeof log);
    view_event(viewed.view, event.time_ms, log, count);
    expect(TOPIC_EVENTS, event.time_ms, log, count);
}

static int64_t now_us(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}

static void subscribe_to_fleet(void)
{
    subscribe(TOPIC_FLEET);
    unsubscribe(TOPIC_TF); /* refused: from here on there is a subscription */
    while (client_receive(&client).opcode == CLIENT_BINARY)
        ;
}

static void test_scenes_come_no_more_than_thirty_times_a_second(void)
{
    enum { FRAMES = 7 };

    join(FOXGLOVE_PROTOCOL);
    subscribe_to_fleet();
    int64_t began_us = now_us();
    for (int i = 0; i < FRAMES; i++) {
        show(i * 20);
        expect_time();
        expect(TOPIC_FLEET, i * 20, fleet, fleet_count);
    }
    TEST_ASSERT_GREATER_OR_EQUAL_INT64((FRAMES - 1) * 33000, now_us() - began_us);
}

static void test_of_many_scenes_the_newest_comes(void)
{
    uint8_t last[FOXGLOVE_TIME];
    struct client_message message;

    join(FOXGLOVE_PROTOCOL);
    subscribe_to_fleet();
    for (int i = 0; i < 1000; i++)
        show(i * 20);
    foxglove_time(scene.time_ms, last);
    do
        message = client_receive(&client);
    while (message.count != sizeof last || memcmp(message.bytes, last, sizeof last) != 0);
    expect(TOPIC_FLEET, scene.time_ms, fleet, fleet_count);
}

static void test_what_is_played_comes_in_place_of_the_newest(void)
{
    uint8_t older[sizeof fleet];

    show(1000);
    memcpy(older, fleet, fleet_count);
    show(2000);
    join(FOXGLOVE_PROTOCOL);
    subscribe_to_fleet();
    view_play(viewed.view, older, fleet_count);
    struct client_message message;
    do
        message = client_receive(&client);
    while (message.count != FOXGLOVE_HEAD + fleet_count ||
           memcmp(message.bytes + FOXGLOVE_HEAD, older, fleet_count) != 0);
}

static void test_what_it_may_not_is_refused_in_words(void)
{
    char text[400];
    struct act act;

    join(FOXGLOVE_PROTOCOL);
    viewed_ask(&viewed, &client, 1, "\"estop\"");
    viewed_text(&client, text, sizeof text);
    TEST_ASSERT_NOT_NULL(strstr(text, "\"op\":\"status\""));
    client_send(&client, CLIENT_BINARY, true, "\x01\x02", 2);
    viewed_text(&client, text, sizeof text);
    TEST_ASSERT_NOT_NULL(strstr(text, "\"op\":\"status\""));
    TEST_ASSERT_FALSE(view_next_act(viewed.view, &act));
    subscribe(TOPIC_FLEET);
    show(0);
    expect_time();
    expect(TOPIC_FLEET, 0, fleet, fleet_count);
}

static void test_the_end_is_told(void)
{
    join(FOXGLOVE_PROTOCOL);
    viewed_close(&viewed);
    TEST_ASSERT_EQUAL_INT(CLIENT_CLOSE, client_receive(&client).opcode);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_subscribed_to_comes);
    RUN_TEST(test_every_topic_has_its_message);
    RUN_TEST(test_every_event_comes_also_those_of_before);
    RUN_TEST(test_scenes_come_no_more_than_thirty_times_a_second);
    RUN_TEST(test_of_many_scenes_the_newest_comes);
    RUN_TEST(test_what_is_played_comes_in_place_of_the_newest);
    RUN_TEST(test_what_it_may_not_is_refused_in_words);
    RUN_TEST(test_the_end_is_told);
    return UNITY_END();
}
