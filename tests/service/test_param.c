#include "hand.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

static struct hand hand;
static const unsigned four[] = {1, 2, 3, 4, 0};

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

static void add_four(void)
{
    hand_add(&hand, (const char *const[]){"--robots", "native", "--id", "1..4", "--link",
                                          "tcp:127.0.0.1:0", "--quiet", NULL});
}

static void test_four_robots_are_read_and_changed_at_once(void)
{
    add_four();
    const char *site = hand_site(&hand, four);

    TEST_ASSERT_EQUAL_INT(0, RUN("param", "set", site, "--robots", "2-3", "track=0.085"));
    has_said("robot 2: track 0.0000 m -> 0.0850 m\n");
    has_said("robot 3: track 0.0000 m -> 0.0850 m\n");
    has_said("Not saved yet");
    TEST_ASSERT_FALSE(hand_said(&hand, "robot 1"));

    TEST_ASSERT_EQUAL_INT(0, RUN("param", "list", site));
    has_said("the same in all 4 robots:");
    has_said("    1   0.0000 m");
    has_said("    2*  0.0850 m");
    has_said("* not saved");

    TEST_ASSERT_EQUAL_INT(0, RUN("param", "save", site));
    has_said("robot 1: was saved already\n");
    has_said("robot 3: saved\n");

    TEST_ASSERT_EQUAL_INT(0, RUN("param", "reset", site, "--robots", "2", "--save"));
    has_said("robot 2: track 0.0850 m -> 0.0000 m\n");
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "get", site, "track"));
    has_said("    2   0.0000 m");
    has_said("    3   0.0850 m");
}

static void test_a_file_holds_what_robots_are_set_to(void)
{
    char path[128];

    add_four();
    const char *site = hand_site(&hand, four);
    snprintf(path, sizeof path, "%s/parameters.yaml", hand.directory);
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "set", site, "--robots", "4", "motor_lag=0.07"));
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "get", site, "--out", path));
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "reset", site));
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "set", site, "--from", path, "battery_warning=7"));
    has_said("robot 4: motor_lag 0.000 s -> 0.070 s\n");
    has_said("robot 1: battery_warning 6.600 V -> 7.000 V\n");
    has_said("robot 1: motor_lag is 0.000 s already\n");
}

/* On a chip, through a pty. */
static void test_what_is_saved_outlives_a_power_cycle(void)
{
    char link[128];

    snprintf(link, sizeof link, "pty:%s/robot", hand.directory);
    hand_add(&hand, (const char *const[]){"--id", "1", "--link", link, "--firmware", STAGE_FIRMWARE,
                                          "--quiet", NULL});
    const char *site = hand_site(&hand, (const unsigned[]){1, 0});

    TEST_ASSERT_EQUAL_INT(0, RUN("param", "set", site, "--save", "left_gain=0.75"));
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "set", site, "right_gain=0.875"));
    hand_power_cycle(&hand, 0);
    do {
        TEST_ASSERT_EQUAL_INT(0, RUN("param", "get", site, "left_gain", "right_gain", "eeprom"));
        has_said("0.75000");
    } while (hand_said(&hand, "0.87500"));
    has_said("1.00000       2\n");
}

static void test_values_are_judged_before_anything_is_sent(void)
{
    const char *site = hand_site(&hand, four);

    TEST_ASSERT_EQUAL_INT(2, RUN("param", "set", site, "left_gain=3"));
    TEST_ASSERT_EQUAL_INT(2, RUN("param", "set", site, "image=3"));
    TEST_ASSERT_EQUAL_INT(2, RUN("param", "set", site, "lef_gain=1"));
    has_said("perhaps 'left_gain'");
    TEST_ASSERT_EQUAL_INT(2, RUN("param", "set", site, "id=3"));
    has_said("one id for 4 robots");
    TEST_ASSERT_EQUAL_INT(2, RUN("param", "get", site, "--robots", "3-5"));
    has_said("has no robot 5");
}

static void test_a_robot_that_is_not_there_does_not_hold_up_the_others(void)
{
    add_four();
    const char *site = hand_site(&hand, (const unsigned[]){1, 2, 3, 4, 5, 0});

    TEST_ASSERT_EQUAL_INT(1, RUN("param", "set", site, "track=0.1", "--save"));
    has_said("robot 4: track 0.0000 m -> 0.1000 m\n");
    has_said("robot 5 (tty:");
    has_said("no such device");
}

static void test_an_interrupt_ends_it_at_once(void)
{
    hand_add(&hand, (const char *const[]){"--robots", "native", "--id", "1", "--link",
                                          "tcp:127.0.0.1:0", NULL});
    const char *site = hand_site(&hand, (const unsigned[]){1, 2, 0});

    hand_start(&hand, (const char *const[]){"param", "list", site, NULL});
    hand_hears(&hand, 0, "its host is there");
    process_signal(&hand.command, SIGINT);
    TEST_ASSERT_EQUAL_INT(1, hand_end(&hand));
    has_said("muster param: interrupted\n");
    TEST_ASSERT_FALSE(hand_said(&hand, "no such device"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_four_robots_are_read_and_changed_at_once);
    RUN_TEST(test_a_file_holds_what_robots_are_set_to);
    RUN_TEST(test_what_is_saved_outlives_a_power_cycle);
    RUN_TEST(test_values_are_judged_before_anything_is_sent);
    RUN_TEST(test_a_robot_that_is_not_there_does_not_hold_up_the_others);
    RUN_TEST(test_an_interrupt_ends_it_at_once);
    return UNITY_END();
}
