#include "turns.h"

#include <string.h>
#include <unity.h>

static struct turns_place place[3];
static struct turns turns;
static char words[160];

void setUp(void)
{
    for (size_t i = 0; i < 3; i++)
        place[i] = (struct turns_place){.id = (uint16_t)(i + 11)};
    turns = (struct turns){.count = 3, .place = place};
    words[0] = '\0';
}

void tearDown(void)
{
}

static enum turn take(size_t robot)
{
    return turns_take(&turns, robot, words, sizeof words);
}

static void test_one_by_one(void)
{
    turns_see(&turns, 0, 0, 0);
    turns_see(&turns, 1, 5, 0);
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(0));
    TEST_ASSERT_EQUAL(TURN_LATER, take(1));
    TEST_ASSERT_EQUAL_STRING("waits for robot 11", words);
    turns_leave(&turns, 0);
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(1));
}

static void test_together_where_they_are_far_apart(void)
{
    turns.together = true;
    turns_see(&turns, 0, 0, 0);
    turns_see(&turns, 1, 1.21, 0);
    turns_see(&turns, 2, 0, 1.19);
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(0));
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(1));
    TEST_ASSERT_EQUAL(TURN_LATER, take(2));
    turns_leave(&turns, 0);
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(2));
}

static void test_nobody_stands_in_its_way(void)
{
    turns_see(&turns, 0, 0, 0);
    turns_see(&turns, 1, 0, -0.59);
    TEST_ASSERT_EQUAL(TURN_NEVER, take(0));
    TEST_ASSERT_EQUAL_STRING(
        "robot 12 stands 0.59 m from it, and it needs 0.6 m to drive: put them apart", words);
    turns_see(&turns, 1, 0, -0.61);
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(0));
}

/* It only has to be waited for, and then it may be in the way. */
static void test_who_drives_stands_in_nobodys_way(void)
{
    turns_see(&turns, 0, 0, 0);
    turns_see(&turns, 1, 0.7, 0);
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(0));
    turns_see(&turns, 1, 0.55, 0);
    TEST_ASSERT_EQUAL(TURN_LATER, take(1));
    turns_leave(&turns, 0);
    TEST_ASSERT_EQUAL(TURN_NEVER, take(1));
}

/* Where it began counts, not where it is just now. */
static void test_who_drives_has_its_room(void)
{
    turns.together = true;
    turns_see(&turns, 0, 0, 0);
    turns_see(&turns, 1, 1.21, 0);
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(0));
    turns_see(&turns, 0, 0.3, 0);
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(1));
}

static void test_who_is_not_seen_is_nowhere(void)
{
    turns_see(&turns, 0, 0.1, 0);
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(0));
}

static void test_the_fence(void)
{
    turns.fenced = true;
    memcpy(turns.fence, (double[4]){-2, -1, 2, 1}, sizeof turns.fence);
    turns_see(&turns, 0, 0, 0.51);
    TEST_ASSERT_EQUAL(TURN_NEVER, take(0));
    TEST_ASSERT_EQUAL_STRING(
        "stands 0.49 m from the fence, and needs 0.5 m to drive: put it farther in", words);
    turns_see(&turns, 0, -1.49, -0.49);
    TEST_ASSERT_EQUAL(TURN_TAKEN, take(0));
    turns_leave(&turns, 0);
    turns_see(&turns, 0, 3, 0);
    TEST_ASSERT_EQUAL(TURN_NEVER, take(0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_by_one);
    RUN_TEST(test_together_where_they_are_far_apart);
    RUN_TEST(test_nobody_stands_in_its_way);
    RUN_TEST(test_who_drives_stands_in_nobodys_way);
    RUN_TEST(test_who_drives_has_its_room);
    RUN_TEST(test_who_is_not_seen_is_nowhere);
    RUN_TEST(test_the_fence);
    return UNITY_END();
}
