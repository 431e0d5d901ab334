#include "history.h"

#include "message.h"

#include <string.h>
#include <unity.h>

#define ROBOTS 4

static struct history history;
static struct glimpse robots[ROBOTS];

/* Robot 0 leads, the others hold vertices 2 to 4. */
void setUp(void)
{
    TEST_ASSERT_TRUE(history_begin(&history, ROBOTS, 1));
    TEST_ASSERT_NOT_NULL(history_add_shape(&history, "G1", 0));
    TEST_ASSERT_NOT_NULL(history_add_shape(&history, "G2", 3));
    for (size_t i = 0; i < ROBOTS; i++)
        robots[i] = (struct glimpse){.role = i == 0 ? ROLE_LEADER : ROLE_FOLLOWER,
                                     .vertex = (uint16_t)(i + 1),
                                     .alive = true,
                                     .error = (float)i};
}

void tearDown(void)
{
    history_free(&history);
}

static void add(size_t ticks, size_t formation)
{
    for (size_t i = 0; i < ticks; i++) {
        struct glimpse *glimpses = history_add(&history);

        TEST_ASSERT_NOT_NULL(glimpses);
        memcpy(glimpses, robots, sizeof robots);
        history.moments[history.ticks - 1] = (struct moment){
            .time_ms = (int32_t)(20 * (history.ticks - 1)), .formation = (uint8_t)formation};
    }
}

static void a_vertex_counts_once_and_the_leaders_not(void)
{
    add(1, 0);
    TEST_ASSERT_EQUAL_UINT(3, history_held(&history, 0));
    robots[3].vertex = 2;
    add(1, 0);
    TEST_ASSERT_EQUAL_UINT(2, history_held(&history, 1));
    robots[1].alive = false;
    add(1, 0);
    TEST_ASSERT_EQUAL_UINT(2, history_held(&history, 2));
    robots[2].vertex = 0;
    add(1, 0);
    TEST_ASSERT_EQUAL_UINT(1, history_held(&history, 3));
}

static void the_mean_error_is_that_of_the_live(void)
{
    add(25, 0);
    robots[3].alive = false;
    robots[3].error = 0;
    add(25, 0);
    TEST_ASSERT_TRUE(history_mean_error(&history, 0) == 1.5);
    TEST_ASSERT_TRUE(history_mean_error(&history, 49) == 1);
    TEST_ASSERT_TRUE(history_peak_error(&history, 0) == 1.5);
    TEST_ASSERT_TRUE(history_peak_error(&history, 25) == 1);
    TEST_ASSERT_TRUE(history_error_integral(&history, 0) == 1.25);
    TEST_ASSERT_TRUE(history_error_integral(&history, 25) == 0.5);
}

static void a_leader_is_lost_and_replaced(void)
{
    add(10, 0);
    TEST_ASSERT_EQUAL_UINT(NEVER, history_death(&history));
    TEST_ASSERT_EQUAL_UINT(NEVER, history_takeover(&history, 0));
    robots[0].alive = false;
    add(5, 0);
    TEST_ASSERT_EQUAL_UINT(NEVER, history_leader(&history, 12));
    robots[1].role = ROLE_LEADER;
    add(5, 0);
    TEST_ASSERT_EQUAL_UINT(0, history_leader(&history, 9));
    TEST_ASSERT_EQUAL_UINT(10, history_death(&history));
    TEST_ASSERT_EQUAL_UINT(15, history_takeover(&history, 0));
    TEST_ASSERT_EQUAL_UINT(1, history_leader(&history, 15));
}

static void a_formation_changes(void)
{
    add(10, 0);
    TEST_ASSERT_EQUAL_UINT(NEVER, history_reformation(&history));
    add(10, 1);
    TEST_ASSERT_EQUAL_UINT(10, history_reformation(&history));
}

static void shapes_have_numbers_in_a_byte(void)
{
    add(1, 1);
    TEST_ASSERT_EQUAL_STRING("G2", history_shape_at(&history, 0)->name);
    TEST_ASSERT_EQUAL_UINT(3, history_shape_at(&history, 0)->count);
    while (history.shapes < SHAPES_MAX)
        TEST_ASSERT_NOT_NULL(history_add_shape(&history, "more", 1));
    TEST_ASSERT_NULL(history_add_shape(&history, "too many", 1));
}

static void a_time_has_the_tick_before_it(void)
{
    add(51, 0);
    history.moments[50].time_ms = 2000; /* some were missed */
    TEST_ASSERT_EQUAL_UINT(50, history_tick(&history, 5));
    TEST_ASSERT_EQUAL_UINT(49, history_tick(&history, 1.99));
    TEST_ASSERT_EQUAL_UINT(0, history_tick(&history, -1));
    TEST_ASSERT_EQUAL_UINT(25, history_tick(&history, 0.5));
    TEST_ASSERT_EQUAL_UINT(25, history_tick(&history, 0.519));
    TEST_ASSERT_TRUE(history_time(&history, 50) == 2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_vertex_counts_once_and_the_leaders_not);
    RUN_TEST(the_mean_error_is_that_of_the_live);
    RUN_TEST(a_leader_is_lost_and_replaced);
    RUN_TEST(a_formation_changes);
    RUN_TEST(shapes_have_numbers_in_a_byte);
    RUN_TEST(a_time_has_the_tick_before_it);
    return UNITY_END();
}
