#include "calibration.h"

#include "limits.h"
#include "param.h"
#include "rehearsal.h"

#include <math.h>
#include <string.h>
#include <unity.h>

#define ROBOTS 2

static const struct body_kind crooked = {
    .track = 0.0892,
    .wheel_max = 0.6,
    .lag = 0.055,
    .left = {1.07, 0.02 * PWM_STEPS},
    .right = {0.93, 0.045 * PWM_STEPS},
};

static struct calibration_settings settings;
static struct turns turns;
static struct turns_place place[ROBOTS];
static struct calibration calibration[ROBOTS];
static struct rehearsal_member member[ROBOTS];
static struct link_timing timing;
static int64_t now_us;
static size_t count;
static bool blind; /* robot 1 is not seen */

static const struct job_kind *own_kind;
static struct job_kind blindable;

static void seen_or_not(struct job *job, const struct job_pose *pose)
{
    if (!blind)
        own_kind->seen(job, pose);
}

void setUp(void)
{
    settings = (struct calibration_settings){.wheels = {0.08, 0.6}, .save = true};
    turns = (struct turns){.count = ROBOTS, .place = place};
    timing = link_timing_of(NATIVE_BAUD);
    now_us = 1000000;
    count = 1;
    blind = false;
    for (size_t i = 0; i < ROBOTS; i++) {
        uint16_t id = (uint16_t)(i + 1);

        place[i] = (struct turns_place){.id = id};
        calibration_begin(&calibration[i], id, &settings, &turns, i);
        member[i] = (struct rehearsal_member){
            .robot = robot_native_new(id),
            .job = &calibration[i].job,
            .kind = crooked,
            .body = {.x = 2.0 * (double)i, .theta = 3},
        };
        TEST_ASSERT_TRUE(member[i].robot->kind->power_on(member[i].robot));
    }
    own_kind = calibration[0].job.kind;
    blindable = *own_kind;
    blindable.seen = seen_or_not;
    calibration[0].job.kind = &blindable;
}

void tearDown(void)
{
    for (size_t i = 0; i < ROBOTS; i++)
        member[i].robot->kind->destroy(member[i].robot);
}

static void tick(void)
{
    TEST_ASSERT_TRUE(rehearsal_tick(member, count, &timing, &now_us, NULL));
}

static void run_until(enum calibration_phase phase)
{
    for (int i = 0; i < 3000 && calibration[0].phase != phase; i++)
        tick();
    TEST_ASSERT_EQUAL(phase, calibration[0].phase);
}

static void run_for(double seconds)
{
    for (int i = 0; i < seconds * TICKS_PER_S; i++)
        tick();
}

static void run(void)
{
    rehearsal_run(member, count, &timing, &now_us, 120000000);
}

static void assert_done(size_t i)
{
    TEST_ASSERT_EQUAL_MESSAGE(JOB_DONE, calibration[i].job.state, calibration[i].job.words);
}

static void assert_failed(const char *words)
{
    TEST_ASSERT_EQUAL_MESSAGE(JOB_FAILED, calibration[0].job.state, calibration[0].job.words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(calibration[0].job.words, words), calibration[0].job.words);
}

/* What motors were told outlives nothing by more than 200 ms; then wheels run out. */
static void assert_stands(void)
{
    run_for(0.6);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0, member[0].body.left);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0, member[0].body.right);
}

/* What robot 1 has in force. */
static uint16_t in_force(uint8_t index)
{
    const struct param_plan plan = {.read = param_bit(index)};
    struct param_job param;

    param_begin(&param, 1, &plan);
    member[0].job = &param.job;
    member[0].up = false;
    run();
    TEST_ASSERT_EQUAL_MESSAGE(JOB_DONE, param.job.state, param.job.words);
    return (uint16_t)param.before[param_row(index)].value;
}

static uint16_t saved(uint8_t index)
{
    struct parameters parameters;

    member[0].robot->kind->power_off(member[0].robot);
    parameters_read(&parameters, member[0].robot->eeprom);
    return parameters.value[index];
}

static void test_measures_sets_and_saves(void)
{
    const uint16_t *value = calibration[0].result.value;

    run();
    assert_done(0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1.07, value[0] / 16384.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.93, value[1] / 16384.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.02, value[2] / 16383.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.045, value[3] / 16383.0);
    TEST_ASSERT_DOUBLE_WITHIN(3e-4, 0.0892, value[4] / 4000.0);
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 0.055, value[5] / 1000.0);
    TEST_ASSERT_TRUE(calibration[0].result.before > 0.04);
    TEST_ASSERT_TRUE(calibration[0].result.after < 0.002);
    TEST_ASSERT_EQUAL_STRING("before", strtok(calibration[0].job.words, " "));
    for (uint8_t i = CALIBRATION_FIRST; i <= CALIBRATION_LAST; i++)
        TEST_ASSERT_EQUAL(value[i - CALIBRATION_FIRST], in_force(i));
    for (uint8_t i = CALIBRATION_FIRST; i <= CALIBRATION_LAST; i++)
        TEST_ASSERT_EQUAL(value[i - CALIBRATION_FIRST], saved(i));
}

