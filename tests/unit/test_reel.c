#include "reel.h"

#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define MESSAGE 100 /* bytes */
#define RECORD 112  /* with its head, to a multiple of 8 */
#define ROOM 65536

static struct reel *reel;
static struct reel_reader reader;
static uint8_t bytes[ROOM];

static void open_reel(size_t limit)
{
    reel = reel_open(limit);
    TEST_ASSERT_NOT_NULL(reel);
}

void setUp(void)
{
    reader = (struct reel_reader){0};
}

void tearDown(void)
{
    reel_close(reel);
    reel = NULL;
}

static void add(enum reel_kind kind, int32_t time_ms)
{
    uint8_t message[MESSAGE];

    memset(message, (uint8_t)(time_ms / 20), sizeof message);
    memcpy(message, &time_ms, sizeof time_ms);
    TEST_ASSERT_TRUE(reel_add(reel, kind, time_ms, message, sizeof message));
}

static void add_scenes(int count)
{
    for (int i = 0; i < count; i++)
        add(REEL_SCENE, i * 20);
}

static uint32_t u32(const uint8_t *at)
{
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

/* The numbers of what is taken next, of one kind. */
static size_t take(enum reel_kind kind, size_t room, uint32_t *numbers)
{
    size_t count = reel_take(reel, &reader, bytes, room);
    size_t found = 0;

    TEST_ASSERT_LESS_OR_EQUAL_UINT(room, count);
    for (size_t at = 0; at < count; at += RECORD) {
        TEST_ASSERT_EQUAL_UINT32(MESSAGE, u32(bytes + at + 8));
        if (bytes[at] == kind)
            numbers[found++] = u32(bytes + at + 4);
    }
    return found;
}

static void test_a_record_is_laid_out_as_promised(void)
{
    const uint8_t message[] = {0, 1, 0, 0, 0xAA, 0xBB, 0xCC};
    const uint8_t expected[] = {1, 0, 0, 0, 0,    0,    0,    0, 7, 0, 0, 0,
                                0, 1, 0, 0, 0xAA, 0xBB, 0xCC, 0, 0, 0, 0, 0};

    open_reel(ROOM);
    reel_add(reel, REEL_SCENE, 0, message, sizeof message);
    TEST_ASSERT_EQUAL_UINT(sizeof expected, reel_take(reel, &reader, bytes, ROOM));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, bytes, sizeof expected);
    reel_add(reel, REEL_EVENT, 0, message, sizeof message);
    TEST_ASSERT_EQUAL_UINT(sizeof expected, reel_take(reel, &reader, bytes, ROOM));
    TEST_ASSERT_EQUAL_UINT8(REEL_EVENT, bytes[0]);
    TEST_ASSERT_EQUAL_UINT(0, reel_take(reel, &reader, bytes, ROOM));
}

static void test_who_keeps_up_gets_all_in_order(void)
{
    uint32_t numbers[4];

    open_reel(ROOM);
    for (uint32_t i = 0; i < 100; i++) {
        add(REEL_SCENE, (int32_t)i * 20);
        TEST_ASSERT_EQUAL_UINT(1, take(REEL_SCENE, ROOM, numbers));
        TEST_ASSERT_EQUAL_UINT32(i, numbers[0]);
    }
}

static void test_who_is_late_gets_the_newest_then_the_rest(void)
{
    uint32_t numbers[8];
    bool had[100] = {false};

    open_reel(ROOM);
    add_scenes(100);
    TEST_ASSERT_EQUAL_UINT(4, take(REEL_SCENE, 4 * RECORD, numbers));
    TEST_ASSERT_EQUAL_UINT32(96, numbers[0]);
    TEST_ASSERT_EQUAL_UINT32(99, numbers[3]);
    for (int i = 96; i < 100; i++)
        had[i] = true;
    for (int round = 0; round < 24; round++) {
        TEST_ASSERT_EQUAL_UINT(4, take(REEL_SCENE, 4 * RECORD, numbers));
        for (int i = 0; i < 4; i++) {
            TEST_ASSERT_FALSE(had[numbers[i]]);
            had[numbers[i]] = true;
        }
    }
    for (int i = 0; i < 100; i++)
        TEST_ASSERT_TRUE(had[i]);
    TEST_ASSERT_EQUAL_UINT(0, reel_take(reel, &reader, bytes, ROOM));
}

static void test_news_come_before_gaps_are_filled(void)
{
    uint32_t numbers[4];

    open_reel(ROOM);
    add_scenes(50);
    take(REEL_SCENE, RECORD, numbers);
    add(REEL_SCENE, 5000);
    TEST_ASSERT_EQUAL_UINT(1, take(REEL_SCENE, RECORD, numbers));
    TEST_ASSERT_EQUAL_UINT32(50, numbers[0]);
    TEST_ASSERT_EQUAL_UINT(1, take(REEL_SCENE, RECORD, numbers));
    TEST_ASSERT_EQUAL_UINT32(48, numbers[0]);
}

