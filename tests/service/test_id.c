#include "hand.h"

#include <string.h>
#include <unity.h>

static struct hand hand;

void setUp(void)
{
    hand_open(&hand);
}

void tearDown(void)
{
    hand_close(&hand);
}

#define RUN(...) hand_run(&hand, (const char *const[]){__VA_ARGS__, NULL})

static void has_said(const char *words)
{
    TEST_ASSERT_TRUE_MESSAGE(hand_said(&hand, words), words);
}

static void add_blank(const char *ids)
{
    hand_add(&hand, (const char *const[]){"--robots", "native", "--blank", "--id", ids, "--link",
                                          "tcp:127.0.0.1:0", "--quiet", NULL});
}

static void add_robot(const char *id)
{
    hand_add(&hand, (const char *const[]){"--robots", "native", "--id", id, "--link",
                                          "tcp:127.0.0.1:0", "--quiet", NULL});
}

static void test_robots_without_an_id_get_the_sites_and_keep_it(void)
{
    add_blank("1..3");
    const char *site = hand_site(&hand, (const unsigned[]){7, 8, 9, 0});

    TEST_ASSERT_EQUAL_INT(1, RUN("param", "list", site));
    has_said("has no id: `muster id' gives it the site's");
    TEST_ASSERT_EQUAL_INT(0, RUN("id", site));
    has_said("had no id, is robot 8 now\n");
    hand_power_cycle(&hand, 0);
    TEST_ASSERT_EQUAL_INT(0, RUN("id", site));
    has_said("is robot 9 already\n");
    TEST_ASSERT_FALSE(hand_said(&hand, "now"));
}

static void test_a_robot_with_another_id_is_left_alone_unless_forced(void)
{
    add_robot("5");
    const char *site = hand_site(&hand, (const unsigned[]){6, 0});

    TEST_ASSERT_EQUAL_INT(1, RUN("id", site));
    has_said("is robot 5, not 6, and is left alone");
    TEST_ASSERT_EQUAL_INT(0, RUN("id", site, "--force"));
    has_said("was robot 5, is robot 6 now\n");
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "get", site, "id"));
}

static void test_two_that_say_the_same_id_are_named_with_their_links(void)
{
    add_robot("1");
    add_robot("1");
    const char *site = hand_site(&hand, (const unsigned[]){1, 2, 0});

    TEST_ASSERT_EQUAL_INT(1, RUN("id", site));
    has_said("both say they are robot 1");
    has_said(hand.link[0]);
    has_said(hand.link[1]);
    TEST_ASSERT_EQUAL_INT(0, RUN("id", site, "--force"));
    has_said("was robot 1, is robot 2 now\n");
}

static void test_links_without_a_site_get_ids_in_a_row(void)
{
    char line[256] = "  - {id: 7, link: \"";

    add_blank("1..2");
    add_robot("6");
    TEST_ASSERT_EQUAL_INT(
        0, RUN("id", "--first", "5", hand.link[0], hand.link[1], hand.link[2], "--quiet"));
    strcat(line, hand.link[1]);
    strcat(line, "\"}\n");
    has_said("robots:\n  - {id: 5, link: \"tcp:");
    has_said(line);
    has_said("  - {id: 6, link: \"tcp:");
    const char *site = hand_site(&hand, (const unsigned[]){5, 7, 6, 0});
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "get", site, "id"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_robots_without_an_id_get_the_sites_and_keep_it);
    RUN_TEST(test_a_robot_with_another_id_is_left_alone_unless_forced);
    RUN_TEST(test_two_that_say_the_same_id_are_named_with_their_links);
    RUN_TEST(test_links_without_a_site_get_ids_in_a_row);
    return UNITY_END();
}