/* And ends near where it began. */
static void test_stays_in_its_room(void)
{
    double most = 0;

    while (calibration[0].job.state == JOB_WORKING) {
        tick();
        most = fmax(most, hypot(member[0].body.x, member[0].body.y));
    }
    assert_done(0);
    TEST_ASSERT_TRUE(most > 0.2 && most < DRIVE_ROOM);
    TEST_ASSERT_TRUE(hypot(member[0].body.x, member[0].body.y) < 0.1);
    assert_stands();
}

/* Who has been calibrated before is measured as it is, and its trial before is good already. */
static void test_again(void)
{
    uint16_t value[CALIBRATION_PARAMETERS];

    run();
    assert_done(0);
    memcpy(value, calibration[0].result.value, sizeof value);
    calibration_begin(&calibration[0], 1, &settings, &turns, 0);
    member[0].up = false;
    run();
    assert_done(0);
    for (size_t i = 0; i < CALIBRATION_PARAMETERS; i++)
        TEST_ASSERT_INT_WITHIN(16, value[i], calibration[0].result.value[i]);
    TEST_ASSERT_TRUE(calibration[0].result.before < 0.002);
}

static void test_a_dry_run_leaves_all_as_it_was(void)
{
    settings.save = false;
    run();
    assert_done(0);
    TEST_ASSERT_NOT_NULL(strstr(calibration[0].job.words, "not saved"));
    TEST_ASSERT_EQUAL(16384, in_force(PARAMETER_LEFT_GAIN));
    TEST_ASSERT_EQUAL(0, in_force(PARAMETER_TRACK));
    TEST_ASSERT_EQUAL(16384, saved(PARAMETER_LEFT_GAIN));
}

static void test_poses_are_lost_while_it_drives(void)
{
    run_until(CALIBRATION_MEASURE);
    run_for(2);
    blind = true;
    run_for(0.32);
    assert_failed("motion capture has lost its body");
    TEST_ASSERT_EQUAL(CALIBRATION_MEASURE, calibration[0].phase);
    assert_stands();
    TEST_ASSERT_FALSE(place[0].drives);
    TEST_ASSERT_EQUAL(16384, in_force(PARAMETER_LEFT_GAIN));
}

/* Between two drives that only holds it up. */
static void test_poses_are_lost_before_it_drives(void)
{
    run_until(CALIBRATION_SET);
    blind = true;
    member[0].cut = true;
    run_for(0.5);
    member[0].cut = false;
    run_for(2);
    TEST_ASSERT_EQUAL(CALIBRATION_AFTER, calibration[0].phase);
    blind = false;
    run();
    assert_done(0);
    TEST_ASSERT_TRUE(calibration[0].result.after < 0.002);
}

/* This process, while the robot stands: what was seen meanwhile has still to come. */
static void test_being_held_up_is_not_being_blind(void)
{
    run_until(CALIBRATION_MEASURE);
    run_for(0.1);
    now_us += 360000;
    run();
    assert_done(0);
}

/* Frames that reach robot 1 in a period of its own. */
static void tell_before(const struct message *messages, size_t message_count)
{
    uint8_t bytes[256], payload[FRAME_PAYLOAD_MAX];
    size_t used = 0;
    struct robot_period period;

    for (size_t i = 0; i < message_count; i++)
        used += frame_encode(bytes + used, payload, message_write(payload, &messages[i]));
    member[0].robot->kind->run(member[0].robot, bytes, used, &period);
}

/* Which another server has begun, and left as it was. */
static void test_it_comes_from_a_mission(void)
{
    const struct message messages[] = {
        {.type = MESSAGE_MISSION,
         .mission =
             {
                 .version = PROTOCOL_VERSION,
                 .mission = 1,
                 .k = 256,
                 .k_theta = 768,
                 .v_max = 4000,
                 .omega_max = 4000,
                 .track = 320,
                 .wheel_max = 2400,
                 .latency = 25,
             }},
        {.type = MESSAGE_POSE, .pose = {.time = 15000}},
    };

    tell_before(messages, 2);
    tell_before(NULL, 0);
    run();
    assert_done(0);
}

