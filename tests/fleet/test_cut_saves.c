/* A chip whose power is cut in the midst of a save, at every tick of it in turn, has all of the old
 * values or all of the new ones when it is switched on again. */
#include "param.h"

#include "parameters.h"
#include "rehearsal.h"

#include <stdio.h>
#include <unity.h>

#define LIMIT_US 60000000
#define ROBOT 9

static const char *firmware;
static struct avr_image *image;
static struct rehearsal_member member;
static struct param_job job;
static struct link_timing timing;
static int64_t now_us;

void setUp(void)
{
    char error[256];

    image = avr_image_open(firmware, error, sizeof error);
    TEST_ASSERT_NOT_NULL_MESSAGE(image, error);
    timing = link_timing_of(avr_image_baud(image));
    now_us = 1000000;
    member = (struct rehearsal_member){.robot = robot_avr_new(ROBOT, image), .job = &job.job};
    TEST_ASSERT_TRUE(member.robot->kind->power_on(member.robot));
}

void tearDown(void)
{
    member.robot->kind->destroy(member.robot);
    avr_image_close(image);
}

static void tick(void)
{
    TEST_ASSERT_TRUE(rehearsal_tick(&member, 1, &timing, &now_us, NULL));
}

/* Another command: its link comes up anew. */
static void begin(const struct param_plan *plan)
{
    param_begin(&job, ROBOT, plan);
    member.up = false;
}

static void finish(void)
{
    TEST_ASSERT_TRUE(rehearsal_run(&member, 1, &timing, &now_us, LIMIT_US));
    TEST_ASSERT_EQUAL_INT_MESSAGE(JOB_DONE, job.job.state, job.job.words);
}

static struct param_plan to_save(uint16_t gain, uint16_t track)
{
    struct param_plan plan = {
        .set = param_bit(PARAMETER_LEFT_GAIN) | param_bit(PARAMETER_TRACK),
        .save = true,
    };

    plan.value[PARAMETER_LEFT_GAIN] = gain;
    plan.value[PARAMETER_TRACK] = track;
    return plan;
}

static uint32_t before(uint8_t index)
{
    return job.before[param_row(index)].value;
}

/* Whether the new values are there; what it holds is whole. */
static bool cut_at(unsigned ticks)
{
    const struct param_plan old = to_save(15000, 300), new = to_save(17000, 400);

    begin(&old);
    finish();
    begin(&new);
    for (unsigned i = 0; i < ticks; i++)
        tick();
    member.off = true;
    member.robot->kind->power_off(member.robot);
    tick();
    member.off = false;
    TEST_ASSERT_TRUE(member.robot->kind->power_on(member.robot));
    begin(&(struct param_plan){.read = PARAM_ALL});
    finish();
    TEST_ASSERT_EQUAL_UINT32(ROBOT, before(PARAMETER_ID));
    TEST_ASSERT_TRUE(before(PARAMETER_EEPROM) >= 1);
    bool is_new = before(PARAMETER_LEFT_GAIN) == 17000;
    TEST_ASSERT_EQUAL_UINT32(is_new ? 17000 : 15000, before(PARAMETER_LEFT_GAIN));
    TEST_ASSERT_EQUAL_UINT32(is_new ? 400 : 300, before(PARAMETER_TRACK));
    return is_new;
}

static void test_a_save_that_is_cut_short_leaves_old_or_new_values(void)
{
    struct param_plan plan = to_save(15000, 300);
    unsigned ticks = 0, news = 0;

    begin(&plan);
    for (; job.job.state == JOB_WORKING && ticks < 1000; ticks++)
        tick();
    for (unsigned cut = 0; cut <= ticks; cut++)
        news += cut_at(cut);
    printf("%u cuts: %u times the old values, %u times the new ones\n", ticks + 1, ticks + 1 - news,
           news);
    TEST_ASSERT_TRUE(news > 0 && news < ticks - PARAMETERS_RECORD_BYTES);
}

int main(int argc, char **argv)
{
    (void)argc;
    firmware = argv[1];
    UNITY_BEGIN();
    RUN_TEST(test_a_save_that_is_cut_short_leaves_old_or_new_values);
    return UNITY_END();
}
