#include "motion.h"

#include "limits.h"
#include "random.h"

#include <math.h>
#include <unity.h>

#define RAD(angle) ((angle)*2 * M_PI / ANGLE_TURN)
#define SI(narrow) ((double)(narrow) / NARROW_PER_M)

static struct message_mission mission;
static uint32_t state;

void setUp(void)
{
    state = 1;
    mission = (struct message_mission){
        .k = GAIN_ONE,
        .k_theta = 3 * GAIN_ONE,
        .v_max = 4 * NARROW_PER_M,
        .omega_max = 10 * RATE_ONE,
    };
}

void tearDown(void)
{
}

static int32_t within(int32_t limit)
{
    return (int32_t)(random_next(&state) % (2 * (uint32_t)limit + 1)) - limit;
}

static const struct pose origin;

/* The law in double, before any limit. */
static void law(const struct motion_goal *goal, double theta, double *v, double *omega)
{
    double k = 1, k_theta = 3;
    double vx = SI(goal->velocity.x), vy = SI(goal->velocity.y);
    double ux = vx + k * SI(goal->at.x), uy = vy + k * SI(goal->at.y);

    *v = ux * cos(theta) + uy * sin(theta);
    double dx = SI(goal->acceleration.x) + k * (vx - *v * cos(theta));
    double dy = SI(goal->acceleration.y) + k * (vy - *v * sin(theta));
    *omega = (ux * dy - uy * dx) / (ux * ux + uy * uy) +
             k_theta * remainder(atan2(uy, ux) - theta, 2 * M_PI);
}

static void test_the_law_as_in_double(void)
{
    for (int i = 0; i < 200000; i++) {
        struct motion_goal goal = {
            .at = {within(6000), within(6000)},
            .velocity = {(int16_t)within(5000), (int16_t)within(5000)},
            .acceleration = {(int16_t)within(2000), (int16_t)within(2000)},
        };
        angle_t theta = (angle_t)random_next(&state);
        struct pose own = {{0, 0}, theta};
        struct motion_command got = motion_fl(&mission, &goal, &own);
        double v, omega;

        law(&goal, RAD(theta), &v, &omega);
        double ux = SI(goal.at.x + goal.velocity.x), uy = SI(goal.at.y + goal.velocity.y);
        double off = fabs(remainder(atan2(uy, ux) - RAD(theta), 2 * M_PI));
        /* Limits, a u too short to have a direction, and straight behind, where left and right
         * are equally near, have tests of their own. */
        if (hypot(ux, uy) < 0.1 || fabs(v) > 3.9 || fabs(omega) > 9.5 || off > M_PI - 0.001)
            continue;
        TEST_ASSERT_TRUE(fabs(SI(got.v) - v) < 0.0012);
        TEST_ASSERT_TRUE(fabs((double)got.omega / RATE_ONE - omega) < 0.03);
    }
}

static void test_at_the_goal_it_moves_with_it(void)
{
    struct motion_goal goal = {.velocity = {4000, 0}};
    struct motion_command got = motion_fl(&mission, &goal, &origin);

    TEST_ASSERT_INT16_WITHIN(1, 4000, got.v);
    TEST_ASSERT_INT16_WITHIN(2, 0, got.omega);
}

static void test_a_circle_is_followed_without_error(void)
{
    /* 1 m/s at 0.5 rad/s: centripetal 0.5 m/s^2. */
    struct motion_goal goal = {.velocity = {4000, 0}, .acceleration = {0, 2000}};
    struct motion_command got = motion_fl(&mission, &goal, &origin);

    TEST_ASSERT_INT16_WITHIN(1, 4000, got.v);
    TEST_ASSERT_INT16_WITHIN(2, RATE_ONE / 2, got.omega);
}

static void test_standing_on_the_goal_it_stands_still(void)
{
    struct motion_goal goal = {.at = {MOTION_HOLD - 1, 0}};

    TEST_ASSERT_EQUAL_INT16(
        0, motion_fl(&mission, &goal, &(struct pose){{0, 0}, ANGLE_QUARTER}).omega);
}

static void test_limits(void)
{
    for (int i = 0; i < 100000; i++) {
        struct motion_goal goal = {
            .at = {within(8000000), within(8000000)},
            .velocity = {(int16_t)within(INT16_MAX), (int16_t)within(INT16_MAX)},
            .acceleration = {(int16_t)within(INT16_MAX), (int16_t)within(INT16_MAX)},
        };
        struct motion_memory memory = {.last = {0, 0}};
        angle_t theta = (angle_t)random_next(&state);
        struct pose own = {{0, 0}, theta};

        for (mission.law = LAW_FL; mission.law <= LAW_PID; mission.law++) {
            struct motion_command got = motion_step(&mission, &memory, &goal, &own);

            TEST_ASSERT_TRUE(abs32(got.v) <= mission.v_max);
            TEST_ASSERT_TRUE(abs32(got.omega) <= mission.omega_max);
        }
    }
}

static void test_a_vertex_98_m_away_keeps_its_direction(void)
{
    for (int degrees = 0; degrees < 360; degrees++) {
        double direction = degrees * M_PI / 180;
        struct motion_goal goal = {.at = {(int32_t)lround(98 * NARROW_PER_M * cos(direction)),
                                          (int32_t)lround(98 * NARROW_PER_M * sin(direction))}};
        angle_t theta = (angle_t)lround(degrees / 360.0 * ANGLE_TURN);
        struct pose own = {{0, 0}, theta};
        struct motion_command got = motion_fl(&mission, &goal, &own);

        TEST_ASSERT_EQUAL_INT16(mission.v_max, got.v);
        TEST_ASSERT_INT16_WITHIN(10, 0, got.omega);
    }
}

static void test_kanayama_follows_a_circle(void)
{
    struct motion_goal goal = {.velocity = {4000, 0}, .acceleration = {0, 2000}};
    struct motion_command got = motion_kanayama(&mission, &goal, &origin);

    TEST_ASSERT_INT16_WITHIN(1, 4000, got.v);
    TEST_ASSERT_INT16_WITHIN(2, RATE_ONE / 2, got.omega);
    goal.at.y = 400; /* 0.1 m to the left: K_y e_y = 9 / 4 * 0.1 rad/s more */
    got = motion_kanayama(&mission, &goal, &origin);
    TEST_ASSERT_INT16_WITHIN(4, RATE_ONE / 2 + RATE_ONE * 225 / 1000, got.omega);
}

static void test_pid_removes_a_lasting_error(void)
{
    struct motion_memory memory = {.last = {0, 0}};
    struct motion_goal goal = {.velocity = {2000, 0}};
    double x = 0, target = 0;

    for (int i = 0; i < 60 * TICKS_PER_S; i++) {
        goal.at.x = (int32_t)lround((target - x) * NARROW_PER_M);
        x += SI(motion_pid(&mission, &memory, &goal, &origin).v) / TICKS_PER_S;
        target += 0.5 / TICKS_PER_S;
    }
    TEST_ASSERT_TRUE(fabs(target - x) < 0.01);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_law_as_in_double);
    RUN_TEST(test_at_the_goal_it_moves_with_it);
    RUN_TEST(test_a_circle_is_followed_without_error);
    RUN_TEST(test_standing_on_the_goal_it_stands_still);
    RUN_TEST(test_limits);
    RUN_TEST(test_a_vertex_98_m_away_keeps_its_direction);
    RUN_TEST(test_kanayama_follows_a_circle);
    RUN_TEST(test_pid_removes_a_lasting_error);
    return UNITY_END();
}
