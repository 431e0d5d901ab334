#include "talk.h"

#include <string.h>
#include <unity.h>

#define TICK_US 20000
#define ROBOT 3

/* A job that talks, and a robot that is nothing but its end of the wire. */
static struct job job;
static struct talk talk;
static int64_t now_us;

/* What the robot has heard, with the newest question. */
static struct frame_decoder ears;
static unsigned asks, keepalives;
static struct message_ask ask;

void setUp(void)
{
    job = (struct job){.robot = ROBOT};
    now_us = 1000000;
    asks = keepalives = 0;
    frame_decoder_init(&ears);
    talk_begin(&talk);
    talk_linked(&talk, now_us);
}

void tearDown(void)
{
}

static void hear(void)
{
    struct message message;

    TEST_ASSERT_TRUE(message_read(&message, ears.payload, ears.length));
    if (message.type == MESSAGE_ASK) {
        ask = message.ask;
        asks++;
    } else {
        TEST_ASSERT_EQUAL_UINT8(MESSAGE_KEEPALIVE, message.type);
        TEST_ASSERT_LESS_THAN_INT32(0, message.keepalive.time);
        keepalives++;
    }
}

/* One tick passes. */
static void tick_with(size_t room)
{
    uint8_t bytes[256];
    size_t count = talk_send(&talk, now_us, bytes, room);
    const uint8_t *next = bytes;

    TEST_ASSERT_TRUE(count <= room);
    while (next != bytes + count)
        if (frame_scan(&ears, &next, bytes + count) == FRAME_READY)
            hear();
    now_us += TICK_US;
}

static void ticks(unsigned count)
{
    while (count-- > 0)
        tick_with(256);
}

static void say(const struct message *message)
{
    uint8_t bytes[FRAME_BYTES_MAX];

    talk_received(&talk, bytes, talk_put(message, bytes, 0, sizeof bytes), now_us);
}

static void answer_as(uint16_t id, uint8_t tag, uint8_t index, uint8_t result)
{
    const struct message message = {
        .type = MESSAGE_ANSWER,
        .answer = {.id = id, .tag = tag, .result = result, .index = index, .value = 42},
    };

    say(&message);
}

static void answer(uint8_t result)
{
    answer_as(ROBOT, ask.tag, ask.index, result);
}

static void say_status(uint16_t id)
{
    const struct message message = {.type = MESSAGE_STATUS, .status = {.id = id, .battery = 7000}};

    say(&message);
}

/* The robot is met, and asked for something. */
static void begin_asking(enum parameter_action action, uint8_t index, uint32_t value)
{
    ticks(1);
    answer(PARAMETER_DONE);
    talk_ask(&talk, action, index, value);
    asks = 0;
}

static void test_the_first_question_is_who_is_there(void)
{
    ticks(1);
    TEST_ASSERT_EQUAL_UINT(1, asks);
    TEST_ASSERT_EQUAL_UINT8(PARAMETER_GET, ask.action);
    TEST_ASSERT_EQUAL_UINT8(PARAMETER_ID, ask.index);
    TEST_ASSERT_FALSE(talk.met);
    answer(PARAMETER_DONE);
    TEST_ASSERT_TRUE(talk.met);
    TEST_ASSERT_EQUAL_UINT16(ROBOT, talk.id);
    TEST_ASSERT_EQUAL_INT(TALK_ANSWERED, talk.state);
    TEST_ASSERT_EQUAL_UINT32(42, talk.answer.value);
    TEST_ASSERT_TRUE(talk_judge(&talk, &job));
}

static void test_a_robot_is_told_ten_times_a_second_that_nothing_has_begun(void)
{
    ticks(50);
    TEST_ASSERT_EQUAL_UINT(10, keepalives);
}

static void test_nothing_is_said_while_the_link_is_down(void)
{
    talk_lost(&talk);
    ticks(50);
    TEST_ASSERT_EQUAL_UINT(0, asks + keepalives);
    talk_linked(&talk, now_us);
    ticks(1);
    TEST_ASSERT_EQUAL_UINT(1, asks);
    TEST_ASSERT_EQUAL_UINT(1, keepalives);
}

