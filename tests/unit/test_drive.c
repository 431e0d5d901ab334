#include "drive.h"

#include "limits.h"
#include "wheel_fit.h"

#include <math.h>
#include <stdlib.h>
#include <unity.h>

static const struct drive_wheels small = {.track = 0.08, .wheel_max = 0.6};
static struct drive_plan plan;
static struct drive_record record;

void setUp(void)
{
    record.change_count = record.sight_count = 0;
}

void tearDown(void)
{
}

/* How far from where it began, at the most, and in the end, a robot gets whose wheels are `gain`
 * times as fast as they should be. */
struct excursion {
    double most, end, turned;
};

static struct excursion drive(const struct drive_wheels *wheels, double left_gain,
                              double right_gain)
{
    struct excursion excursion = {0};
    double x = 0, y = 0, theta = 0;
    const struct drive_segment *now;

    for (int ms = 0; (now = drive_at(&plan, ms / 1000.0)) != NULL; ms++) {
        double left = left_gain * now->left * wheels->wheel_max / PWM_STEPS;
        double right = right_gain * now->right * wheels->wheel_max / PWM_STEPS;

        theta += (right - left) / wheels->track * 0.001;
        x += (left + right) / 2 * cos(theta) * 0.001;
        y += (left + right) / 2 * sin(theta) * 0.001;
        excursion.most = fmax(excursion.most, hypot(x, y));
    }
    excursion.end = hypot(x, y);
    excursion.turned = fabs(theta);
    return excursion;
}

static void assert_within_its_room(const struct drive_wheels *wheels)
{
    static const double gains[] = {0.75, 1, 1.25};

    for (size_t i = 0; i < 9; i++) {
        double left = gains[i / 3], right = gains[i % 3];
        struct excursion excursion = drive(wheels, left, right);

        TEST_ASSERT_TRUE(excursion.most < DRIVE_ROOM);
        TEST_ASSERT_DOUBLE_WITHIN(0.01, 0, excursion.end);
        TEST_ASSERT_DOUBLE_WITHIN(0.05, 0, excursion.turned);
    }
}

/* Slow wheels and fast ones, narrow robots and wide ones. */
static void test_drives_stay_in_their_room_and_end_where_they_began(void)
{
    static const struct drive_wheels all[] = {
        {0.08, 0.6}, {0.08, 0.2}, {0.05, 1.5}, {0.2, 1}, {0.1, 4.5},
    };

    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        drive_plan_measure(&plan, &all[i]);
        assert_within_its_room(&all[i]);
        drive_plan_trial(&plan, &all[i], all[i].track);
        assert_within_its_room(&all[i]);
    }
}

static void test_lengths(void)
{
    drive_plan_measure(&plan, &small);
    TEST_ASSERT_TRUE(drive_seconds(&plan) > 12 && drive_seconds(&plan) < 20);
    TEST_ASSERT_FALSE(plan.corrected);
    drive_plan_trial(&plan, &small, small.track);
    TEST_ASSERT_TRUE(drive_seconds(&plan) < 8);
    TEST_ASSERT_TRUE(plan.corrected);
}

/* Each wheel at three speeds both ways, and alone. */
static void test_every_wheel_is_measured(void)
{
    int speeds[WHEELS] = {0}, alone[WHEELS] = {0};
    int16_t known[WHEELS][DRIVE_SEGMENTS_MAX] = {{0}};

    drive_plan_measure(&plan, &small);
    for (size_t i = 0; i < plan.count; i++) {
        const int16_t steps[WHEELS] = {plan.segment[i].left, plan.segment[i].right};

        for (int wheel = 0; wheel < WHEELS; wheel++) {
            bool is_new = steps[wheel] != 0;

            for (int k = 0; k < speeds[wheel]; k++)
                is_new &= known[wheel][k] != steps[wheel];
            if (is_new)
                known[wheel][speeds[wheel]++] = steps[wheel];
            alone[wheel] += steps[wheel] != 0 && steps[1 - wheel] == 0;
        }
    }
    for (int wheel = 0; wheel < WHEELS; wheel++) {
        TEST_ASSERT_TRUE(speeds[wheel] >= 6);
        TEST_ASSERT_EQUAL(2, alone[wheel]);
    }
}

static void test_segments_follow_one_another(void)
{
    plan = (struct drive_plan){.count = 2, .segment = {{0.5, 1, 2}, {0.25, 3, 4}}};
    TEST_ASSERT_EQUAL(1, drive_at(&plan, 0)->left);
    TEST_ASSERT_EQUAL(1, drive_at(&plan, 0.49)->left);
    TEST_ASSERT_EQUAL(3, drive_at(&plan, 0.5)->left);
    TEST_ASSERT_EQUAL(4, drive_at(&plan, 0.74)->right);
    TEST_ASSERT_NULL(drive_at(&plan, 0.75));
}

static void test_only_changes_are_recorded(void)
{
    drive_record_sent(&record, 0, 0, 0);
    drive_record_sent(&record, 0.02, 0, 0);
    drive_record_sent(&record, 0.04, 100, 0);
    drive_record_sent(&record, 0.06, 100, 0);
    drive_record_sent(&record, 0.08, 100, 50);
    drive_record_sent(&record, 0.1, 0, 50);
    TEST_ASSERT_EQUAL(4, record.change_count);
    TEST_ASSERT_EQUAL_DOUBLE(0.04, record.change[1].at);
    TEST_ASSERT_EQUAL_DOUBLE(0.08, record.change[2].at);
    TEST_ASSERT_EQUAL_DOUBLE(0.1, record.change[3].at);
    for (int i = 0; i < 1000; i++)
        drive_record_sent(&record, i, (int16_t)(i % 2), 0);
    TEST_ASSERT_EQUAL(DRIVE_SEGMENTS_MAX + 1, record.change_count);
}

static void test_headings_go_on_beyond_a_turn(void)
{
    for (int i = 0; i < 100; i++)
        drive_record_seen(&record, i * 0.02, 0, 0, remainder(i * 0.3, 2 * M_PI));
    TEST_ASSERT_EQUAL(100, record.sight_count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 99 * 0.3, record.sight[99].theta);
}

static void test_sights_that_are_too_near_are_left_out(void)
{
    for (int i = 0; i < 300; i++)
        drive_record_seen(&record, i / 300.0, 0, 0, 0);
    TEST_ASSERT_EQUAL(50, record.sight_count);
    for (int i = 0; i < 3000; i++)
        drive_record_seen(&record, 1 + i * 0.02, 0, 0, 0);
    TEST_ASSERT_EQUAL(DRIVE_SIGHTS_MAX, record.sight_count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_drives_stay_in_their_room_and_end_where_they_began);
    RUN_TEST(test_lengths);
    RUN_TEST(test_every_wheel_is_measured);
    RUN_TEST(test_segments_follow_one_another);
    RUN_TEST(test_only_changes_are_recorded);
    RUN_TEST(test_headings_go_on_beyond_a_turn);
    RUN_TEST(test_sights_that_are_too_near_are_left_out);
    return UNITY_END();
}
