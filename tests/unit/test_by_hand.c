#include "by_hand.h"

#include "limits.h"
#include "rehearsal.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static struct by_hand hand;
static struct rehearsal_member member;
static struct link_timing timing;
static int64_t now_us;
static char said[4096];

static void hear(const char *words)
{
    strncat(said, words, sizeof said - strlen(said) - 2);
    strcat(said, "\n");
}

static void run_for(double seconds)
{
    for (int i = 0; i < seconds * TICKS_PER_S; i++)
        TEST_ASSERT_TRUE(rehearsal_tick(&member, 1, &timing, &now_us, NULL));
}

static void press(int key)
{
    said[0] = '\0';
    by_hand_press(&hand, key, now_us);
    run_for(0.3);
}

static void assert_said(const char *words)
{
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(said, words), said);
}

void setUp(void)
{
    timing = link_timing_of(NATIVE_BAUD);
    now_us = 1000000;
    said[0] = '\0';
    by_hand_begin(&hand, 1, hear);
    member = (struct rehearsal_member){
        .robot = robot_native_new(1),
        .job = &hand.job,
        .kind = {.track = 0.08, .wheel_max = 0.6, .left.gain = 1, .right.gain = 1},
    };
    TEST_ASSERT_TRUE(member.robot->kind->power_on(member.robot));
}

void tearDown(void)
{
    member.robot->kind->destroy(member.robot);
}

static uint16_t saved(uint8_t index)
{
    struct parameters parameters;

    member.robot->kind->power_off(member.robot);
    member.robot->kind->power_on(member.robot);
    parameters_read(&parameters, member.robot->eeprom);
    return parameters.value[index];
}

static void test_says_what_it_finds_and_which_keys_there_are(void)
{
    by_hand_press(&hand, 'l', now_us);
    assert_said("still being read");
    run_for(1);
    assert_said("left_gain 1.00000\nright_gain 1.00000\nleft_dead_band 0.00000\n"
                "right_dead_band 0.00000\narrows or space drive");
    press('x');
    assert_said("arrows or space drive");
}

/* At two fifths of full speed. */
static void test_drives_for_a_second(void)
{
    run_for(1);
    press(' ');
    run_for(1);
    TEST_ASSERT_DOUBLE_WITHIN(0.012, 0.24, member.body.x);
    press(BY_HAND_BACK);
    run_for(1);
    TEST_ASSERT_DOUBLE_WITHIN(0.012, 0, member.body.x);
    press(BY_HAND_LEFT);
    TEST_ASSERT_TRUE(member.body.left < 0 && member.body.right > 0);
    press(BY_HAND_RIGHT);
    TEST_ASSERT_TRUE(member.body.left > 0 && member.body.right < 0);
    run_for(1);
    TEST_ASSERT_DOUBLE_WITHIN(0, 0, member.body.left);
}

/* A stronger wheel is one that is taken for slower. */
static void test_trims_are_in_force_at_once(void)
{
    run_for(1);
    press('l');
    assert_said("left_gain 0.99500\n");
    press('r');
    press('r');
    assert_said("right_gain 0.9899");
    press(' ');
    TEST_ASSERT_DOUBLE_WITHIN(0.0002, 0.24 / 0.995, member.body.left);
    TEST_ASSERT_DOUBLE_WITHIN(0.0002, 0.24 / 0.99, member.body.right);
    run_for(1);
    TEST_ASSERT_EQUAL(16384, saved(PARAMETER_LEFT_GAIN));
}

static void test_dead_bands(void)
{
    run_for(1);
    press('-');
    assert_said("left_dead_band is -0.005; a number from 0 to 0.3 is allowed");
    press('+');
    press('+');
    assert_said("left_dead_band 0.0100");
    assert_said("right_dead_band 0.0100");
    press('-');
    assert_said("right_dead_band 0.0050");
}

static void test_saves(void)
{
    run_for(1);
    press('r');
    press('s');
    run_for(1);
    assert_said("saved");
    press('q');
    TEST_ASSERT_EQUAL(JOB_DONE, hand.job.state);
    TEST_ASSERT_EQUAL_STRING("left as it is saved", hand.job.words);
    TEST_ASSERT_EQUAL(16302, saved(PARAMETER_RIGHT_GAIN));
}

static void test_says_what_is_not_saved(void)
{
    run_for(1);
    press('r');
    press('q');
    TEST_ASSERT_EQUAL(JOB_DONE, hand.job.state);
    TEST_ASSERT_NOT_NULL(strstr(hand.job.words, "not saved"));
}

static void test_stands_when_the_link_is_lost(void)
{
    run_for(1);
    press(' ');
    member.cut = true;
    run_for(0.3);
    TEST_ASSERT_DOUBLE_WITHIN(0, 0, member.body.left);
    assert_said("the link is cut");
    member.cut = false;
    run_for(0.5);
    TEST_ASSERT_DOUBLE_WITHIN(0, 0, member.body.left);
    TEST_ASSERT_EQUAL(JOB_WORKING, hand.job.state);
}

static void test_an_empty_battery(void)
{
    member.robot->battery = 6000;
    run_for(3);
    TEST_ASSERT_EQUAL(JOB_FAILED, hand.job.state);
    TEST_ASSERT_NOT_NULL(strstr(hand.job.words, "empty battery"));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_says_what_it_finds_and_which_keys_there_are);
    RUN_TEST(test_drives_for_a_second);
    RUN_TEST(test_trims_are_in_force_at_once);
    RUN_TEST(test_dead_bands);
    RUN_TEST(test_saves);
    RUN_TEST(test_says_what_is_not_saved);
    RUN_TEST(test_stands_when_the_link_is_lost);
    RUN_TEST(test_an_empty_battery);
    return UNITY_END();
}
