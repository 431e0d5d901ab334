/* test_looking.c: what those who look are sent, whatever others do. */
#define _GNU_SOURCE /* memmem */

#include "viewed.h"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

#define HEAD 12 /* of a record */
#define KEPT_MAX ((size_t)64 << 20)

static struct viewed viewed;
static struct client client, other;

void setUp(void)
{
    viewed_open(&viewed, ACT_BIT(ACT_KILL) | ACT_BIT(ACT_MOVE));
}

void tearDown(void)
{
    client_close(&client);
    client_close(&other);
    viewed_close(&viewed);
}

static uint32_t u32(const uint8_t *at)
{
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

/* What somebody has been sent, by number; each with the bytes that belong to its time. */
struct diary {
    bool *had;
    uint32_t count;
    uint32_t newest, records;
};

static void check_record(struct diary *diary, const uint8_t *record)
{
    uint32_t number = u32(record + 4);
    size_t count = u32(record + 8);
    int32_t time_ms;

    TEST_ASSERT_EQUAL_UINT8(1, record[0]);
    TEST_ASSERT_LESS_THAN_UINT(diary->count, number);
    memcpy(&time_ms, record + HEAD + 4, sizeof time_ms);
    TEST_ASSERT_EQUAL_INT32((int32_t)number * 20, time_ms);
    TEST_ASSERT_EACH_EQUAL_UINT8(number % 251, record + HEAD + 8, count - 8);
    diary->had[number] = true;
    diary->records++;
    if (number > diary->newest)
        diary->newest = number;
}

static void read_message(const struct client_message *message, struct diary *diary)
{
    TEST_ASSERT_EQUAL_UINT(0, message->count % 8);
    for (size_t at = 0; at < message->count;) {
        check_record(diary, message->bytes + at);
        at += (HEAD + u32(message->bytes + at + 8) + 7) & ~(size_t)7;
    }
}

static void read_on(struct client *reader, struct diary *diary)
{
    struct client_message message = client_receive(reader);

    TEST_ASSERT_EQUAL_INT(CLIENT_BINARY, message.opcode);
    read_message(&message, diary);
}

static void test_the_greeting(void)
{
    static const char *const names[] = {"v", "y \"\\"};
    struct view_status status = {"running", false, false, 2.5, 2, names};

    client_connect(&client, viewed.url);
    client_upgrade(&client, viewed.host, VIEWED_PAGE, viewed.origin);
    viewed_expect(&client,
                  "{\"hello\":{\"version\":1,\"kind\":\"sim\",\"title\":\"a \\\"test\\\"\","
                  "\"duration\":60.0,\"acts\":[\"kill\",\"move\"]}}");
    view_status(viewed.view, &status);
    viewed_expect(&client, "{\"status\":{\"phase\":\"running\",\"paused\":false,\"over\":false,"
                           "\"speed\":2.5,\"formations\":[\"v\",\"y \\\"\\\\\"]}}");
    view_status(viewed.view, &status); /* nothing new: what comes next is */
    viewed_scene(&viewed, 0, 100);
    TEST_ASSERT_EQUAL_INT(CLIENT_BINARY, client_receive(&client).opcode);
    status = (struct view_status){.phase = "over", .over = true};
    view_status(viewed.view, &status);
    viewed_expect(&client, "{\"status\":{\"phase\":\"over\",\"paused\":false,\"over\":true,"
                           "\"speed\":0.0,\"formations\":[]}}");
    viewed_join(&viewed, &other);
    viewed_expect(&other, "{\"status\":{\"phase\":\"over\",\"paused\":false,\"over\":true,"
                          "\"speed\":0.0,\"formations\":[]}}");
    TEST_ASSERT_EQUAL_UINT(2, view_viewers(viewed.view));
    TEST_ASSERT_TRUE(view_looked_at(viewed.view));
}

static void test_what_happens_arrives_byte_by_byte(void)
{
    static const uint8_t fleet[] = {0, 1, 0, 0, 11, 12, 13, 14, 15};
    static const uint8_t log[] = {0, 1, 0, 0, 21};
    static const uint8_t first[] = {1, 0, 0, 0, 0,  0,  0,  0,  9,  0, 0, 0,
                                    0, 1, 0, 0, 11, 12, 13, 14, 15, 0, 0, 0};
    static const uint8_t second[] = {2, 0, 0, 0, 0,  0, 0, 0, 5, 0, 0, 0,
                                     0, 1, 0, 0, 21, 0, 0, 0, 0, 0, 0, 0};

    viewed_join(&viewed, &client);
    view_scene(viewed.view, 0, fleet, sizeof fleet);
    struct client_message message = client_receive(&client);
    TEST_ASSERT_EQUAL_INT(CLIENT_BINARY, message.opcode);
    TEST_ASSERT_EQUAL_UINT(sizeof first, message.count);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(first, message.bytes, sizeof first);
    view_event(viewed.view, 0, log, sizeof log);
    message = client_receive(&client);
    TEST_ASSERT_EQUAL_UINT(sizeof second, message.count);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(second, message.bytes, sizeof second);
}

static void test_who_joins_late_gets_the_past(void)
{
    enum { COUNT = 500 };
    bool had[COUNT] = {false};
    struct diary diary = {had, COUNT, 0, 0};

    for (int i = 0; i < COUNT; i++)
        viewed_scene(&viewed, i * 20, 1000);
    viewed_join(&viewed, &client);
    read_on(&client, &diary);
    TEST_ASSERT_EQUAL_UINT32(COUNT - 1, diary.newest);
    while (diary.records < COUNT)
        read_on(&client, &diary);
    for (int i = 0; i < COUNT; i++)
        TEST_ASSERT_TRUE(had[i]);
}

/* Who does not read has no way to be waited for: there is one thread here, and it reads only after
 * all has been handed over. */
static void test_a_viewer_that_never_reads_holds_up_nobody(void)
{
    enum { COUNT = 20000, BYTES = 10000 };
    static bool had[COUNT];
    struct diary diary = {had, COUNT, 0, 0};
    struct diary stuck = {had, COUNT, 0, 0};

    viewed_join(&viewed, &other);
    viewed_join(&viewed, &client);
    size_t before = mallinfo2().uordblks;
    for (int i = 0; i < COUNT; i++)
        viewed_scene(&viewed, i * 20, BYTES);
    TEST_ASSERT_LESS_THAN_UINT(before + KEPT_MAX + (4 << 20), mallinfo2().uordblks);
    while (diary.newest < COUNT - 1)
        read_on(&client, &diary);
    while (stuck.newest < COUNT - 1)
        read_on(&other, &stuck);
}

static void test_no_more_than_may_look(void)
{
    enum { MAX = 32 };
    struct client all[MAX];

    for (int i = 0; i < MAX; i++)
        viewed_join(&viewed, &all[i]);
    client_connect(&client, viewed.url);
    TEST_ASSERT_EQUAL_INT(503, client_upgrade(&client, viewed.host, VIEWED_PAGE, NULL));
    TEST_ASSERT_EQUAL_UINT(MAX, view_viewers(viewed.view));
    for (int i = 0; i < MAX; i++)
        client_close(&all[i]);
}

static void test_at_the_end_everybody_has_all_and_is_told(void)
{
    enum { COUNT = 1000 };
    bool had[COUNT] = {false};
    struct diary diary = {had, COUNT, 0, 0};
    struct view_status over = {.phase = "over", .over = true};
    struct client_message message;

    viewed_join(&viewed, &client);
    viewed_join(&viewed, &other); /* and never reads */
    for (int i = 0; i < COUNT; i++)
        viewed_scene(&viewed, i * 20, 50);
    view_status(viewed.view, &over);
    viewed_close(&viewed);
    while ((message = client_receive(&client)).opcode == CLIENT_BINARY)
        read_message(&message, &diary);
    TEST_ASSERT_EQUAL_INT(CLIENT_TEXT, message.opcode);
    TEST_ASSERT_NOT_NULL(memmem(message.bytes, message.count, "\"over\":true", 11));
    while ((message = client_receive(&client)).opcode == CLIENT_BINARY)
        read_message(&message, &diary);
    TEST_ASSERT_EQUAL_INT(CLIENT_CLOSE, message.opcode);
    TEST_ASSERT_EQUAL_UINT(COUNT, diary.records);
    TEST_ASSERT_EQUAL_UINT8_ARRAY("\x03\xE9", message.bytes, 2); /* 1001, going away */
}

static void test_the_end_does_not_wait_for_who_does_not_read(void)
{
    viewed_join(&viewed, &client);
    for (int i = 0; i < 1000; i++)
        viewed_scene(&viewed, i * 20, 50000);
    alarm(CLIENT_PATIENCE_S);
    viewed_close(&viewed);
    alarm(0);
}

static void test_a_second_view_is_another_one(void)
{
    struct viewed second;

    viewed_open(&second, 0);
    TEST_ASSERT_TRUE(strcmp(viewed.token, second.token) != 0);
    TEST_ASSERT_TRUE(strcmp(viewed.host, second.host) != 0);
    viewed_join(&second, &client);
    viewed_join(&viewed, &other);
    TEST_ASSERT_EQUAL_UINT(1, view_viewers(second.view));
    viewed_close(&second);
    TEST_ASSERT_EQUAL_INT(CLIENT_CLOSE, client_receive(&client).opcode);
    TEST_ASSERT_EQUAL_UINT(1, view_viewers(viewed.view));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_greeting);
    RUN_TEST(test_what_happens_arrives_byte_by_byte);
    RUN_TEST(test_who_joins_late_gets_the_past);
    RUN_TEST(test_a_viewer_that_never_reads_holds_up_nobody);
    RUN_TEST(test_no_more_than_may_look);
    RUN_TEST(test_at_the_end_everybody_has_all_and_is_told);
    RUN_TEST(test_the_end_does_not_wait_for_who_does_not_read);
    RUN_TEST(test_a_second_view_is_another_one);
    return UNITY_END();
}
