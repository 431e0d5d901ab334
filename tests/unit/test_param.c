#include "param.h"

#include "parameters.h"
#include "random.h"
#include "rehearsal.h"

#include <string.h>
#include <unity.h>

#define ROBOTS 2
#define LIMIT_US 60000000

static struct rehearsal_member member[ROBOTS];
static struct param_job jobs[ROBOTS];
static struct link_timing timing;
static int64_t now_us;

void setUp(void)
{
    timing = link_timing_of(NATIVE_BAUD);
    now_us = 1000000;
    for (size_t i = 0; i < ROBOTS; i++) {
        struct sim_robot *robot = robot_native_new((uint16_t)(i + 1));

        TEST_ASSERT_TRUE(robot->kind->power_on(robot));
        member[i] = (struct rehearsal_member){.robot = robot, .job = &jobs[i].job};
    }
}

void tearDown(void)
{
    for (size_t i = 0; i < ROBOTS; i++)
        member[i].robot->kind->destroy(member[i].robot);
}

static void power_off(size_t i)
{
    member[i].off = true;
    member[i].robot->kind->power_off(member[i].robot);
}

static void power_on(size_t i)
{
    member[i].off = false;
    TEST_ASSERT_TRUE(member[i].robot->kind->power_on(member[i].robot));
}

/* Another command: its link comes up anew. */
static void begin_one(size_t i, uint16_t robot, const struct param_plan *plan)
{
    param_begin(&jobs[i], robot, plan);
    member[i].up = false;
}

static void begin(const struct param_plan *plan)
{
    for (size_t i = 0; i < ROBOTS; i++)
        begin_one(i, (uint16_t)(i + 1), plan);
}

static void tick(void)
{
    TEST_ASSERT_TRUE(rehearsal_tick(member, ROBOTS, &timing, &now_us, NULL));
}

static void finish(void)
{
    TEST_ASSERT_TRUE(rehearsal_run(member, ROBOTS, &timing, &now_us, LIMIT_US));
}

static void all_done(void)
{
    finish();
    for (size_t i = 0; i < ROBOTS; i++)
        TEST_ASSERT_EQUAL_INT_MESSAGE(JOB_DONE, jobs[i].job.state, jobs[i].job.words);
}

static void run(const struct param_plan *plan)
{
    begin(plan);
    all_done();
}

static struct param_plan to_set(uint8_t index, uint16_t value, bool save)
{
    struct param_plan plan = {.set = param_bit(index), .save = save};

    plan.value[index] = value;
    return plan;
}

static uint32_t before(size_t i, uint8_t index)
{
    return jobs[i].before[param_row(index)].value;
}

static uint32_t after(size_t i, uint8_t index)
{
    return jobs[i].after[param_row(index)].value;
}

static uint32_t read_one(size_t i, uint8_t index)
{
    run(&(struct param_plan){.read = param_bit(index)});
    return before(i, index);
}

static void test_rows_are_the_tables_lines(void)
{
    for (size_t row = 0; row < PARAM_ROWS; row++)
        TEST_ASSERT_EQUAL_UINT(row, param_row(param_index(row)));
    TEST_ASSERT_EQUAL_UINT8(PARAMETERS_READ_FROM, param_index(PARAMETERS_STORED_COUNT));
    TEST_ASSERT_EQUAL_UINT8(PARAMETERS_END - 1, param_index(PARAM_ROWS - 1));
}

static void test_everything_is_read(void)
{
    struct parameters defaults;

    parameters_default(&defaults);
    run(&(struct param_plan){.read = PARAM_ALL});
    for (size_t i = 0; i < ROBOTS; i++) {
        TEST_ASSERT_EQUAL_UINT32(i + 1, before(i, PARAMETER_ID));
        for (uint8_t k = PARAMETER_ID + 1; k < PARAMETERS_STORED_COUNT; k++)
            TEST_ASSERT_EQUAL_UINT32(defaults.value[k], before(i, k));
        TEST_ASSERT_EQUAL_UINT32(0, before(i, PARAMETER_UNSAVED));
        for (size_t row = 0; row < PARAM_ROWS; row++)
            TEST_ASSERT_TRUE(jobs[i].before[row].known);
    }
}

static void test_what_is_set_is_in_force_and_told_with_what_it_was(void)
{
    struct param_plan plan = to_set(PARAMETER_TRACK, 340, false);

    plan.read = param_bit(PARAMETER_UNSAVED);
    run(&plan);
    for (size_t i = 0; i < ROBOTS; i++) {
        TEST_ASSERT_EQUAL_UINT32(0, before(i, PARAMETER_TRACK));
        TEST_ASSERT_EQUAL_UINT32(340, after(i, PARAMETER_TRACK));
        TEST_ASSERT_EQUAL_UINT32(1, after(i, PARAMETER_UNSAVED));
    }
    TEST_ASSERT_EQUAL_UINT32(340, read_one(0, PARAMETER_TRACK));
}

