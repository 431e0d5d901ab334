#include "assignment.h"

#include "random.h"

#include <math.h>
#include <unity.h>

#define SIDE_MAX 7

static double costs[SIDE_MAX][SIDE_MAX];
static uint32_t chosen[SIDE_MAX];
static uint32_t state;

void setUp(void)
{
    state = 1;
}

void tearDown(void)
{
}

static double cost_of(const void *context, size_t row, size_t column)
{
    (void)context;
    return costs[row][column];
}

/* What the solver's choice costs, every row having a column of its own. */
static double solve(size_t rows, size_t columns)
{
    struct assignment_node nodes[SIDE_MAX + 1];
    unsigned taken = 0;
    double total = 0;

    assignment_solve(rows, columns, cost_of, NULL, nodes, chosen);
    for (size_t row = 0; row < rows; row++) {
        TEST_ASSERT_TRUE(chosen[row] < columns);
        TEST_ASSERT_EQUAL_UINT(0, taken >> chosen[row] & 1);
        taken |= 1u << chosen[row];
        total += costs[row][chosen[row]];
    }
    return total;
}

/* The least cost of all ways to give `row` and those after it a free column. */
static double least(size_t row, size_t rows, size_t columns, unsigned taken)
{
    double best = INFINITY;

    if (row == rows)
        return 0;
    for (size_t column = 0; column < columns; column++)
        if (!(taken >> column & 1))
            best = fmin(best,
                        costs[row][column] + least(row + 1, rows, columns, taken | 1u << column));
    return best;
}

static void fill(double (*draw)(void))
{
    for (size_t row = 0; row < SIDE_MAX; row++)
        for (size_t column = 0; column < SIDE_MAX; column++)
            costs[row][column] = draw();
}

static double draw_any(void)
{
    return random_next(&state) / (double)UINT32_MAX * 20 - 10;
}

/* Many equal ones. */
static double draw_few(void)
{
    return random_next(&state) % 4;
}

static void assert_least(size_t rows, size_t columns)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, least(0, rows, columns, 0), solve(rows, columns));
}

static void test_no_permutation_is_cheaper(void)
{
    for (unsigned i = 0; i < 200; i++) {
        for (size_t side = 1; side <= 6; side++) {
            fill(draw_any);
            assert_least(side, side);
        }
    }
    for (unsigned i = 0; i < 20; i++) {
        fill(draw_any);
        assert_least(SIDE_MAX, SIDE_MAX);
    }
}

static void test_more_columns_than_rows(void)
{
    for (unsigned i = 0; i < 500; i++) {
        size_t columns = 2 + random_next(&state) % (SIDE_MAX - 1);

        fill(draw_any);
        assert_least(1 + random_next(&state) % (columns - 1), columns);
    }
}

static void test_equal_prices_do_no_harm(void)
{
    for (unsigned i = 0; i < 500; i++) {
        fill(draw_few);
        assert_least(1 + random_next(&state) % 6, 6);
    }
}

static void test_the_first_come_may_have_to_give_way(void)
{
    costs[0][0] = 1, costs[0][1] = 2;
    costs[1][0] = 1, costs[1][1] = 9;
    solve(2, 2);
    TEST_ASSERT_EQUAL_UINT32(1, chosen[0]);
    TEST_ASSERT_EQUAL_UINT32(0, chosen[1]);
}

static void test_nobody_needs_nothing(void)
{
    TEST_ASSERT_TRUE(solve(0, 0) == 0);
    TEST_ASSERT_TRUE(solve(0, 3) == 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_permutation_is_cheaper);
    RUN_TEST(test_more_columns_than_rows);
    RUN_TEST(test_equal_prices_do_no_harm);
    RUN_TEST(test_the_first_come_may_have_to_give_way);
    RUN_TEST(test_nobody_needs_nothing);
    return UNITY_END();
}
