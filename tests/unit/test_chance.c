#include "chance.h"

#include <unity.h>

void setUp(void)
{
}
void tearDown(void)
{
}

/* The generator's first two numbers from the seed 1234567, as its authors' code gives them. */
static void test_known_answers_of_splitmix64(void)
{
    uint64_t step = 0x9E3779B97F4A7C15u;

    TEST_ASSERT_EQUAL_UINT64(6457827717110365317u, chance_scramble(1234567 + step));
    TEST_ASSERT_EQUAL_UINT64(3203168211198807973u, chance_scramble(1234567 + 2 * step));
}

static void test_a_draw_depends_on_seed_kind_and_name(void)
{
    uint64_t draw = chance_draw(1, CHANCE_LOSS, 7);

    TEST_ASSERT_EQUAL_UINT64(draw, chance_draw(1, CHANCE_LOSS, 7));
    TEST_ASSERT_TRUE(draw != chance_draw(2, CHANCE_LOSS, 7));
    TEST_ASSERT_TRUE(draw != chance_draw(1, CHANCE_NOISE, 7));
    TEST_ASSERT_TRUE(draw != chance_draw(1, CHANCE_LOSS, 8));
}

static void test_units_are_even(void)
{
    unsigned tenth[10] = {0};

    for (uint64_t name = 0; name < 100000; name++) {
        double unit = chance_unit(chance_draw(3, CHANCE_JITTER, name));

        TEST_ASSERT_TRUE(unit >= 0 && unit < 1);
        tenth[(int)(unit * 10)]++;
    }
    for (int i = 0; i < 10; i++)
        TEST_ASSERT_TRUE(tenth[i] > 9600 && tenth[i] < 10400);
}

static void test_the_ends_of_the_unit(void)
{
    TEST_ASSERT_TRUE(chance_unit(0) == 0);
    TEST_ASSERT_TRUE(chance_unit(UINT64_MAX) < 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_known_answers_of_splitmix64);
    RUN_TEST(test_a_draw_depends_on_seed_kind_and_name);
    RUN_TEST(test_units_are_even);
    RUN_TEST(test_the_ends_of_the_unit);
    return UNITY_END();
}
