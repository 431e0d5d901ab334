#include "supervisor.h"

#include <unity.h>

#define ALL_WELL (HAS_ID | HAS_MISSION | STARTED | POSE_FRESH | LINK_UP)

void setUp(void)
{
}

void tearDown(void)
{
}

static uint8_t after(uint8_t state, uint8_t conditions)
{
    return supervisor_next((enum supervisor_state)state, conditions);
}

static void test_the_way_to_run(void)
{
    TEST_ASSERT_EQUAL(STATE_IDLE, after(STATE_BOOT, HAS_ID));
    TEST_ASSERT_EQUAL(STATE_READY, after(STATE_IDLE, HAS_ID | HAS_MISSION));
    TEST_ASSERT_EQUAL(STATE_RUN, after(STATE_READY, ALL_WELL));
    TEST_ASSERT_EQUAL(STATE_RUN, after(STATE_RUN, ALL_WELL));
}

/* Only READY and HOLD lead to RUN, and RUN lasts no longer than what it needs. */
static void test_run_needs_every_condition(void)
{
    const uint8_t needed = STARTED | POSE_FRESH | LINK_UP;

    for (uint8_t state = STATE_BOOT; state <= STATE_SPENT; state++) {
        for (uint8_t conditions = 0;; conditions++) {
            bool moves = after(state, conditions) == STATE_RUN;
            bool may = (state == STATE_READY || state == STATE_RUN || state == STATE_HOLD) &&
                       (conditions & needed) == needed && (conditions & HAS_MISSION) &&
                       (state != STATE_READY || conditions & HAS_ID) &&
                       !(conditions & (ESTOPPED | SPENT));

            TEST_ASSERT_EQUAL(may, moves);
            if (conditions == UINT8_MAX)
                break;
        }
    }
}

static void test_a_stale_pose_or_a_lost_link_holds_and_its_return_resumes(void)
{
    TEST_ASSERT_EQUAL(STATE_HOLD, after(STATE_RUN, ALL_WELL & ~POSE_FRESH));
    TEST_ASSERT_EQUAL(STATE_HOLD, after(STATE_RUN, ALL_WELL & ~LINK_UP));
    TEST_ASSERT_EQUAL(STATE_HOLD, after(STATE_HOLD, ALL_WELL & ~POSE_FRESH));
    TEST_ASSERT_EQUAL(STATE_RUN, after(STATE_HOLD, ALL_WELL));
}

static void test_a_mission_taken_away_stops(void)
{
    TEST_ASSERT_EQUAL(STATE_IDLE, after(STATE_RUN, ALL_WELL & ~HAS_MISSION));
    TEST_ASSERT_EQUAL(STATE_IDLE, after(STATE_HOLD, ALL_WELL & ~HAS_MISSION));
    TEST_ASSERT_EQUAL(STATE_READY, after(STATE_RUN, ALL_WELL & ~STARTED));
}

static void test_an_emergency_stop_is_for_good(void)
{
    for (uint8_t state = STATE_BOOT; state <= STATE_SPENT; state++)
        TEST_ASSERT_EQUAL(STATE_ESTOP, after(state, ALL_WELL | ESTOPPED | SPENT));
    for (uint8_t conditions = 0; conditions < UINT8_MAX; conditions++)
        TEST_ASSERT_EQUAL(STATE_ESTOP, after(STATE_ESTOP, conditions));
}

static void test_a_spent_robot_stands_for_good(void)
{
    for (uint8_t state = STATE_BOOT; state <= STATE_SPENT; state++)
        if (state != STATE_ESTOP)
            TEST_ASSERT_EQUAL(STATE_SPENT, after(state, ALL_WELL | DRIVEN | SPENT));
    for (uint8_t conditions = 0; conditions < UINT8_MAX; conditions++)
        if (!(conditions & ESTOPPED))
            TEST_ASSERT_EQUAL(STATE_SPENT, after(STATE_SPENT, conditions));
}

