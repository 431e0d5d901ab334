#include "link_loss.h"

#include <unity.h>

static struct link_loss loss;

void setUp(void)
{
    loss = (struct link_loss){0};
}

void tearDown(void)
{
}

static double look(uint32_t frames, uint32_t bad_frames)
{
    return link_loss_look(&loss, &(struct server_view){.frames = frames, .bad_frames = bad_frames});
}

static void test_it_is_the_part_lost_since_the_last_look(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.25, look(30, 10));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, look(40, 20));
    TEST_ASSERT_EQUAL_DOUBLE(0, look(50, 20));
    TEST_ASSERT_EQUAL_DOUBLE(1, look(50, 21));
}

static void test_of_no_frames_none_is_lost(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0, look(0, 0));
    look(10, 10);
    TEST_ASSERT_EQUAL_DOUBLE(0, look(10, 10));
}

static void test_a_link_that_begins_anew_has_lost_nothing_yet(void)
{
    look(100, 50);
    TEST_ASSERT_EQUAL_DOUBLE(0, look(3, 1));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, look(4, 2));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_is_the_part_lost_since_the_last_look);
    RUN_TEST(test_of_no_frames_none_is_lost);
    RUN_TEST(test_a_link_that_begins_anew_has_lost_nothing_yet);
    return UNITY_END();
}