static void test_a_question_that_finds_no_room_is_asked_later(void)
{
    tick_with(4);
    TEST_ASSERT_EQUAL_UINT(0, asks);
    ticks(1);
    TEST_ASSERT_EQUAL_UINT(1, asks);
    TEST_ASSERT_EQUAL_UINT32(0, talk.lost);
}

static void test_a_question_is_asked_again_by_the_same_tag(void)
{
    begin_asking(PARAMETER_SET, PARAMETER_TRACK, 320);
    ticks(1);
    uint8_t tag = ask.tag;
    TEST_ASSERT_EQUAL_UINT8(PARAMETER_SET, ask.action);
    TEST_ASSERT_EQUAL_UINT8(PARAMETER_TRACK, ask.index);
    TEST_ASSERT_EQUAL_UINT32(320, ask.value);
    ticks(39);
    TEST_ASSERT_EQUAL_UINT(4, asks);
    TEST_ASSERT_EQUAL_UINT8(tag, ask.tag);
    TEST_ASSERT_EQUAL_UINT32(3, talk.lost);
    answer(PARAMETER_DONE);
    TEST_ASSERT_EQUAL_INT(TALK_ANSWERED, talk.state);
    TEST_ASSERT_EQUAL_INT64(0, talk.round_trip_us);
}

static void test_an_answer_at_once_gives_the_round_trip(void)
{
    begin_asking(PARAMETER_GET, PARAMETER_TRACK, 0);
    ticks(3);
    answer(PARAMETER_DONE);
    TEST_ASSERT_EQUAL_INT64(3 * TICK_US, talk.round_trip_us);
}

static void test_an_answer_that_comes_twice_is_none_to_the_next_question(void)
{
    begin_asking(PARAMETER_SET, PARAMETER_TRACK, 1);
    ticks(1);
    uint8_t tag = ask.tag;
    answer(PARAMETER_DONE);
    talk_ask(&talk, PARAMETER_SET, PARAMETER_TRACK, 2);
    answer_as(ROBOT, tag, PARAMETER_TRACK, PARAMETER_DONE);
    ticks(1);
    answer_as(ROBOT, tag, PARAMETER_TRACK, PARAMETER_DONE);
    TEST_ASSERT_EQUAL_INT(TALK_ASKING, talk.state);
}

static void test_an_answer_to_somebody_elses_question_by_the_same_tag_is_none(void)
{
    ticks(1);
    uint8_t tag = ask.tag;
    answer_as(ROBOT, tag, PARAMETER_TRACK, PARAMETER_DONE);
    TEST_ASSERT_EQUAL_INT(TALK_ASKING, talk.state);
    ticks(15);
    TEST_ASSERT_NOT_EQUAL(tag, ask.tag);
    answer(PARAMETER_DONE);
    TEST_ASSERT_EQUAL_INT(TALK_ANSWERED, talk.state);
}

static void test_a_robot_that_has_no_time_is_asked_again_for_a_while(void)
{
    begin_asking(PARAMETER_SET, PARAMETER_ID, 4);
    ticks(1);
    for (unsigned i = 0; i < 9; i++) {
        answer(PARAMETER_BUSY);
        TEST_ASSERT_EQUAL_INT(TALK_ASKING, talk.state);
        ticks(13);
        TEST_ASSERT_EQUAL_UINT(i + 2, asks);
    }
    ticks(20);
    TEST_ASSERT_EQUAL_INT(TALK_ANSWERED, talk.state);
    TEST_ASSERT_EQUAL_UINT8(PARAMETER_BUSY, talk.answer.result);
}

static void judged(const char *words)
{
    TEST_ASSERT_FALSE(talk_judge(&talk, &job));
    TEST_ASSERT_EQUAL_INT(JOB_FAILED, job.state);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(job.words, words), job.words);
}