/* From IDLE, or before a mission starts, with an id and a link; never from a mission. */
static void test_a_trial_needs_every_condition(void)
{
    const uint8_t needed = HAS_ID | DRIVEN | LINK_UP;

    for (uint8_t state = STATE_BOOT; state <= STATE_SPENT; state++) {
        for (uint8_t conditions = 0; conditions < UINT8_MAX; conditions++) {
            bool waits = (conditions & (HAS_MISSION | STARTED)) != (HAS_MISSION | STARTED);
            bool ready = state == STATE_READY && conditions & HAS_MISSION;
            bool idle = state == STATE_IDLE && !(conditions & HAS_MISSION);
            bool may = (ready || idle || state == STATE_TRIAL) && waits &&
                       (conditions & needed) == needed && !(conditions & (ESTOPPED | SPENT));

            TEST_ASSERT_EQUAL(may, after(state, conditions) == STATE_TRIAL);
        }
    }
}

static void test_a_trial_ends_without_fresh_words(void)
{
    const uint8_t trying = HAS_ID | DRIVEN | LINK_UP;

    TEST_ASSERT_EQUAL(STATE_IDLE, after(STATE_TRIAL, trying & ~DRIVEN));
    TEST_ASSERT_EQUAL(STATE_IDLE, after(STATE_TRIAL, trying & ~LINK_UP));
    TEST_ASSERT_EQUAL(STATE_BOOT, after(STATE_TRIAL, trying & ~HAS_ID));
    TEST_ASSERT_EQUAL(STATE_READY, after(STATE_TRIAL, ALL_WELL | DRIVEN));
}

static void test_an_id_taken_away_leads_back_to_boot(void)
{
    TEST_ASSERT_EQUAL(STATE_BOOT, after(STATE_IDLE, 0));
    TEST_ASSERT_EQUAL(STATE_BOOT, after(STATE_READY, ALL_WELL & ~HAS_ID));
}

static void test_a_robot_without_an_id_stays_in_boot(void)
{
    TEST_ASSERT_EQUAL(STATE_BOOT, after(STATE_BOOT, ALL_WELL & ~HAS_ID));
}

static struct stall watched(int16_t v, struct pose *pose, int32_t step, int16_t turn, int ticks)
{
    struct stall stall = {.anchor = *pose};

    for (int i = 0; i < ticks; i++) {
        stall_watch(&stall, pose, v);
        pose->at.x += step;
        pose->theta += (angle_t)turn;
    }
    return stall;
}

static void test_a_stall_is_seen_after_500_ms(void)
{
    struct pose pose = {{4000, 0}, 0};

    TEST_ASSERT_FALSE(watched(STALL_SPEED + 1, &pose, 0, 0, STALL_TICKS).raised);
    TEST_ASSERT_TRUE(watched(STALL_SPEED + 1, &pose, 0, 0, STALL_TICKS + 1).raised);
    TEST_ASSERT_TRUE(watched(-STALL_SPEED - 1, &pose, 0, 0, STALL_TICKS + 1).raised);
}

static void test_slow_commands_motion_and_turning_are_no_stall(void)
{
    struct pose pose = {{0, 0}, 0};

    TEST_ASSERT_FALSE(watched(STALL_SPEED, &pose, 0, 0, 100).raised);
    TEST_ASSERT_FALSE(watched(400, &pose, 2, 0, 100).raised);
    TEST_ASSERT_FALSE(watched(400, &pose, 0, 200, 100).raised);
}

static void test_a_stall_ends_when_the_robot_moves(void)
{
    struct pose pose = {{0, 0}, 0};
    struct stall stall = watched(4000, &pose, 0, 0, 100);

    TEST_ASSERT_TRUE(stall.raised);
    pose.at.y += STALL_DISTANCE;
    stall_watch(&stall, &pose, 4000);
    TEST_ASSERT_FALSE(stall.raised);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_way_to_run);
    RUN_TEST(test_run_needs_every_condition);
    RUN_TEST(test_a_stale_pose_or_a_lost_link_holds_and_its_return_resumes);
    RUN_TEST(test_a_mission_taken_away_stops);
    RUN_TEST(test_an_emergency_stop_is_for_good);
    RUN_TEST(test_a_spent_robot_stands_for_good);
    RUN_TEST(test_a_trial_needs_every_condition);
    RUN_TEST(test_a_trial_ends_without_fresh_words);
    RUN_TEST(test_an_id_taken_away_leads_back_to_boot);
    RUN_TEST(test_a_robot_without_an_id_stays_in_boot);
    RUN_TEST(test_a_stall_is_seen_after_500_ms);
    RUN_TEST(test_slow_commands_motion_and_turning_are_no_stall);
    RUN_TEST(test_a_stall_ends_when_the_robot_moves);
    return UNITY_END();
}
