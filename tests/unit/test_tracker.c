#include "tracker.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define ROBOTS 3

static struct tracker_settings settings;
static struct tracker_body bodies[ROBOTS];
static struct tracker *tracker;
static struct capture_frame frame;

void setUp(void)
{
    settings = (struct tracker_settings){.up = UP_Z, .jump = 0.3};
    bodies[0] = (struct tracker_body){"one", CAPTURE_ID_NONE, 0};
    bodies[1] = (struct tracker_body){"two", CAPTURE_ID_NONE, 0};
    bodies[2] = (struct tracker_body){NULL, 7, 0};
    memset(&frame, 0, sizeof frame);
    frame.time = NAN;
    tracker = NULL;
}

void tearDown(void)
{
    free(tracker);
}

static void begin(void)
{
    free(tracker);
    tracker = tracker_init(malloc(tracker_footprint(ROBOTS)), &settings, bodies, ROBOTS);
}

static struct capture_body *add(const char *name, int32_t id, double x, double y, double yaw)
{
    struct capture_body *body = &frame.body[frame.count++];

    memset(body, 0, sizeof *body);
    snprintf(body->name, sizeof body->name, "%s", name);
    body->id = id;
    body->tracked = true;
    body->at[0] = x;
    body->at[1] = y;
    body->turn[2] = sin(yaw / 2);
    body->turn[3] = cos(yaw / 2);
    return body;
}

static bool near(double a, double b)
{
    return fabs(a - b) < 1e-9;
}

/* ---- whose ----------------------------------------------------------------------------- */

static void test_bodies_are_found_by_name_and_by_number(void)
{
    begin();
    add("two", 1, 2, 0, 0);
    add("one", 2, 1, 0, 0);
    add("whatever", 7, 3, 0, 0);
    TEST_ASSERT_EQUAL_UINT64(3, tracker_take(tracker, &frame, 1000));
    for (size_t i = 0; i < ROBOTS; i++) {
        TEST_ASSERT_TRUE(tracker_look(tracker, i)->fresh);
        TEST_ASSERT_TRUE(near(tracker_look(tracker, i)->x, (double)i + 1));
    }
    TEST_ASSERT_NULL(tracker_stranger(tracker, 0));
}

static void test_a_name_with_a_number_wants_both(void)
{
    bodies[0].id = 4;
    begin();
    add("one", 5, 1, 0, 0);
    TEST_ASSERT_EQUAL_UINT64(0, tracker_take(tracker, &frame, 1000));
    frame.body[0].id = 4;
    TEST_ASSERT_EQUAL_UINT64(1, tracker_take(tracker, &frame, 2000));
}

static void test_bodies_of_nobody_are_told_of_once(void)
{
    begin();
    add("chair", 9, 0, 0, 0);
    add("", 11, 0, 0, 0);
    tracker_take(tracker, &frame, 1000);
    tracker_take(tracker, &frame, 2000);
    TEST_ASSERT_EQUAL_STRING("chair", tracker_stranger(tracker, 0));
    TEST_ASSERT_EQUAL_STRING("number 11", tracker_stranger(tracker, 1));
    TEST_ASSERT_NULL(tracker_stranger(tracker, 2));
}

static void test_a_robot_whose_name_comes_late_is_no_stranger(void)
{
    begin();
    add("", 1, 0, 0, 0);
    tracker_take(tracker, &frame, 1000);
    TEST_ASSERT_EQUAL_STRING("number 1", tracker_stranger(tracker, 0));
    begin();
    add("one", 1, 0, 0, 0);
    tracker_take(tracker, &frame, 2000);
    TEST_ASSERT_NULL(tracker_stranger(tracker, 0));
}

static void test_bodies_that_change_their_order_keep_their_robots(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    add("two", 2, 2, 0, 0);
    tracker_take(tracker, &frame, 1000);
    struct capture_body first = frame.body[0];
    frame.body[0] = frame.body[1];
    frame.body[1] = first;
    tracker_take(tracker, &frame, 2000);
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->x, 1));
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 1)->x, 2));
}

/* ---- where ----------------------------------------------------------------------------- */

static void test_z_up_is_taken_as_it_is(void)
{
    begin();
    add("one", 1, 1, 2, 0.7);
    tracker_take(tracker, &frame, 1000);
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->x, 1));
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->y, 2));
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->theta, 0.7));
}

/* With y up, a robot that turns to the left turns about y. */
static void test_y_up_is_turned(void)
{
    settings.up = UP_Y;
    begin();
    struct capture_body *body = add("one", 1, 1, 0.1, 0);
    body->at[2] = -2;
    body->turn[1] = sin(0.35);
    body->turn[2] = 0;
    body->turn[3] = cos(0.35);
    tracker_take(tracker, &frame, 1000);
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->x, 1));
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->y, 2));
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->theta, 0.7));
}