static void test_only_what_is_saved_outlives_a_power_cycle(void)
{
    struct param_plan plan = to_set(PARAMETER_TRACK, 340, true);

    run(&plan);
    plan = to_set(PARAMETER_MOTOR_LAG, 70, false);
    run(&plan);
    power_off(0);
    tick();
    power_on(0);
    TEST_ASSERT_EQUAL_UINT32(340, read_one(0, PARAMETER_TRACK));
    TEST_ASSERT_EQUAL_UINT32(0, read_one(0, PARAMETER_MOTOR_LAG));
    TEST_ASSERT_EQUAL_UINT32(70, read_one(1, PARAMETER_MOTOR_LAG));
}

static void test_a_reset_brings_the_defaults_back_and_leaves_the_id(void)
{
    struct param_plan plan = to_set(PARAMETER_LEFT_GAIN, 15000, true);

    run(&plan);
    run(&(struct param_plan){.reset = true, .save = true});
    for (size_t i = 0; i < ROBOTS; i++) {
        TEST_ASSERT_EQUAL_UINT32(15000, before(i, PARAMETER_LEFT_GAIN));
        TEST_ASSERT_EQUAL_UINT32(16384, after(i, PARAMETER_LEFT_GAIN));
        power_off(i);
        power_on(i);
    }
    TEST_ASSERT_EQUAL_UINT32(16384, read_one(0, PARAMETER_LEFT_GAIN));
    TEST_ASSERT_EQUAL_UINT32(2, read_one(1, PARAMETER_ID));
}

static void test_another_robot_is_not_touched(void)
{
    struct param_plan plan = to_set(PARAMETER_TRACK, 340, true);

    begin(&plan);
    begin_one(1, 9, &plan);
    finish();
    TEST_ASSERT_EQUAL_INT(JOB_DONE, jobs[0].job.state);
    TEST_ASSERT_EQUAL_INT(JOB_FAILED, jobs[1].job.state);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(jobs[1].job.words, "robot 2 answers"), jobs[1].job.words);
    TEST_ASSERT_EQUAL_UINT32(0, read_one(1, PARAMETER_TRACK));
}

static void test_a_robot_without_an_id_is_given_one(void)
{
    struct param_plan plan = to_set(PARAMETER_ID, 700, true);

    member[0].robot->kind->destroy(member[0].robot);
    member[0].robot = robot_native_new(0);
    power_on(0);
    plan.any = true;
    begin(&(struct param_plan){.read = param_bit(PARAMETER_ID)});
    begin_one(0, 700, &plan);
    all_done();
    power_off(0);
    power_on(0);
    begin_one(0, 700, &(struct param_plan){.read = param_bit(PARAMETER_ID)});
    all_done();
    TEST_ASSERT_EQUAL_UINT32(700, before(0, PARAMETER_ID));
}

static void test_a_robot_that_is_given_another_id_is_that_robot(void)
{
    struct param_plan plan = to_set(PARAMETER_ID, 700, true);

    begin(&(struct param_plan){.read = param_bit(PARAMETER_ID)});
    begin_one(0, 1, &plan);
    all_done();
    TEST_ASSERT_EQUAL_UINT16(700, jobs[0].job.robot);
}

static void test_what_the_robot_refuses_is_told_with_its_name(void)
{
    struct param_plan plan = to_set(PARAMETER_LEFT_GAIN, 1, false);

    begin(&plan);
    finish();
    TEST_ASSERT_EQUAL_INT(JOB_FAILED, jobs[0].job.state);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(jobs[0].job.words, "cannot set left_gain"),
                                 jobs[0].job.words);
}

static void test_a_link_that_goes_and_comes_back_costs_nothing_but_time(void)
{
    struct param_plan plan = to_set(PARAMETER_TRACK, 340, true);

    begin(&plan);
    for (unsigned i = 0; i < 10; i++)
        tick();
    member[0].cut = true;
    for (unsigned i = 0; i < 500; i++)
        tick();
    TEST_ASSERT_EQUAL_INT(JOB_WORKING, jobs[0].job.state);
    TEST_ASSERT_EQUAL_INT(JOB_DONE, jobs[1].job.state);
    member[0].cut = false;
    all_done();
    TEST_ASSERT_EQUAL_UINT32(340, after(0, PARAMETER_TRACK));
}

/* The same job over a link that spoils one byte of 50. */
static const struct job_kind *clean;
static uint32_t noise = 1;

static void spoil(uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (random_next(&noise) % 50 == 0)
            bytes[i] ^= (uint8_t)(1u << random_next(&noise) % 8);
}

static void noisy_received(struct job *job, const uint8_t *bytes, size_t count, int64_t at_us)
{
    uint8_t spoilt[ROBOT_TX_MAX];

    memcpy(spoilt, bytes, count);
    spoil(spoilt, count);
    clean->received(job, spoilt, count, at_us);
}

static size_t noisy_send(struct job *job, int64_t at_us, uint8_t *bytes, size_t room)
{
    size_t count = clean->send(job, at_us, bytes, room);

    spoil(bytes, count);
    return count;
}

