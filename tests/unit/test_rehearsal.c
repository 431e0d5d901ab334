#include "rehearsal.h"

#include "message.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define ROBOTS 2
#define PERIOD_US 20000

/* A job that writes down what happens to it. */
struct witness {
    struct job job;
    char calls[64]; /* a letter each: Linked, lost (-), received (r), seen (p), but not send */
    size_t heard, asked, asked_without_room;
    size_t more; /* bytes still to send */
    struct job_pose pose;
    int64_t last_us;
};

static struct witness witness[ROBOTS];
static struct rehearsal_member member[ROBOTS];
static struct link_timing timing;
static int64_t now_us;

static struct witness *witness_of(struct job *job)
{
    return (struct witness *)job;
}

static void note(struct job *job, char letter)
{
    char *calls = witness_of(job)->calls;
    size_t length = strlen(calls);

    if (length + 1 < sizeof witness->calls)
        calls[length] = letter;
}

static void linked(struct job *job, int64_t at_us)
{
    note(job, 'L');
    witness_of(job)->last_us = at_us;
}

static void lost(struct job *job, const char *words, int64_t at_us)
{
    TEST_ASSERT_NOT_EQUAL(0, strlen(words));
    note(job, '-');
    witness_of(job)->last_us = at_us;
}

static void received(struct job *job, const uint8_t *bytes, size_t count, int64_t at_us)
{
    TEST_ASSERT_NOT_NULL(bytes);
    note(job, 'r');
    witness_of(job)->heard += count;
    witness_of(job)->last_us = at_us;
}

static void seen(struct job *job, const struct job_pose *pose)
{
    note(job, 'p');
    witness_of(job)->pose = *pose;
}

static size_t send(struct job *job, int64_t at_us, uint8_t *bytes, size_t room)
{
    struct witness *w = witness_of(job);
    size_t count = w->more < room ? w->more : room;

    w->asked++;
    w->asked_without_room += room == 0;
    w->last_us = at_us;
    memset(bytes, 0, count);
    w->more -= count;
    return count;
}

static const struct job_kind blind = {linked, lost, received, NULL, send};
static const struct job_kind seeing = {linked, lost, received, seen, send};

void setUp(void)
{
    timing = link_timing_of(NATIVE_BAUD);
    now_us = 1000000;
    for (size_t i = 0; i < ROBOTS; i++) {
        witness[i] = (struct witness){.job.kind = &blind};
        member[i] = (struct rehearsal_member){.robot = robot_native_new((uint16_t)(i + 1)),
                                              .job = &witness[i].job};
        TEST_ASSERT_TRUE(member[i].robot->kind->power_on(member[i].robot));
    }
}

void tearDown(void)
{
    for (size_t i = 0; i < ROBOTS; i++)
        member[i].robot->kind->destroy(member[i].robot);
}

static void run(int ticks)
{
    for (int i = 0; i < ticks; i++)
        TEST_ASSERT_TRUE(rehearsal_tick(member, ROBOTS, &timing, &now_us, NULL));
}

static void test_a_period_has_20_ms(void)
{
    run(3);
    TEST_ASSERT_EQUAL_INT64(1000000 + 3 * PERIOD_US, now_us);
}

/* A native robot says its status at once, and then every 500 ms. */
static void test_links_are_up_and_carry_what_the_robot_says(void)
{
    run(1);
    TEST_ASSERT_EQUAL_STRING("Lr", witness[0].calls);
    TEST_ASSERT_EQUAL(FRAME_BYTES(STATUS_BYTES), witness[0].heard);
    TEST_ASSERT_EQUAL_INT64(now_us, witness[0].last_us);
    run(50);
    TEST_ASSERT_EQUAL_STRING("Lrrr", witness[0].calls);
    TEST_ASSERT_EQUAL_STRING("Lrrr", witness[1].calls);
}