static void test_a_tilt_does_not_turn_the_heading(void)
{
    begin();
    struct capture_body *body = add("one", 1, 0, 0, 0);
    body->turn[0] = sin(0.2); /* rolled about its own axis */
    body->turn[3] = cos(0.2);
    tracker_take(tracker, &frame, 1000);
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->theta, 0));
}

static void test_units_and_headings_are_the_sites(void)
{
    settings.scale = 0.001;
    bodies[0].heading = M_PI;
    begin();
    add("one", 1, 1500, -250, 1);
    tracker_take(tracker, &frame, 1000);
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->x, 1.5));
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->y, -0.25));
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->theta, 1 - M_PI));
}

static void test_no_number_is_no_pose(void)
{
    begin();
    add("one", 1, NAN, 0, 0);
    add("two", 2, 0, 3000, 0);
    TEST_ASSERT_EQUAL_UINT64(0, tracker_take(tracker, &frame, 1000));
    TEST_ASSERT_FALSE(tracker_look(tracker, 0)->seen);
    TEST_ASSERT_FALSE(tracker_look(tracker, 1)->seen);
}

static void test_speeds_come_from_places(void)
{
    begin();
    add("one", 1, 0, 0, 0);
    for (int i = 1; i <= 20; i++) {
        frame.body[0].at[0] = 0.01 * i;
        tracker_take(tracker, &frame, i * 10000);
    }
    TEST_ASSERT_TRUE(fabs(tracker_look(tracker, 0)->v - 1) < 1e-6);
    TEST_ASSERT_TRUE(fabs(tracker_look(tracker, 0)->omega) < 1e-6);
}

/* ---- whether to believe it ------------------------------------------------------------- */

static void test_a_lost_body_keeps_its_place_and_is_not_fresh(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    tracker_take(tracker, &frame, 1000);
    frame.body[0].tracked = false;
    frame.body[0].at[0] = 5;
    TEST_ASSERT_EQUAL_UINT64(0, tracker_take(tracker, &frame, 2000));
    TEST_ASSERT_FALSE(tracker_look(tracker, 0)->tracked);
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->x, 1));
    TEST_ASSERT_EQUAL_INT64(1000, tracker_look(tracker, 0)->measured_us);
}

static void test_a_body_that_jumps_is_not_believed_until_it_is_back(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    tracker_take(tracker, &frame, 10000);
    frame.body[0].at[0] = 1.5;
    for (int i = 2; i < 1000; i++)
        TEST_ASSERT_EQUAL_UINT64(0, tracker_take(tracker, &frame, i * 10000));
    TEST_ASSERT_TRUE(tracker_look(tracker, 0)->jumped);
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->jump, 0.5));
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->x, 1));
    frame.body[0].at[0] = 1.2;
    TEST_ASSERT_EQUAL_UINT64(1, tracker_take(tracker, &frame, 10000000));
    TEST_ASSERT_FALSE(tracker_look(tracker, 0)->jumped);
}

static void test_a_person_may_say_that_it_is_there(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    tracker_take(tracker, &frame, 10000);
    frame.body[0].at[0] = 5;
    tracker_take(tracker, &frame, 20000);
    tracker_believe(tracker);
    TEST_ASSERT_EQUAL_UINT64(1, tracker_take(tracker, &frame, 30000));
    TEST_ASSERT_TRUE(near(tracker_look(tracker, 0)->x, 5));
}

static void test_a_fast_robot_may_be_unseen_for_a_while(void)
{
    begin();
    add("one", 1, 0, 0, 0);
    for (int i = 1; i <= 10; i++) {
        frame.body[0].at[0] = 0.02 * i;
        tracker_take(tracker, &frame, i * 10000);
    }
    frame.body[0].at[0] = 0.2 + 0.6; /* 0.3 s at 2 m/s */
    TEST_ASSERT_EQUAL_UINT64(1, tracker_take(tracker, &frame, 400000));
}

static void test_without_a_gate_everything_is_believed(void)
{
    settings.jump = 0;
    begin();
    add("one", 1, 1, 0, 0);
    tracker_take(tracker, &frame, 10000);
    frame.body[0].at[0] = 100;
    TEST_ASSERT_EQUAL_UINT64(1, tracker_take(tracker, &frame, 20000));
}

/* ---- when ------------------------------------------------------------------------------ */

static int64_t measured(double time, int64_t arrival_us)
{
    frame.time = time;
    tracker_take(tracker, &frame, arrival_us);
    return tracker_look(tracker, 0)->measured_us;
}