static void test_noise_costs_nothing_but_time(void)
{
    unsigned lost = 0;

    for (uint16_t track = 1; track <= 50; track++) {
        struct param_plan plan = to_set(PARAMETER_TRACK, track, true);
        struct job_kind noisy;

        begin(&plan);
        clean = jobs[0].job.kind;
        noisy = *clean;
        noisy.received = noisy_received;
        noisy.send = noisy_send;
        jobs[0].job.kind = &noisy;
        all_done();
        TEST_ASSERT_EQUAL_UINT32(track - 1u, before(0, PARAMETER_TRACK));
        TEST_ASSERT_EQUAL_UINT32(track, after(0, PARAMETER_TRACK));
        lost += jobs[0].talk.lost;
    }
    TEST_ASSERT_TRUE(lost > 50);
}

/* Ticks that a plan takes with robot 0, and robot 0 as it was before. */
static unsigned ticks_of(const struct param_plan *plan)
{
    unsigned ticks = 0;

    begin(plan);
    for (; jobs[0].job.state == JOB_WORKING && ticks < 1000; ticks++)
        tick();
    all_done();
    return ticks;
}

static void provision(uint16_t track)
{
    struct param_plan plan = to_set(PARAMETER_TRACK, track, true);

    run(&plan);
}

/* Both banks have been written then, and it is the older one that a save takes. */
static void test_a_cut_at_any_moment_of_a_save_keeps_all_of_the_old_or_the_new_values(void)
{
    struct param_plan plan = to_set(PARAMETER_TRACK, 340, true);
    unsigned olds = 0, news = 0;

    plan.set |= param_bit(PARAMETER_MOTOR_LAG);
    plan.value[PARAMETER_MOTOR_LAG] = 170;
    provision(100);
    unsigned ticks = ticks_of(&plan);
    for (unsigned cut = 0; cut <= ticks; cut++) {
        struct param_plan old = to_set(PARAMETER_TRACK, 100, true);
        struct parameters kept;

        old.set |= param_bit(PARAMETER_MOTOR_LAG);
        run(&old);
        begin(&plan);
        for (unsigned i = 0; i < cut; i++)
            tick();
        power_off(0);
        struct parameters_source source = parameters_read(&kept, member[0].robot->eeprom);
        TEST_ASSERT_TRUE(source.whole >= 1);
        uint16_t track = kept.value[PARAMETER_TRACK], lag = kept.value[PARAMETER_MOTOR_LAG];
        TEST_ASSERT_TRUE((track == 100 && lag == 0) || (track == 340 && lag == 170));
        TEST_ASSERT_EQUAL_UINT16(1, kept.value[PARAMETER_ID]);
        olds += track == 100;
        news += track == 340;
        power_on(0);
        finish();
    }
    TEST_ASSERT_TRUE(olds > 25);
    TEST_ASSERT_TRUE(news > 0);
}

/* A job that is done has done it, whatever happened to the robot meanwhile. */
static void cut_anywhere(const struct param_plan *plan, uint16_t before, uint16_t after)
{
    unsigned failed = 0;

    provision(before);
    unsigned ticks = ticks_of(plan);
    for (unsigned cut = 1; cut < ticks; cut++) {
        provision(before);
        begin(plan);
        for (unsigned i = 0; i < cut; i++)
            tick();
        power_off(0);
        tick();
        power_on(0);
        finish();
        if (jobs[0].job.state == JOB_DONE) {
            TEST_ASSERT_EQUAL_UINT32(after, read_one(0, PARAMETER_TRACK));
            continue;
        }
        failed++;
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(jobs[0].job.words, "reset meanwhile"),
                                     jobs[0].job.words);
    }
    TEST_ASSERT_TRUE(failed > 0 && failed < ticks);
}

static void test_a_power_cycle_at_any_moment_is_noticed_or_does_no_harm(void)
{
    const struct param_plan plan = to_set(PARAMETER_TRACK, 340, true);

    cut_anywhere(&plan, 100, 340);
    cut_anywhere(&(struct param_plan){.reset = true, .save = true}, 100, 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_rows_are_the_tables_lines);
    RUN_TEST(test_everything_is_read);
    RUN_TEST(test_what_is_set_is_in_force_and_told_with_what_it_was);
    RUN_TEST(test_only_what_is_saved_outlives_a_power_cycle);
    RUN_TEST(test_a_reset_brings_the_defaults_back_and_leaves_the_id);
    RUN_TEST(test_another_robot_is_not_touched);
    RUN_TEST(test_a_robot_without_an_id_is_given_one);
    RUN_TEST(test_a_robot_that_is_given_another_id_is_that_robot);
    RUN_TEST(test_what_the_robot_refuses_is_told_with_its_name);
    RUN_TEST(test_a_link_that_goes_and_comes_back_costs_nothing_but_time);
    RUN_TEST(test_noise_costs_nothing_but_time);
    RUN_TEST(test_a_cut_at_any_moment_of_a_save_keeps_all_of_the_old_or_the_new_values);
    RUN_TEST(test_a_power_cycle_at_any_moment_is_noticed_or_does_no_harm);
    return UNITY_END();
}
