#include "mission.h"

#include <string.h>
#include <unity.h>

static struct mission mission;

static const struct message begin = {
    .type = MESSAGE_MISSION,
    .mission = {.mission = 3, .v_max = 1, .omega_max = 1, .track = 1, .wheel_max = 1}};

void setUp(void)
{
    memset(&mission, 0, sizeof mission);
}

void tearDown(void)
{
}

static struct message vertices(uint8_t sequence, uint8_t formation, uint16_t total, uint16_t first,
                               uint8_t count)
{
    struct message m = {.type = MESSAGE_VERTICES,
                        .vertices = {.sequence = sequence,
                                     .formation = formation,
                                     .total = total,
                                     .first = first,
                                     .count = count}};

    for (uint8_t i = 0; i < count; i++)
        m.vertices.vertex[i].distance = first + i == 2 ? 0 : 4000 + first + i;
    return m;
}

static struct message knot(uint8_t sequence, int32_t time)
{
    return (struct message){.type = MESSAGE_KNOT,
                            .knot = {sequence, {.time = time, .pose = {{time, 0}, 0}, .v = 4000}}};
}

static enum mission_change take(struct message m)
{
    return mission_take(&mission, &m);
}

static void test_nothing_is_taken_before_the_mission(void)
{
    TEST_ASSERT_EQUAL(MISSION_SAME, take(knot(0, 0)));
    TEST_ASSERT_EQUAL(0, mission.knots);
}

static void test_messages_are_taken_in_order_only(void)
{
    TEST_ASSERT_EQUAL(MISSION_BEGUN, take(begin));
    TEST_ASSERT_EQUAL(1, mission.expected);
    TEST_ASSERT_EQUAL(MISSION_TOLD, take(knot(2, 0)));
    TEST_ASSERT_EQUAL(0, mission.knots);
    TEST_ASSERT_EQUAL(1, mission.expected);
    TEST_ASSERT_EQUAL(MISSION_TOLD, take(knot(1, 0)));
    TEST_ASSERT_EQUAL(1, mission.knots);
    TEST_ASSERT_EQUAL(2, mission.expected);
    TEST_ASSERT_EQUAL(MISSION_TOLD, take(knot(1, 0)));
    TEST_ASSERT_EQUAL(1, mission.knots);
}

static void test_the_same_mission_sent_again_changes_nothing(void)
{
    take(begin);
    take(knot(1, 0));
    TEST_ASSERT_EQUAL(MISSION_TOLD, take(begin));
    TEST_ASSERT_EQUAL(2, mission.expected);
}

static void test_another_mission_voids_the_old_one(void)
{
    struct message other = begin;

    take(begin);
    take(knot(1, 0));
    other.mission.mission = 4;
    TEST_ASSERT_EQUAL(MISSION_BEGUN, take(other));
    TEST_ASSERT_EQUAL(0, mission.knots);
    TEST_ASSERT_EQUAL(1, mission.expected);
}

static void test_a_formation_is_in_force_when_whole(void)
{
    take(begin);
    take(vertices(1, 1, 10, 0, 8));
    TEST_ASSERT_EQUAL(0, mission.formation.number);
    take(vertices(2, 1, 10, 8, 2));
    TEST_ASSERT_EQUAL(1, mission.formation.number);
    TEST_ASSERT_EQUAL(10, mission.formation.total);
    TEST_ASSERT_EQUAL(3, mission.formation.leader);
    TEST_ASSERT_EQUAL(4009, mission.formation.vertex[9].x);

    take(vertices(3, 2, 4, 0, 4));
    TEST_ASSERT_EQUAL(2, mission.formation.number);
    TEST_ASSERT_EQUAL(4, mission.formation.total);
}

static void test_a_formation_too_large_is_refused(void)
{
    take(begin);
    take(vertices(1, 1, VERTICES_MAX + 1, 0, 8));
    TEST_ASSERT_TRUE(mission.refused);
    TEST_ASSERT_EQUAL(0, mission.formation.number);
}

static void test_knots_that_do_not_rise_by_a_second_at_most_are_refused(void)
{
    static const int32_t wrong[] = {1000, 999, 1000 + KNOT_SPACING_MAX_MS + 1};

    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        memset(&mission, 0, sizeof mission);
        take(begin);
        take(knot(1, 1000));
        take(knot(2, wrong[i]));
        TEST_ASSERT_TRUE(mission.refused);
    }
}

static void test_the_reference_by_time(void)
{
    struct reference r;

    take(begin);
    TEST_ASSERT_FALSE(mission_reference(&mission, 0, &r));
    take(knot(1, 1000));
    take(knot(2, 2000));
    TEST_ASSERT_TRUE(mission_reference(&mission, -500, &r));
    TEST_ASSERT_EQUAL_INT32(1000, r.pose.at.x);
    TEST_ASSERT_EQUAL_INT16(0, r.v);
    TEST_ASSERT_TRUE(mission_reference(&mission, 1500, &r));
    TEST_ASSERT_INT32_WITHIN(1, 1000 + 2000, r.pose.at.x);
    TEST_ASSERT_TRUE(mission_reference(&mission, 2250, &r));
    TEST_ASSERT_INT32_WITHIN(1, 2000 + 1000, r.pose.at.x);
    TEST_ASSERT_TRUE(mission_reference(&mission, 99000, &r));
    TEST_ASSERT_INT32_WITHIN(1, 2000 + 4000, r.pose.at.x);
    TEST_ASSERT_EQUAL_INT16(0, r.v);
}

static void test_only_the_newest_knots_are_kept(void)
{
    struct reference r;
    uint8_t sequence = 1;

    take(begin);
    for (int32_t i = 0; i < 1000; i++)
        take(knot(sequence++, i * 500));
    TEST_ASSERT_FALSE(mission.refused);
    TEST_ASSERT_TRUE(mission_reference(&mission, 0, &r));
    TEST_ASSERT_EQUAL_INT32((1000 - KNOTS_MAX) * 500, r.pose.at.x);
    TEST_ASSERT_TRUE(mission_reference(&mission, 999 * 500, &r));
    TEST_ASSERT_EQUAL_INT32(999 * 500, r.pose.at.x);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_is_taken_before_the_mission);
    RUN_TEST(test_messages_are_taken_in_order_only);
    RUN_TEST(test_the_same_mission_sent_again_changes_nothing);
    RUN_TEST(test_another_mission_voids_the_old_one);
    RUN_TEST(test_a_formation_is_in_force_when_whole);
    RUN_TEST(test_a_formation_too_large_is_refused);
    RUN_TEST(test_knots_that_do_not_rise_by_a_second_at_most_are_refused);
    RUN_TEST(test_the_reference_by_time);
    RUN_TEST(test_only_the_newest_knots_are_kept);
    return UNITY_END();
}
