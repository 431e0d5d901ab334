/* `muster calibrate' in real time: robots of two makes whose wheels are known to the arena alone.
 */
#include "body.h"
#include "hand.h"
#include "limits.h"
#include "parameter_file.h"
#include "stage.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unity.h>

#define ARENA(place)                                                                               \
    "schema: 1\n"                                                                                  \
    "name: calibrate\n"                                                                            \
    "duration: 1\n"                                                                                \
    "body: small\n"                                                                                \
    "robots:\n"                                                                                    \
    "  - {id: 1, pose: [0, 0, 0.3], candidate: true}\n"                                            \
    "  - {id: 2, pose: [" place ", -1]}\n"                                                         \
    "trajectory: {start: [0, 0, 0], v: 0.3, omega: 0}\n"                                           \
    "formations:\n"                                                                                \
    "  pair: {L: [0, 0.5], psi: [0, pi/2]}\n"                                                      \
    "formation: pair\n"

static const char far_apart[] = ARENA("1.5, 0.2");
static const char side_by_side[] = ARENA("0, 0.4");

static struct hand hand;
static char mocap_port[64];
static const unsigned two[] = {1, 2, 0};

void setUp(void)
{
    hand_open(&hand);
}

void tearDown(void)
{
    hand_close(&hand);
}

#define RUN(...) hand_run(&hand, (const char *const[]){__VA_ARGS__, NULL})
#define CALIBRATE "calibrate", site, "--set", mocap_port, "--set", "mocap.unicast=true"

static void has_said(const char *words)
{
    TEST_ASSERT_TRUE_MESSAGE(hand_said(&hand, words), words);
}

static const char *open_arena(const char *scenario)
{
    char arena[64];

    hand_add_arena(&hand, scenario);
    snprintf(arena, sizeof arena, "127.0.0.1:%u", hand.robots_port);
    snprintf(mocap_port, sizeof mocap_port, "mocap.port=%u", hand.natnet_port);
    hand_add(&hand, (const char *const[]){"--robots", "native", "--id", "1..2", "--link",
                                          "tcp:127.0.0.1:0", "--arena", arena, "--quiet", NULL});
    return hand_site(&hand, two);
}

/* A machine that holds robots or this command up spoils a measurement, and is told so. */
static void expect_done(int status)
{
    if (status != 0 && (hand_said(&hand, "took nothing for") || hand_said(&hand, "has lost its"))) {
        TEST_IGNORE_MESSAGE("this machine was too busy");
    }
    TEST_ASSERT_EQUAL_INT(0, status);
}

static void near(const struct parameter_entry *entry, uint8_t index, double within, double is)
{
    TEST_ASSERT_DOUBLE_WITHIN(within, is, parameter_of(index, entry->parameters.value[index]));
}

static void compare(const char *path)
{
    char error[512];
    struct scenario *scenario = scenario_parse("arena", far_apart, strlen(far_apart), NULL, 0,
                                               VERTICES_MAX, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(scenario, error);
    struct parameter_file *file = parameter_file_read(path, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(file, error);
    TEST_ASSERT_EQUAL(2, file->count);
    for (size_t i = 0; i < 2; i++) {
        const struct parameter_entry *entry = &file->robots[i];
        struct body_kind is = body_kind_of(scenario, (uint16_t)(i + 1));

        near(entry, PARAMETER_LEFT_GAIN, 0.005, is.left.gain);
        near(entry, PARAMETER_RIGHT_GAIN, 0.005, is.right.gain);
        near(entry, PARAMETER_LEFT_DEAD_BAND, 0.003, is.left.dead_band / PWM_STEPS);
        near(entry, PARAMETER_RIGHT_DEAD_BAND, 0.003, is.right.dead_band / PWM_STEPS);
        near(entry, PARAMETER_TRACK, 0.001, is.track);
        near(entry, PARAMETER_MOTOR_LAG, 0.01, is.lag);
    }
    parameter_file_free(file);
    scenario_free(scenario);
}

static void test_two_robots_at_the_same_time(void)
{
    const char *site = open_arena(far_apart);
    char path[128];

    snprintf(path, sizeof path, "%s/calibrated.yaml", hand.directory);
    expect_done(RUN(CALIBRATE, "--together", "--out", path));
    has_said("robot 1: before 0.1");
    has_said("robot    left   right");
    compare(path);
    /* What the file says is what the robots have, saved. */
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "set", site, "--from", path));
    has_said("robot 1: left_gain is ");
    TEST_ASSERT_FALSE(hand_said(&hand, "->"));
    TEST_ASSERT_FALSE(hand_said(&hand, "Not saved"));
}

static void test_an_interrupt_ends_it(void)
{
    const char *site = open_arena(far_apart);

    hand_start(&hand, (const char *const[]){CALIBRATE, NULL});
    hand_waits(&hand, "first frame");
    process_signal(&hand.command, SIGINT);
    TEST_ASSERT_EQUAL_INT(1, hand_end(&hand));
    has_said("muster calibrate: interrupted\n");
}

static void test_there_is_no_room(void)
{
    const char *site = open_arena(side_by_side);

    TEST_ASSERT_EQUAL_INT(1, RUN(CALIBRATE));
    has_said("robot 2 stands 0.40 m from it, and it needs 0.6 m to drive");
    has_said("robot 1 stands 0.40 m from it");
}

static void test_motion_capture_is_not_there(void)
{
    const char *site = open_arena(far_apart);

    TEST_ASSERT_EQUAL_INT(1, RUN(CALIBRATE, "--set", "robots.0.body=Wagon", "--robots", "1"));
    has_said("motion capture does not see its body");
}

static void press(const char *keys, const char *words)
{
    hand.command.heard = hand.command.length;
    process_tell(&hand.command, keys);
    hand_waits(&hand, words);
}

static void test_by_hand(void)
{
    const char *site = open_arena(far_apart);

    TEST_ASSERT_EQUAL_INT(2, RUN("calibrate", site, "--by-hand"));
    has_said("one robot at a time");
    hand_start(&hand, (const char *const[]){"calibrate", site, "--by-hand", "--robots", "2", NULL});
    hand_waits(&hand, "right_dead_band 0.00000\n");
    press("l", "left_gain 0.99500");
    press("r", "right_gain 0.99500");
    press("+", "right_dead_band 0.00501\n");
    press("-", "right_dead_band 0.00000\n");
    press("-", "left_dead_band");
    press(" ", "forward");
    press("s", "saved\n");
    process_tell(&hand.command, "q");
    TEST_ASSERT_EQUAL_INT(0, hand_end(&hand));
    TEST_ASSERT_EQUAL_INT(0, RUN("param", "get", site, "--robots", "2", "left_gain", "unsaved"));
    has_said("0.99500");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_two_robots_at_the_same_time);
    RUN_TEST(test_an_interrupt_ends_it);
    RUN_TEST(test_there_is_no_room);
    RUN_TEST(test_motion_capture_is_not_there);
    RUN_TEST(test_by_hand);
    return stage_verdict();
}
