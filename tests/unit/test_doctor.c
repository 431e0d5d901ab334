#include "doctor.h"

#include "diagnosis.h"
#include "parameters.h"
#include "rehearsal.h"

#include <string.h>
#include <unity.h>

#define ROBOTS 3
#define LIMIT_US 60000000

static struct rehearsal_member member[ROBOTS];
static struct doctor_job jobs[ROBOTS];
static struct diagnosis diagnosis;
static struct diagnosis_image image;
static struct link_timing timing;
static int64_t now_us;

void setUp(void)
{
    timing = link_timing_of(NATIVE_BAUD);
    now_us = 1000000;
    image = (struct diagnosis_image){.f_cpu = 16000000};
    for (size_t i = 0; i < ROBOTS; i++) {
        struct sim_robot *robot = robot_native_new((uint16_t)(i + 1));

        TEST_ASSERT_TRUE(robot->kind->power_on(robot));
        doctor_begin(&jobs[i], (uint16_t)(i + 1), 2);
        member[i] = (struct rehearsal_member){.robot = robot, .job = &jobs[i].job};
    }
}

void tearDown(void)
{
    for (size_t i = 0; i < ROBOTS; i++)
        member[i].robot->kind->destroy(member[i].robot);
}

static void look(void)
{
    TEST_ASSERT_TRUE(rehearsal_run(member, ROBOTS, &timing, &now_us, LIMIT_US));
}

static void is_good(size_t i)
{
    diagnosis_make(&diagnosis, jobs, ROBOTS, i, &image);
    TEST_ASSERT_EQUAL_UINT_MESSAGE(0, diagnosis.count, diagnosis.words[0]);
}

/* Only this is wrong with it. */
static void is_ill(size_t i, const char *words)
{
    diagnosis_make(&diagnosis, jobs, ROBOTS, i, &image);
    TEST_ASSERT_EQUAL_UINT_MESSAGE(1, diagnosis.count, words);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(diagnosis.words[0], words), diagnosis.words[0]);
}

static void test_robots_as_they_should_be_are_good(void)
{
    look();
    for (size_t i = 0; i < ROBOTS; i++) {
        is_good(i);
        TEST_ASSERT_TRUE(jobs[i].asks >= 30 && jobs[i].asks <= 41);
        TEST_ASSERT_EQUAL_UINT32(jobs[i].asks, jobs[i].trips);
        TEST_ASSERT_TRUE(jobs[i].trip_us[0] >= 20000);
        TEST_ASSERT_TRUE(jobs[i].trip_us[jobs[i].trips - 1] <= 40000);
        TEST_ASSERT_TRUE(jobs[i].talk.statuses >= 4);
    }
}

static void test_a_robot_that_cannot_be_asked_is_ill_of_that(void)
{
    member[0].off = true;
    member[1].cut = true;
    for (unsigned i = 0; i < 200; i++)
        TEST_ASSERT_TRUE(rehearsal_tick(member, ROBOTS, &timing, &now_us, NULL));
    job_failed(&jobs[0].job, "nothing heard");
    job_failed(&jobs[1].job, "nothing heard");
    is_ill(0, "nothing heard");
    is_good(2);
}

static void test_what_was_asked_before_a_robot_was_on_is_not_lost(void)
{
    jobs[0].talk.lost = 4;
    look();
    is_good(0);
}

static void test_ids_that_are_not_the_sites_are_told(void)
{
    member[0].robot->kind->destroy(member[0].robot);
    member[0].robot = robot_native_new(0);
    TEST_ASSERT_TRUE(member[0].robot->kind->power_on(member[0].robot));
    jobs[1].job.robot = 8;
    look();
    is_good(2);
    is_ill(1, "says it is robot 2");
    diagnosis_make(&diagnosis, jobs, ROBOTS, 0, &image);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(diagnosis.words[0], "has no id"), diagnosis.words[0]);
}

static void test_a_battery_is_judged_by_the_robots_own_limits(void)
{
    struct parameters own;

    member[0].robot->battery = 6500;
    member[1].robot->battery = 6100;
    parameters_default(&own);
    own.value[PARAMETER_ID] = 3;
    own.value[PARAMETER_BATTERY_WARNING] = 7600;
    member[2].robot->kind->power_off(member[2].robot);
    robot_provision(member[2].robot, &own);
    TEST_ASSERT_TRUE(member[2].robot->kind->power_on(member[2].robot));
    look();
    is_ill(0, "below its battery_warning of 6.60 V");
    is_ill(1, "has stopped for its battery");
    is_ill(2, "below its battery_warning of 7.60 V");
}