static void test_it_is_never_seen(void)
{
    blind = true;
    run();
    assert_failed("motion capture does not see its body");
    TEST_ASSERT_DOUBLE_WITHIN(0, 0, member[0].body.x);
}

static void test_it_leaves_its_room(void)
{
    run_until(CALIBRATION_MEASURE);
    run_for(2);
    member[0].body.y += 0.6;
    run_for(0.06);
    assert_failed("0.5 m are its room");
    assert_stands();
}

static void test_another_one_is_put_into_its_room(void)
{
    run_until(CALIBRATION_MEASURE);
    run_for(1);
    turns_see(&turns, 1, 0, 0.5);
    /* At the most it is said that the link is up; motors are told nothing more. */
    uint8_t bytes[64];
    now_us += TICK_MS * 1000;
    TEST_ASSERT_TRUE(calibration[0].job.kind->send(&calibration[0].job, now_us, bytes, 64) <
                     FRAME_BYTES(6));
    assert_failed("stopped: robot 2 stands 0.50 m from it");
    assert_stands();
}

static void test_the_link_is_lost_while_it_drives(void)
{
    run_until(CALIBRATION_MEASURE);
    run_for(1);
    member[0].cut = true;
    tick();
    assert_failed("the link is cut");
    assert_stands();
}

/* For longer than motors go on without a word. */
static void test_the_link_takes_nothing_while_it_drives(void)
{
    run_until(CALIBRATION_MEASURE);
    run_for(1);
    struct job *job = &calibration[0].job;
    int64_t since_us = now_us;
    for (; job->state == JOB_WORKING && now_us < since_us + 1000000; now_us += TICK_MS * 1000) {
        const struct job_pose pose = {member[0].body.x, member[0].body.y, 3, now_us};

        job->kind->seen(job, &pose);
        TEST_ASSERT_EQUAL(0, job->kind->send(job, now_us, NULL, 0));
    }
    assert_failed("its link took nothing for 0.2");
    TEST_ASSERT_TRUE(now_us - since_us <= 220000);
}

/* Its EEPROM still has the old ones. */
static void test_nothing_can_be_given_back(void)
{
    run_until(CALIBRATION_AFTER);
    run_for(1);
    member[0].cut = true;
    tick();
    TEST_ASSERT_EQUAL(CALIBRATION_GIVE_BACK, calibration[0].phase);
    TEST_ASSERT_EQUAL(JOB_WORKING, calibration[0].job.state);
    member[0].cut = false;
    member[0].robot->kind->power_off(member[0].robot);
    member[0].robot->kind->power_on(member[0].robot);
    run();
    assert_failed("the link is cut");
    TEST_ASSERT_EQUAL(16384, in_force(PARAMETER_LEFT_GAIN));
}

static void comes_back_as(uint16_t id)
{
    struct parameters other;

    parameters_default(&other);
    other.value[PARAMETER_ID] = id;
    member[0].cut = true;
    tick();
    member[0].cut = false;
    member[0].robot->kind->power_off(member[0].robot);
    robot_provision(member[0].robot, &other);
    member[0].robot->kind->power_on(member[0].robot);
    run();
}

static void test_another_robot_comes_back(void)
{
    run_until(CALIBRATION_AFTER);
    comes_back_as(5);
    assert_failed("stopped: the link is cut; switch it off and on for its old parameters");
    tearDown();
    setUp();
    run_until(CALIBRATION_CHECK);
    comes_back_as(5);
    assert_failed("robot 5 answers there");
    TEST_ASSERT_NULL(strstr(calibration[0].job.words, "old parameters"));
}

/* Its old parameters are in force again, by what was set and by what is stored. */
static void test_it_fails_by_its_new_parameters(void)
{
    run_until(CALIBRATION_AFTER);
    TEST_ASSERT_NOT_EQUAL(16384, calibration[0].result.value[0]);
    run_for(1);
    blind = true;
    run();
    assert_failed("motion capture has lost its body");
    assert_stands();
    TEST_ASSERT_EQUAL(16384, in_force(PARAMETER_LEFT_GAIN));
    TEST_ASSERT_EQUAL(0, in_force(PARAMETER_MOTOR_LAG));
    TEST_ASSERT_EQUAL(16384, saved(PARAMETER_LEFT_GAIN));
}

static void test_it_is_stopped(void)
{
    run_until(CALIBRATION_AFTER);
    run_for(1);
    calibration_stop(&calibration[0], "interrupted", now_us);
    run_for(1);
    assert_failed("interrupted");
    assert_stands();
    TEST_ASSERT_EQUAL(16384, in_force(PARAMETER_LEFT_GAIN));
}