static void test_what_is_sent_goes_at_the_link_s_rate(void)
{
    witness[0].more = 3u * timing.slots;
    run(1);
    TEST_ASSERT_EQUAL(2u * timing.slots, member[0].waiting);
    run(2);
    TEST_ASSERT_EQUAL(0, member[0].waiting);
    TEST_ASSERT_EQUAL(0, witness[0].more);
}

static void test_no_more_is_asked_for_than_there_is_room_for(void)
{
    witness[0].more = 100000;
    run(1);
    TEST_ASSERT_TRUE(witness[0].asked_without_room > 0);
    TEST_ASSERT_EQUAL(100000 - sizeof member->bytes - timing.slots, witness[0].more);
    TEST_ASSERT_EQUAL(sizeof member->bytes, member[0].waiting);
}

/* A mission is acknowledged at once. */
static void test_a_robot_hears_what_is_sent(void)
{
    struct message message = {
        .type = MESSAGE_MISSION,
        .mission = {.mission = 9, .v_max = 1, .omega_max = 1, .track = 1, .wheel_max = 1}};
    uint8_t payload[FRAME_PAYLOAD_MAX];

    run(3);
    size_t before = witness[0].heard;
    member[0].waiting = frame_encode(member[0].bytes, payload, message_write(payload, &message));
    run(1);
    TEST_ASSERT_TRUE(witness[0].heard > before);
}

static void test_a_cut_link_carries_nothing_and_comes_back(void)
{
    run(1);
    witness[0].more = 4u * timing.slots;
    run(1);
    member[0].cut = true;
    run(1);
    TEST_ASSERT_EQUAL(0, member[0].waiting);
    run(59);
    TEST_ASSERT_EQUAL_STRING("Lr-", witness[0].calls);
    TEST_ASSERT_TRUE(witness[0].asked_without_room >= 60);
    member[0].cut = false;
    run(1);
    TEST_ASSERT_EQUAL_STRING_LEN("Lr-L", witness[0].calls, 4);
}

static void test_without_power_there_is_no_link(void)
{
    member[0].off = true;
    run(30);
    TEST_ASSERT_EQUAL_STRING("", witness[0].calls);
    TEST_ASSERT_EQUAL_STRING("Lrr", witness[1].calls);
}

static void test_who_wants_poses_sees_one_a_period(void)
{
    witness[0].job.kind = &seeing;
    member[0].body = (struct body){.x = 1, .y = 2, .theta = 3};
    run(1);
    TEST_ASSERT_EQUAL_STRING("Lrp", witness[0].calls);
    TEST_ASSERT_EQUAL_DOUBLE(1, witness[0].pose.x);
    TEST_ASSERT_EQUAL_DOUBLE(2, witness[0].pose.y);
    TEST_ASSERT_EQUAL_DOUBLE(3, witness[0].pose.theta);
    TEST_ASSERT_EQUAL_INT64(now_us, witness[0].pose.at_us);
}

/* Its set-points change ACTUATION_MS after the control tick. */
static void test_a_body_moves_as_its_wheels_turn(void)
{
    member[0].kind = (struct body_kind){
        .track = 0.1,
        .wheel_max = 1,
        .left.gain = 1,
        .right.gain = 1,
    };
    member[0].left = member[0].right = 16383;
    run(1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, link_actuation_s(&timing), member[0].body.x);
    run(1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, link_actuation_s(&timing), member[0].body.x);
}

/* Of a body that coasts at 0.5 m/s. */
static void test_motion_capture_has_its_own_rate_and_noise(void)
{
    const struct mocap exact = {.rate = 120};
    const struct mocap noisy = {.rate = 120, .place_noise = 0.001, .seed = 5};

    witness[0].job.kind = &seeing;
    member[0].kind = (struct body_kind){.track = 0.1, .wheel_max = 1, .lag = 1e6};
    member[0].body.left = member[0].body.right = 0.5;
    member[0].mocap = &exact;
    run(1);
    double age = (double)(now_us - witness[0].pose.at_us) / 1e6;
    TEST_ASSERT_TRUE(age > 0 && age < 1.0 / 120);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, member[0].body.x - 0.5 * age, witness[0].pose.x);

    member[0].mocap = &noisy;
    run(1);
    age = (double)(now_us - witness[0].pose.at_us) / 1e6;
    double off = fabs(witness[0].pose.x - member[0].body.x + 0.5 * age);
    TEST_ASSERT_TRUE(off > 1e-5 && off < 0.004);
}