static void test_lost_questions_and_late_answers_show(void)
{
    look();
    jobs[0].talk.lost = 2;
    is_ill(0, "5 % of the questions were lost");
    jobs[1].trip_us[jobs[1].trips - 1] = 400000;
    is_ill(1, "an answer took 400 ms");
}

static struct param_reading *reading(size_t i, uint8_t index)
{
    return &jobs[i].reading[param_row(index)];
}

static void test_values_that_are_not_saved_are_told(void)
{
    look();
    reading(1, PARAMETER_UNSAVED)->value = 1;
    is_ill(1, "not saved");
    is_good(0);
    reading(0, PARAMETER_EEPROM)->value = 0;
    is_ill(0, "no whole copy");
}

static void test_a_program_is_to_be_the_one_that_came_with_muster(void)
{
    look();
    for (size_t i = 0; i < ROBOTS; i++)
        reading(i, PARAMETER_IMAGE)->value = 0x11;
    image.known = true;
    image.crc = 0x11;
    is_good(0);
    image.crc = 0x22;
    is_ill(0, "runs program 00000011, with muster came 00000022");
    reading(1, PARAMETER_IMAGE)->value = 0xFFFFFFFF;
    is_ill(1, "no seal");
}

static void test_else_it_is_to_be_the_others(void)
{
    look();
    for (size_t i = 0; i < ROBOTS; i++)
        reading(i, PARAMETER_IMAGE)->value = 0x11;
    reading(0, PARAMETER_IMAGE)->value = 0x33;
    is_ill(0, "runs program 00000033, the others 00000011");
    is_good(1);
}

static void test_a_processor_without_reserves_is_told(void)
{
    look();
    for (size_t i = 0; i < ROBOTS; i++) {
        jobs[i].talk.status.tick_cycles = 3000; /* 1.5 ms */
        jobs[i].talk.status.stack_free = 900;
    }
    is_good(0);
    jobs[0].talk.status.tick_cycles = 9900;
    is_ill(0, "control tick took 4.95 ms of 5");
    jobs[1].talk.status.stack_free = 8;
    is_ill(1, "8 bytes");
}

static void test_resets_are_told_with_their_cause(void)
{
    look();
    reading(0, PARAMETER_RESETS)->value = 2;
    jobs[0].talk.status.reset_cause = 4;
    is_ill(0, "2 resets since power-on, the last by brown-out");
    reading(1, PARAMETER_RESETS)->value = 1;
    jobs[1].talk.status.reset_cause = 8;
    is_ill(1, "watchdog");
    reading(2, PARAMETER_RESETS)->value = 1;
    jobs[2].talk.status.reset_cause = 2; /* the button */
    is_good(2);
}

static void test_what_receivers_lose_is_told(void)
{
    look();
    jobs[0].talk.status.bad_frames = 5;
    jobs[0].first.bad_frames = 1;
    is_ill(0, "frames come broken, 0 here and 4 there");
    jobs[1].talk.status.overruns = 1;
    is_ill(1, "lost 1 bytes");
    jobs[2].talk.status.overruns = jobs[2].first.overruns = 7;
    is_good(2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_robots_as_they_should_be_are_good);
    RUN_TEST(test_a_robot_that_cannot_be_asked_is_ill_of_that);
    RUN_TEST(test_what_was_asked_before_a_robot_was_on_is_not_lost);
    RUN_TEST(test_ids_that_are_not_the_sites_are_told);
    RUN_TEST(test_a_battery_is_judged_by_the_robots_own_limits);
    RUN_TEST(test_lost_questions_and_late_answers_show);
    RUN_TEST(test_values_that_are_not_saved_are_told);
    RUN_TEST(test_a_program_is_to_be_the_one_that_came_with_muster);
    RUN_TEST(test_else_it_is_to_be_the_others);
    RUN_TEST(test_a_processor_without_reserves_is_told);
    RUN_TEST(test_resets_are_told_with_their_cause);
    RUN_TEST(test_what_receivers_lose_is_told);
    return UNITY_END();
}
