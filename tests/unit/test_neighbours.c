#include "neighbours.h"

#include <unity.h>

static struct neighbours table;
static const struct vec32 here = {0, 0};

void setUp(void)
{
    table.count = 0;
}

void tearDown(void)
{
}

static struct message_beacon beacon(uint16_t id, int32_t x, bool candidate)
{
    return (struct message_beacon){
        .id = id, .pose = {{x, 0}, 0}, .candidate = candidate, .vertex = id};
}

static bool hear(uint16_t id, int32_t x, bool candidate, uint8_t tick)
{
    struct message_beacon heard = beacon(id, x, candidate);

    return neighbours_hear(&table, &heard, tick, &here);
}

static void test_a_newer_beacon_replaces_the_older(void)
{
    hear(7, 100, false, 1);
    hear(7, 200, false, 2);
    TEST_ASSERT_EQUAL(1, table.count);
    TEST_ASSERT_EQUAL_INT32(200, neighbours_find(&table, 7)->pose.at.x);
    TEST_ASSERT_NULL(neighbours_find(&table, 8));
}

static void test_the_silent_are_forgotten(void)
{
    hear(1, 0, false, 250);
    hear(2, 0, false, 10);
    neighbours_expire(&table, (uint8_t)(250 + NEIGHBOUR_TIMEOUT_TICKS));
    TEST_ASSERT_EQUAL(2, table.count);
    neighbours_expire(&table, (uint8_t)(251 + NEIGHBOUR_TIMEOUT_TICKS));
    TEST_ASSERT_EQUAL(1, table.count);
    TEST_ASSERT_NOT_NULL(neighbours_find(&table, 2));
}

static void fill(bool candidates)
{
    for (uint16_t id = 1; id <= NEIGHBOURS_MAX; id++)
        TEST_ASSERT_TRUE(hear(id, id * 100, candidates, 0));
}

static void test_in_a_full_table_the_farthest_gives_way_to_a_nearer(void)
{
    fill(false);
    TEST_ASSERT_FALSE(hear(100, 10000, false, 0));
    TEST_ASSERT_TRUE(hear(101, -50, false, 0));
    TEST_ASSERT_NULL(neighbours_find(&table, NEIGHBOURS_MAX));
    TEST_ASSERT_EQUAL(NEIGHBOURS_MAX, table.count);
}

static void test_a_candidate_is_kept_however_far(void)
{
    fill(false);
    TEST_ASSERT_TRUE(hear(100, 1000000, true, 0));
    TEST_ASSERT_TRUE(hear(101, 1, false, 0));
    TEST_ASSERT_NOT_NULL(neighbours_find(&table, 100));
}

static void test_candidates_do_not_give_way(void)
{
    fill(true);
    TEST_ASSERT_FALSE(hear(100, 1, true, 0));
    TEST_ASSERT_FALSE(hear(101, 1, false, 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_newer_beacon_replaces_the_older);
    RUN_TEST(test_the_silent_are_forgotten);
    RUN_TEST(test_in_a_full_table_the_farthest_gives_way_to_a_nearer);
    RUN_TEST(test_a_candidate_is_kept_however_far);
    RUN_TEST(test_candidates_do_not_give_way);
    return UNITY_END();
}