static void test_a_silent_robot_is_given_up_after_its_time_with_the_link(void)
{
    ticks(62);
    talk_lost(&talk);
    ticks(500);
    talk_linked(&talk, now_us);
    ticks(60);
    TEST_ASSERT_TRUE(talk_judge(&talk, &job));
    ticks(10);
    judged("does not answer: is it on");
}

static void test_a_save_may_take_longer(void)
{
    begin_asking(PARAMETER_SAVE, 0, 0);
    ticks(200);
    TEST_ASSERT_EQUAL_INT(TALK_ASKING, talk.state);
    ticks(60);
    judged("does not answer any more");
}

static void test_a_robot_that_only_tells_its_status_is_an_older_one(void)
{
    ticks(100);
    say_status(ROBOT);
    ticks(40);
    judged("its firmware is older");
}

static void test_one_that_tells_much_and_answers_nothing_is_given_up_as_soon(void)
{
    for (unsigned i = 0; i < 130; i++) {
        ticks(1);
        say_status(ROBOT);
    }
    judged("its firmware is older");
}

static void test_a_robot_without_an_id_is_told_of(void)
{
    say_status(0);
    judged("has no id");
}

static void test_another_robot_is_told_of(void)
{
    say_status(7);
    judged("robot 7 answers there");
}

static void test_whoever_answers_may_do(void)
{
    talk.any = true;
    say_status(7);
    TEST_ASSERT_TRUE(talk_judge(&talk, &job));
    TEST_ASSERT_EQUAL_UINT16(7, talk.id);
}

static void test_statuses_are_kept(void)
{
    say_status(ROBOT);
    say_status(ROBOT);
    TEST_ASSERT_EQUAL_UINT32(2, talk.statuses);
    TEST_ASSERT_EQUAL_UINT16(7000, talk.status.battery);
}

static void test_broken_frames_are_counted_but_one_that_began_before_the_link(void)
{
    static const uint8_t noise[] = {5, 1, 2, 3, 4, 0};

    talk_received(&talk, noise, sizeof noise, now_us);
    TEST_ASSERT_EQUAL_UINT32(0, talk.bad_frames);
    talk_received(&talk, noise, sizeof noise, now_us);
    TEST_ASSERT_EQUAL_UINT32(1, talk.bad_frames);
    say_status(ROBOT);
    TEST_ASSERT_EQUAL_UINT32(1, talk.frames);
}

static void test_time_in_which_nobody_listened_is_no_silence(void)
{
    ticks(10);
    now_us += 60000000;
    ticks(10);
    TEST_ASSERT_EQUAL_INT(TALK_ASKING, talk.state);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_first_question_is_who_is_there);
    RUN_TEST(test_a_robot_is_told_ten_times_a_second_that_nothing_has_begun);
    RUN_TEST(test_nothing_is_said_while_the_link_is_down);
    RUN_TEST(test_a_question_that_finds_no_room_is_asked_later);
    RUN_TEST(test_a_question_is_asked_again_by_the_same_tag);
    RUN_TEST(test_an_answer_at_once_gives_the_round_trip);
    RUN_TEST(test_an_answer_that_comes_twice_is_none_to_the_next_question);
    RUN_TEST(test_an_answer_to_somebody_elses_question_by_the_same_tag_is_none);
    RUN_TEST(test_a_robot_that_has_no_time_is_asked_again_for_a_while);
    RUN_TEST(test_a_silent_robot_is_given_up_after_its_time_with_the_link);
    RUN_TEST(test_a_save_may_take_longer);
    RUN_TEST(test_a_robot_that_only_tells_its_status_is_an_older_one);
    RUN_TEST(test_one_that_tells_much_and_answers_nothing_is_given_up_as_soon);
    RUN_TEST(test_a_robot_without_an_id_is_told_of);
    RUN_TEST(test_another_robot_is_told_of);
    RUN_TEST(test_whoever_answers_may_do);
    RUN_TEST(test_statuses_are_kept);
    RUN_TEST(test_broken_frames_are_counted_but_one_that_began_before_the_link);
    RUN_TEST(test_time_in_which_nobody_listened_is_no_silence);
    return UNITY_END();
}