/* Many more gaps than are remembered: what comes twice is allowed, what never comes is not. */
static void test_every_gap_is_filled_in_the_end(void)
{
    enum { COUNT = 400 };
    uint32_t numbers[8];
    unsigned had[COUNT] = {0};

    open_reel(ROOM);
    for (int i = 0; i < COUNT; i++) {
        add(REEL_SCENE, i * 20);
        if (i % 7 == 6) {
            TEST_ASSERT_EQUAL_UINT(2, take(REEL_SCENE, 2 * RECORD, numbers));
            TEST_ASSERT_EQUAL_UINT32(i, numbers[1]);
            had[numbers[0]]++;
            had[numbers[1]]++;
        }
    }
    for (size_t count; (count = take(REEL_SCENE, 8 * RECORD, numbers)) > 0;)
        for (size_t i = 0; i < count; i++)
            had[numbers[i]]++;
    for (int i = 0; i < COUNT; i++)
        TEST_ASSERT_GREATER_THAN_UINT(0, had[i]);
}

static void test_a_long_run_is_kept_whole_and_coarser(void)
{
    enum { COUNT = 20000 };
    static uint32_t numbers[1000];
    static bool had[COUNT];
    size_t kept = 0;
    struct reel_message newest;

    open_reel(ROOM);
    for (uint32_t i = 0; i < COUNT; i++) {
        add(REEL_SCENE, (int32_t)i * 20);
        TEST_ASSERT_TRUE(reel_newest(reel, &newest));
        TEST_ASSERT_EQUAL_UINT32(i, newest.number);
    }
    for (size_t count; (count = take(REEL_SCENE, ROOM, numbers)) > 0; kept += count)
        for (size_t i = 0; i < count; i++)
            had[numbers[i]] = true;
    TEST_ASSERT_LESS_THAN_UINT(ROOM / RECORD, kept);
    TEST_ASSERT_GREATER_THAN_UINT(ROOM / RECORD / 4, kept);
    int stride = 1;
    while (!had[stride])
        stride++;
    for (int i = 0; i < COUNT - 1; i++)
        TEST_ASSERT_EQUAL_INT(i % stride == 0, had[i]);
}

static void test_a_scene_of_the_same_time_takes_the_others_place(void)
{
    uint32_t numbers[4];

    open_reel(ROOM);
    add(REEL_SCENE, 0);
    add(REEL_SCENE, 20);
    add(REEL_SCENE, 20);
    add(REEL_SCENE, 20);
    TEST_ASSERT_EQUAL_UINT(2, take(REEL_SCENE, ROOM, numbers));
    TEST_ASSERT_EQUAL_UINT32(0, numbers[0]);
    TEST_ASSERT_EQUAL_UINT32(3, numbers[1]);
}

static void test_of_many_events_the_newer_half_stays(void)
{
    static uint32_t numbers[1000];
    struct reel_message event;

    open_reel(ROOM);
    for (int i = 0; i < 1000; i++)
        add(REEL_EVENT, 20);
    size_t count = take(REEL_EVENT, ROOM, numbers);
    TEST_ASSERT_GREATER_THAN_UINT(ROOM / 8 / RECORD / 4, count);
    TEST_ASSERT_LESS_THAN_UINT(ROOM / 8 / RECORD, count);
    TEST_ASSERT_EQUAL_UINT32(999, numbers[count - 1]);
    TEST_ASSERT_EQUAL_UINT32(1000 - count, numbers[0]);
    TEST_ASSERT_TRUE(reel_event(reel, 0, &event));
    TEST_ASSERT_EQUAL_UINT32(numbers[0], event.number);
    TEST_ASSERT_TRUE(reel_event(reel, 999, &event));
    TEST_ASSERT_EQUAL_INT32(20, event.time_ms);
    TEST_ASSERT_FALSE(reel_event(reel, 1000, &event));
}

static void test_neither_kind_keeps_the_other_out(void)
{
    uint32_t numbers[4];

    open_reel(ROOM);
    for (int i = 0; i < 50; i++) {
        add(REEL_SCENE, i * 20);
        add(REEL_EVENT, i * 20);
    }
    struct reel_reader before = reader;
    TEST_ASSERT_EQUAL_UINT(4 * RECORD, reel_room(reel));
    TEST_ASSERT_EQUAL_UINT(2, take(REEL_EVENT, reel_room(reel), numbers));
    reader = before;
    TEST_ASSERT_EQUAL_UINT(2, take(REEL_SCENE, reel_room(reel), numbers));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_record_is_laid_out_as_promised);
    RUN_TEST(test_who_keeps_up_gets_all_in_order);
    RUN_TEST(test_who_is_late_gets_the_newest_then_the_rest);
    RUN_TEST(test_news_come_before_gaps_are_filled);
    RUN_TEST(test_every_gap_is_filled_in_the_end);
    RUN_TEST(test_a_long_run_is_kept_whole_and_coarser);
    RUN_TEST(test_a_scene_of_the_same_time_takes_the_others_place);
    RUN_TEST(test_of_many_events_the_newer_half_stays);
    RUN_TEST(test_neither_kind_keeps_the_other_out);
    return UNITY_END();
}