/* What a robot says at once is heard two ticks later. */
static void test_a_radio_is_late(void)
{
    const struct radio radio = {.least = 2};

    member[0].radio[RADIO_DOWN] = radio_pipe_new(&radio, 1, RADIO_DOWN, timing.slots);
    member[0].radio[RADIO_UP] = radio_pipe_new(&radio, 1, RADIO_UP, ROBOT_TX_MAX);
    run(2);
    TEST_ASSERT_EQUAL_STRING("L", witness[0].calls);
    TEST_ASSERT_EQUAL_STRING("Lr", witness[1].calls);
    run(1);
    TEST_ASSERT_EQUAL_STRING("Lr", witness[0].calls);

    /* What is under way when the link is cut never comes. */
    run(23);
    TEST_ASSERT_EQUAL_STRING("Lrr", witness[1].calls);
    member[0].cut = true;
    run(1);
    member[0].cut = false;
    run(5);
    TEST_ASSERT_EQUAL_STRING("Lr-L", witness[0].calls);
    radio_pipe_free(member[0].radio[RADIO_DOWN]);
    radio_pipe_free(member[0].radio[RADIO_UP]);
}

static void test_a_job_that_has_ended_is_left_alone(void)
{
    run(1);
    job_done(&witness[0].job, "%d of %d", 3, 3);
    size_t asked = witness[0].asked;
    run(60);
    TEST_ASSERT_EQUAL_STRING("Lr", witness[0].calls);
    TEST_ASSERT_EQUAL(asked, witness[0].asked);
    TEST_ASSERT_EQUAL_STRING("3 of 3", witness[0].job.words);
    TEST_ASSERT_EQUAL_DOUBLE(1, witness[0].job.progress);
}

static void test_it_runs_until_all_have_ended(void)
{
    TEST_ASSERT_FALSE(rehearsal_run(member, ROBOTS, &timing, &now_us, 100000));
    TEST_ASSERT_EQUAL_INT64(1100000, now_us);
    job_done(&witness[0].job, "done");
    TEST_ASSERT_FALSE(rehearsal_run(member, ROBOTS, &timing, &now_us, 100000));
    job_failed(&witness[1].job, "no");
    TEST_ASSERT_TRUE(rehearsal_run(member, ROBOTS, &timing, &now_us, 100000));
    TEST_ASSERT_EQUAL_INT64(1200000, now_us);
    TEST_ASSERT_EQUAL(JOB_FAILED, witness[1].job.state);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_period_has_20_ms);
    RUN_TEST(test_links_are_up_and_carry_what_the_robot_says);
    RUN_TEST(test_what_is_sent_goes_at_the_link_s_rate);
    RUN_TEST(test_no_more_is_asked_for_than_there_is_room_for);
    RUN_TEST(test_a_robot_hears_what_is_sent);
    RUN_TEST(test_a_cut_link_carries_nothing_and_comes_back);
    RUN_TEST(test_without_power_there_is_no_link);
    RUN_TEST(test_who_wants_poses_sees_one_a_period);
    RUN_TEST(test_a_body_moves_as_its_wheels_turn);
    RUN_TEST(test_motion_capture_has_its_own_rate_and_noise);
    RUN_TEST(test_a_radio_is_late);
    RUN_TEST(test_a_job_that_has_ended_is_left_alone);
    RUN_TEST(test_it_runs_until_all_have_ended);
    return UNITY_END();
}
