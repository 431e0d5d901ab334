#include "newest.h"

#include <string.h>
#include <unity.h>

static struct newest newest;

void setUp(void)
{
    memset(&newest, 0, sizeof newest);
}

void tearDown(void)
{
}

/* Holds a frame of such a number and such bodies, whose ids are letters. */
static const struct capture_frame *hold(uint32_t number, const char *ids)
{
    struct capture_frame *blank = newest_blank(&newest);

    blank->number = number;
    blank->count = strlen(ids);
    for (size_t i = 0; i < blank->count; i++)
        blank->body[i] = (struct capture_body){.id = ids[i]};
    return newest_hold(&newest, (int64_t)number * 10);
}

static void test_later_news_of_the_same_bodies_replaces(void)
{
    TEST_ASSERT_NULL(hold(1, "abc"));
    TEST_ASSERT_NULL(hold(2, "abc"));
    TEST_ASSERT_NULL(hold(3, "cab"));
    TEST_ASSERT_NULL(hold(4, "dcab"));
    TEST_ASSERT_EQUAL_UINT(3, newest.skipped);
    TEST_ASSERT_EQUAL_INT64(40, newest.arrival_us);
    TEST_ASSERT_EQUAL_UINT(4, newest_release(&newest)->number);
    TEST_ASSERT_NULL(newest_release(&newest));
}

static void test_news_of_another_body_is_kept(void)
{
    TEST_ASSERT_NULL(hold(1, "a"));
    TEST_ASSERT_EQUAL_UINT(1, hold(2, "b")->number);
    TEST_ASSERT_EQUAL_INT64(10, newest.displaced_us);
    TEST_ASSERT_EQUAL_UINT(2, hold(3, "a")->number);
    TEST_ASSERT_EQUAL_INT64(20, newest.displaced_us);
    TEST_ASSERT_EQUAL_UINT(3, newest_release(&newest)->number);
    TEST_ASSERT_EQUAL_UINT(0, newest.skipped);
}

static void test_a_body_that_is_missing_later_is_kept(void)
{
    hold(1, "ab");
    TEST_ASSERT_EQUAL_UINT(1, hold(2, "ac")->number);
    TEST_ASSERT_EQUAL_UINT(2, newest_release(&newest)->number);
}

static void test_bodies_of_one_number_differ_by_name(void)
{
    newest_blank(&newest)->count = 1;
    newest_blank(&newest)->body[0] = (struct capture_body){.id = 1, .name = "one"};
    newest_hold(&newest, 1);
    newest_blank(&newest)->count = 1;
    newest_blank(&newest)->body[0] = (struct capture_body){.id = 1, .name = "other"};
    TEST_ASSERT_EQUAL_STRING("one", newest_hold(&newest, 2)->body[0].name);
}

static void test_what_was_released_is_not_displaced(void)
{
    hold(1, "a");
    newest_release(&newest);
    TEST_ASSERT_NULL(hold(2, "b"));
    TEST_ASSERT_EQUAL_UINT(0, newest.skipped);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_later_news_of_the_same_bodies_replaces);
    RUN_TEST(test_news_of_another_body_is_kept);
    RUN_TEST(test_a_body_that_is_missing_later_is_kept);
    RUN_TEST(test_bodies_of_one_number_differ_by_name);
    RUN_TEST(test_what_was_released_is_not_displaced);
    return UNITY_END();
}