/* What is being saved is saved. */
static void test_it_is_too_late_to_stop(void)
{
    run_until(CALIBRATION_SAVE);
    calibration_stop(&calibration[0], "interrupted", now_us);
    run();
    assert_done(0);
    TEST_ASSERT_EQUAL(calibration[0].result.value[0], saved(PARAMETER_LEFT_GAIN));
}

/* A wheel that is loose only once its parameters are set. */
static void test_it_drives_worse_than_before(void)
{
    run_until(CALIBRATION_AFTER);
    member[0].kind.right.gain = 0.5;
    run();
    assert_failed("something is loose");
    TEST_ASSERT_EQUAL(16384, in_force(PARAMETER_LEFT_GAIN));
}

static void test_it_has_kept_something_else(void)
{
    run_until(CALIBRATION_CHECK);
    calibration[0].result.value[5]++;
    run();
    assert_failed("has other parameters than it was given");
}

static void test_a_motor_is_reversed(void)
{
    member[0].kind.left.gain = -1;
    run();
    assert_failed("left motor turns backwards");
}

static void test_its_battery_is_empty(void)
{
    member[0].robot->battery = 6000;
    run_for(3);
    assert_failed("stopped by itself: it has an empty battery");
    calibration_begin(&calibration[0], 1, &settings, &turns, 0);
    member[0].up = false;
    run();
    assert_failed("has an empty battery: charge it");
}

static void test_one_drives_after_the_other(void)
{
    count = 2;
    while (calibration[0].job.state == JOB_WORKING) {
        tick();
        TEST_ASSERT_FALSE(place[0].drives && place[1].drives);
        if (place[0].drives)
            TEST_ASSERT_DOUBLE_WITHIN(0, 2, member[1].body.x);
    }
    assert_done(0);
    run();
    assert_done(1);
}

static void test_both_drive_at_the_same_time(void)
{
    bool both = false;

    count = 2;
    turns.together = true;
    while (calibration[0].job.state == JOB_WORKING) {
        tick();
        both |= place[0].drives && place[1].drives;
    }
    TEST_ASSERT_TRUE(both);
    run();
    assert_done(0);
    assert_done(1);
}

/* What takes long is put off until nobody moves. */
static void test_nobody_moves_while_wheels_are_worked_out(void)
{
    bool waited = false;

    count = 2;
    turns.together = true;
    member[1].cut = true;
    run_for(3);
    member[1].cut = false;
    while (calibration[0].job.state == JOB_WORKING) {
        enum calibration_phase before = calibration[0].phase;
        bool moves = place[1].moves;

        waited |= before == CALIBRATION_FIT && moves;
        tick();
        if (before == CALIBRATION_FIT && calibration[0].phase == CALIBRATION_BEFORE) {
            TEST_ASSERT_FALSE(moves && place[1].moves);
        }
    }
    TEST_ASSERT_TRUE(waited);
    run();
    assert_done(0);
    assert_done(1);
}

static void test_another_one_stands_in_its_room(void)
{
    count = 2;
    member[1].body.x = 0.4;
    run();
    assert_failed("robot 2 stands 0.40 m from it");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_measures_sets_and_saves);
    RUN_TEST(test_stays_in_its_room);
    RUN_TEST(test_again);
    RUN_TEST(test_a_dry_run_leaves_all_as_it_was);
    RUN_TEST(test_poses_are_lost_while_it_drives);
    RUN_TEST(test_poses_are_lost_before_it_drives);
    RUN_TEST(test_being_held_up_is_not_being_blind);
    RUN_TEST(test_it_comes_from_a_mission);
    RUN_TEST(test_it_is_never_seen);
    RUN_TEST(test_it_leaves_its_room);
    RUN_TEST(test_another_one_is_put_into_its_room);
    RUN_TEST(test_the_link_is_lost_while_it_drives);
    RUN_TEST(test_the_link_takes_nothing_while_it_drives);
    RUN_TEST(test_nothing_can_be_given_back);
    RUN_TEST(test_another_robot_comes_back);
    RUN_TEST(test_it_fails_by_its_new_parameters);
    RUN_TEST(test_it_is_stopped);
    RUN_TEST(test_it_is_too_late_to_stop);
    RUN_TEST(test_it_drives_worse_than_before);
    RUN_TEST(test_it_has_kept_something_else);
    RUN_TEST(test_a_motor_is_reversed);
    RUN_TEST(test_its_battery_is_empty);
    RUN_TEST(test_one_drives_after_the_other);
    RUN_TEST(test_both_drive_at_the_same_time);
    RUN_TEST(test_nobody_moves_while_wheels_are_worked_out);
    RUN_TEST(test_another_one_stands_in_its_room);
    return UNITY_END();
}
