#include "cameras.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define DEGREE (M_PI / 180)

static struct scenario_robot robots[] = {{.id = 7, .x = 1, .y = 2, .theta = 30 * DEGREE},
                                         {.id = 3, .x = -1, .y = 0.5}};
static struct scenario scenario;
static struct ground *ground;
static struct cameras *cameras;

static void start(bool y_up)
{
    cameras_free(cameras);
    cameras = cameras_new(&scenario, y_up, 1000000);
    TEST_ASSERT_NOT_NULL(cameras);
}

static const struct capture_body *look(size_t i)
{
    cameras_look(cameras, ground, 1, 3500000);
    return &cameras_frame(cameras)->body[i];
}

static void command(const char *line)
{
    char words[256] = "";

    TEST_ASSERT_TRUE_MESSAGE(cameras_command(cameras, line, 2000000, words, sizeof words), words);
}

void setUp(void)
{
    scenario =
        (struct scenario){.robot_count = 2, .robots = robots, .body = BODY_IDEAL, .v_max = 1};
    ground = ground_new(&scenario, 0);
    start(false);
}

void tearDown(void)
{
    ground_free(ground);
    cameras_free(cameras);
    cameras = NULL;
}

static void test_names_and_numbers_are_the_robots(void)
{
    const struct capture_frame *frame = cameras_frame(cameras);

    TEST_ASSERT_EQUAL_UINT(2, frame->count);
    TEST_ASSERT_EQUAL_STRING("Robot7", frame->body[0].name);
    TEST_ASSERT_EQUAL_INT(7, frame->body[0].id);
    TEST_ASSERT_EQUAL_STRING("Robot3", frame->body[1].name);
}

static void test_a_pose_with_z_up(void)
{
    const struct capture_body *body = look(0);

    TEST_ASSERT_TRUE(body->tracked);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1, body->at[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2, body->at[1]);
    TEST_ASSERT_TRUE(body->at[2] > 0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sin(15 * DEGREE), body->turn[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, cos(15 * DEGREE), body->turn[3]);
}

/* A right-handed system: what was y points to -z. */
static void test_a_pose_with_y_up(void)
{
    start(true);
    const struct capture_body *body = look(0);

    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1, body->at[0]);
    TEST_ASSERT_TRUE(body->at[1] > 0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -2, body->at[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0, body->turn[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, sin(15 * DEGREE), body->turn[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0, body->turn[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, cos(15 * DEGREE), body->turn[3]);
}

static void test_frames_are_numbered_and_timed(void)
{
    look(0);
    cameras_look(cameras, ground, 3, 4000000);
    TEST_ASSERT_EQUAL_UINT(4, cameras_frame(cameras)->number);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3, cameras_frame(cameras)->time);
}

static void test_a_small_body_is_seen_with_noise(void)
{
    scenario.body = BODY_SMALL;
    start(false);
    double first = look(0)->at[0], second = look(0)->at[0];

    TEST_ASSERT_TRUE(first != second);
    TEST_ASSERT_DOUBLE_WITHIN(0.0011, 1, first); /* 3.5 times the deviation at the most */
}

static void test_a_lost_body_repeats_its_pose(void)
{
    scenario.body = BODY_SMALL;
    start(false);
    double last = look(0)->at[0];

    command("lose 7");
    TEST_ASSERT_FALSE(look(0)->tracked);
    TEST_ASSERT_TRUE(look(0)->at[0] == last);
    TEST_ASSERT_TRUE(look(1)->tracked);
    command("find 7");
    TEST_ASSERT_TRUE(look(0)->tracked);
    TEST_ASSERT_TRUE(look(0)->at[0] != last);
}

static void test_a_jump_lasts_until_it_is_taken_back(void)
{
    command("jump 3 0.8");
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -0.2, look(1)->at[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1, look(0)->at[0]);
    command(" jump  3 0 ");
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -1, look(1)->at[0]);
}

static void test_freeze_and_thaw(void)
{
    TEST_ASSERT_FALSE(cameras_frozen(cameras));
    command("freeze");
    TEST_ASSERT_TRUE(cameras_frozen(cameras));
    command("thaw");
    TEST_ASSERT_FALSE(cameras_frozen(cameras));
}

static void test_a_restart_begins_again(void)
{
    look(0);
    look(0);
    command("restart");
    look(0);
    TEST_ASSERT_EQUAL_UINT(1, cameras_frame(cameras)->number);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.5, cameras_frame(cameras)->time);
}

static void test_what_is_no_command_is_told(void)
{
    static const char *const lines[] = {
        "",           "lose",    "lose 4",     "lose 7x",  "lose x", "lose 7 1", "jump 7",
        "jump 7 far", "jump 7 ", "jump 7 1 2", "freeze 7", "dance",  "find 7 7", "jump 7 nan"};

    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        char words[256] = "";

        TEST_ASSERT_FALSE_MESSAGE(cameras_command(cameras, lines[i], 0, words, sizeof words),
                                  lines[i]);
        TEST_ASSERT_NOT_NULL(strstr(words, "jump ID METRES"));
    }
    TEST_ASSERT_TRUE(look(0)->tracked);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1, look(0)->at[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_names_and_numbers_are_the_robots);
    RUN_TEST(test_a_pose_with_z_up);
    RUN_TEST(test_a_pose_with_y_up);
    RUN_TEST(test_frames_are_numbered_and_timed);
    RUN_TEST(test_a_small_body_is_seen_with_noise);
    RUN_TEST(test_a_lost_body_repeats_its_pose);
    RUN_TEST(test_a_jump_lasts_until_it_is_taken_back);
    RUN_TEST(test_freeze_and_thaw);
    RUN_TEST(test_a_restart_begins_again);
    RUN_TEST(test_what_is_no_command_is_told);
    return UNITY_END();
}
