#include "formation.h"

#include "random.h"

#include <math.h>
#include <unity.h>

#define RAD(angle) ((angle)*2 * M_PI / ANGLE_TURN)

static uint32_t state;

void setUp(void)
{
    state = 1;
}

void tearDown(void)
{
}

static uint32_t draw(void)
{
    return random_next(&state);
}

static void test_the_scale_is_the_smallest_that_fits(void)
{
    TEST_ASSERT_EQUAL_UINT8(0, formation_scale(0));
    TEST_ASSERT_EQUAL_UINT8(0, formation_scale(FORMATION_REACH - 1)); /* 4.09 m */
    TEST_ASSERT_EQUAL_UINT8(1, formation_scale(FORMATION_REACH));
    TEST_ASSERT_EQUAL_UINT8(1, formation_scale(2 * FORMATION_REACH - 1));
    TEST_ASSERT_EQUAL_UINT8(2, formation_scale(2 * FORMATION_REACH));
    TEST_ASSERT_EQUAL_UINT8(FORMATION_SCALE_MAX, formation_scale(8388607)); /* 2,097 m */
}

static void test_vertices_lie_within_a_unit_of_where_they_should(void)
{
    for (int i = 0; i < 1000000; i++) {
        int32_t distance = (int32_t)(draw() % 8388608) >> draw() % 24;
        struct polar_vertex vertex = {draw() % 2 == 0 ? distance : -distance, (angle_t)draw()};
        uint8_t scale = formation_scale(distance);
        struct vec16 at = formation_place(vertex, scale);
        double unit = 1 << scale;
        double sine_error = distance / 32768.0 / unit;

        TEST_ASSERT_DOUBLE_WITHIN(1.01 + sine_error, vertex.distance * cos(RAD(vertex.psi)) / unit,
                                  at.x);
        TEST_ASSERT_DOUBLE_WITHIN(1.01 + sine_error, vertex.distance * sin(RAD(vertex.psi)) / unit,
                                  at.y);
    }
}

static void test_the_leaders_vertex_is_the_origin(void)
{
    struct vec16 at = formation_place((struct polar_vertex){0, 0x1234}, 3);

    TEST_ASSERT_EQUAL_INT16(0, at.x);
    TEST_ASSERT_EQUAL_INT16(0, at.y);
}

static void test_a_vertex_beyond_the_scale_saturates(void)
{
    struct vec16 at = formation_place((struct polar_vertex){8388607, 0}, 0);

    TEST_ASSERT_EQUAL_INT16(INT16_MAX, at.x);
    at = formation_place((struct polar_vertex){-8388607, 0}, 0);
    TEST_ASSERT_EQUAL_INT16(-INT16_MAX, at.x);
}

static void test_offsets_turn_with_the_leader(void)
{
    for (int i = 0; i < 1000000; i++) {
        struct vec16 goal = {(int16_t)draw() / 2, (int16_t)draw() / 2};
        uint8_t scale = draw() % (FORMATION_SCALE_MAX + 1);
        angle_t heading = (angle_t)draw();
        struct vec32 offset = formation_offset(goal, scale, sincos_of(heading));
        double c = cos(RAD(heading)), s = sin(RAD(heading)), unit = 1 << scale;

        TEST_ASSERT_DOUBLE_WITHIN(2.5 * unit, (goal.x * c - goal.y * s) * unit, offset.x);
        TEST_ASSERT_DOUBLE_WITHIN(2.5 * unit, (goal.x * s + goal.y * c) * unit, offset.y);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_scale_is_the_smallest_that_fits);
    RUN_TEST(test_vertices_lie_within_a_unit_of_where_they_should);
    RUN_TEST(test_the_leaders_vertex_is_the_origin);
    RUN_TEST(test_a_vertex_beyond_the_scale_saturates);
    RUN_TEST(test_offsets_turn_with_the_leader);
    return UNITY_END();
}
