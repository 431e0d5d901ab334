#include "hand.h"

#include <stdio.h>
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

/* On a chip, which has a program, a stack and a tick to be looked at. A machine that is busy with
 * something else may make it late. */
static void test_a_good_robot_is_good(void)
{
    hand_add(&hand, (const char *const[]){"--id", "3", "--link", "tcp:127.0.0.1:0", "--firmware",
                                          STAGE_FIRMWARE, "--quiet", NULL});
    const char *site = hand_site(&hand, (const unsigned[]){3, 0});

    int status = RUN("doctor", site, "--seconds", "1");
    for (unsigned tries = 1; status != 0 && tries < 5; tries++)
        status = RUN("doctor", site, "--seconds", "1");
    TEST_ASSERT_EQUAL_INT(0, status);
    has_said("  good  robot 3\n");
    has_said("power-on");
    has_said("All good.\n");
}

static void test_what_is_wrong_is_told_of_each(void)
{
    hand_add(&hand, (const char *const[]){"--robots", "native", "--id", "1,2", "--link",
                                          "tcp:127.0.0.1:0", "--quiet", NULL});
    const char *site = hand_site(&hand, (const unsigned[]){1, 4, 0});

    TEST_ASSERT_EQUAL_INT(
        0, RUN("param", "set", site, "--robots", "1", "battery_warning=8", "--save"));
    TEST_ASSERT_EQUAL_INT(1, RUN("doctor", site, "--seconds", "1"));
    has_said("  BAD   robot 1: battery at 7.");
    has_said("  BAD   robot 4: says it is robot 2");
    has_said("Not all is good.\n");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_good_robot_is_good);
    RUN_TEST(test_what_is_wrong_is_told_of_each);
    return UNITY_END();
}