static void test_a_late_frame_bears_the_time_of_its_measurement(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    TEST_ASSERT_EQUAL_INT64(5000000, measured(100.00, 5000000));
    TEST_ASSERT_TRUE(llabs(measured(100.01, 5017000) - 5010000) <= 2);
    TEST_ASSERT_TRUE(llabs(measured(100.02, 5020500) - 5020000) <= 4);
}

static void test_a_frame_that_is_faster_than_all_before_sets_the_clock(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    measured(100.00, 5000000);
    TEST_ASSERT_EQUAL_INT64(5007000, measured(100.01, 5007000));
    TEST_ASSERT_TRUE(llabs(measured(100.02, 5020000) - 5017000) <= 2);
}

static void test_a_clock_that_is_set_is_followed(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    measured(100.00, 5000000);
    TEST_ASSERT_EQUAL_INT64(5010000, measured(3.5, 5010000));
    TEST_ASSERT_EQUAL_INT64(5020000, measured(9e6, 5020000));
}

static void test_a_frame_that_was_held_up_for_long_is_as_old_as_it_is(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    measured(100.00, 5000000);
    TEST_ASSERT_EQUAL_INT64(5010000, measured(100.01, 9000000));
}

/* Its clock stood while it paused. */
static void test_a_system_that_paused_is_understood_in_the_end(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    measured(100.00, 5000000);
    for (int i = 1; i <= 1100; i++)
        measured(100.00 + 0.01 * i, 65000000 + 10000 * i);
    TEST_ASSERT_EQUAL_INT64(76010000, measured(111.01, 76010000));
}

static void test_the_rate_of_the_systems_clock(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    for (int i = 0; i < 200; i++)
        measured(7 + 0.0102 * i, 5000000 + 10000 * i);
    TEST_ASSERT_TRUE(fabs(tracker_clock_rate(tracker) - 1.02) < 1e-9);
    measured(3, 7000000);
    TEST_ASSERT_TRUE(isnan(tracker_clock_rate(tracker)));
}

static void test_latency_is_the_systems_or_the_sites(void)
{
    settings.latency = 0.004;
    begin();
    add("one", 1, 1, 0, 0);
    TEST_ASSERT_EQUAL_INT64(4996000, measured(NAN, 5000000));
    frame.latency = 0.010;
    TEST_ASSERT_EQUAL_INT64(4990000, measured(NAN, 5000000));
}

static void test_a_frame_that_was_overtaken_is_dropped_and_a_restart_is_not(void)
{
    begin();
    add("one", 1, 1, 0, 0);
    frame.numbered = true;
    frame.number = 500;
    TEST_ASSERT_EQUAL_UINT64(1, tracker_take(tracker, &frame, 10000));
    frame.number = 498;
    TEST_ASSERT_EQUAL_UINT64(0, tracker_take(tracker, &frame, 20000));
    frame.number = 3;
    TEST_ASSERT_EQUAL_UINT64(1, tracker_take(tracker, &frame, 30000));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bodies_are_found_by_name_and_by_number);
    RUN_TEST(test_a_name_with_a_number_wants_both);
    RUN_TEST(test_bodies_of_nobody_are_told_of_once);
    RUN_TEST(test_a_robot_whose_name_comes_late_is_no_stranger);
    RUN_TEST(test_bodies_that_change_their_order_keep_their_robots);
    RUN_TEST(test_z_up_is_taken_as_it_is);
    RUN_TEST(test_y_up_is_turned);
    RUN_TEST(test_a_tilt_does_not_turn_the_heading);
    RUN_TEST(test_units_and_headings_are_the_sites);
    RUN_TEST(test_no_number_is_no_pose);
    RUN_TEST(test_speeds_come_from_places);
    RUN_TEST(test_a_lost_body_keeps_its_place_and_is_not_fresh);
    RUN_TEST(test_a_body_that_jumps_is_not_believed_until_it_is_back);
    RUN_TEST(test_a_person_may_say_that_it_is_there);
    RUN_TEST(test_a_fast_robot_may_be_unseen_for_a_while);
    RUN_TEST(test_without_a_gate_everything_is_believed);
    RUN_TEST(test_a_late_frame_bears_the_time_of_its_measurement);
    RUN_TEST(test_a_frame_that_is_faster_than_all_before_sets_the_clock);
    RUN_TEST(test_a_clock_that_is_set_is_followed);
    RUN_TEST(test_a_frame_that_was_held_up_for_long_is_as_old_as_it_is);
    RUN_TEST(test_a_system_that_paused_is_understood_in_the_end);
    RUN_TEST(test_the_rate_of_the_systems_clock);
    RUN_TEST(test_latency_is_the_systems_or_the_sites);
    RUN_TEST(test_a_frame_that_was_overtaken_is_dropped_and_a_restart_is_not);
    return UNITY_END();
}
