#include "id.h"

#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static struct id_link says(uint16_t wanted, uint16_t has)
{
    return (struct id_link){.wanted = wanted, .answered = true, .has = has};
}

static void test_those_without_get_the_sites_and_those_with_it_keep_it(void)
{
    struct id_link links[] = {says(1, 0), says(2, 2), {.wanted = 3}};

    id_judge(links, 3, 0, false);
    TEST_ASSERT_EQUAL_INT(ID_GETS, links[0].verdict);
    TEST_ASSERT_EQUAL_UINT16(1, links[0].gets);
    TEST_ASSERT_EQUAL_INT(ID_KEEPS, links[1].verdict);
    TEST_ASSERT_EQUAL_INT(ID_SILENT, links[2].verdict);
}

static void test_one_with_another_id_is_left_alone_unless_forced(void)
{
    struct id_link links[] = {says(1, 7)};

    id_judge(links, 1, 0, false);
    TEST_ASSERT_EQUAL_INT(ID_OTHER, links[0].verdict);
    TEST_ASSERT_EQUAL_UINT(0, links[0].twin);
    id_judge(links, 1, 0, true);
    TEST_ASSERT_EQUAL_INT(ID_GETS, links[0].verdict);
    TEST_ASSERT_EQUAL_UINT16(1, links[0].gets);
}

static void test_two_that_say_the_same_id_are_found(void)
{
    struct id_link links[] = {says(1, 1), says(2, 1)};

    id_judge(links, 2, 0, false);
    TEST_ASSERT_EQUAL_INT(ID_KEEPS, links[0].verdict);
    TEST_ASSERT_EQUAL_INT(ID_OTHER, links[1].verdict);
    TEST_ASSERT_EQUAL_UINT(0, links[1].twin);
}

static void test_none_gets_an_id_that_another_one_has(void)
{
    struct id_link links[] = {says(1, 0), says(2, 1)};

    id_judge(links, 2, 0, false);
    TEST_ASSERT_EQUAL_INT(ID_TAKEN, links[0].verdict);
    TEST_ASSERT_EQUAL_UINT(1, links[0].twin);
    id_judge(links, 2, 0, true);
    TEST_ASSERT_EQUAL_INT(ID_GETS, links[0].verdict);
    TEST_ASSERT_EQUAL_INT(ID_GETS, links[1].verdict);
}

static void test_two_without_an_id_are_no_twins(void)
{
    struct id_link links[] = {says(1, 0), says(2, 0)};

    id_judge(links, 2, 0, false);
    TEST_ASSERT_EQUAL_INT(ID_GETS, links[0].verdict);
    TEST_ASSERT_EQUAL_INT(ID_GETS, links[1].verdict);
}

static void test_a_row_leaves_out_what_is_in_use(void)
{
    struct id_link links[] = {says(0, 0), says(0, 6), says(0, 0), {.wanted = 0}, says(0, 0)};

    id_judge(links, 5, 5, false);
    TEST_ASSERT_EQUAL_UINT16(5, links[0].gets);
    TEST_ASSERT_EQUAL_INT(ID_KEEPS, links[1].verdict);
    TEST_ASSERT_EQUAL_UINT16(7, links[2].gets);
    TEST_ASSERT_EQUAL_INT(ID_SILENT, links[3].verdict);
    TEST_ASSERT_EQUAL_UINT16(8, links[4].gets);
}

static void test_twins_in_a_row_are_both_left_alone(void)
{
    struct id_link links[] = {says(0, 6), says(0, 6), says(0, 0)};

    id_judge(links, 3, 6, false);
    TEST_ASSERT_EQUAL_INT(ID_TWICE, links[0].verdict);
    TEST_ASSERT_EQUAL_UINT(1, links[0].twin);
    TEST_ASSERT_EQUAL_INT(ID_TWICE, links[1].verdict);
    TEST_ASSERT_EQUAL_UINT(0, links[1].twin);
    TEST_ASSERT_EQUAL_UINT16(7, links[2].gets);
}

static void test_a_row_that_is_forced_is_one_without_gaps(void)
{
    struct id_link links[] = {says(0, 6), says(0, 6), says(0, 0)};

    id_judge(links, 3, 6, true);
    for (uint16_t i = 0; i < 3; i++) {
        TEST_ASSERT_EQUAL_INT(ID_GETS, links[i].verdict);
        TEST_ASSERT_EQUAL_UINT16(6 + i, links[i].gets);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_those_without_get_the_sites_and_those_with_it_keep_it);
    RUN_TEST(test_one_with_another_id_is_left_alone_unless_forced);
    RUN_TEST(test_two_that_say_the_same_id_are_found);
    RUN_TEST(test_none_gets_an_id_that_another_one_has);
    RUN_TEST(test_two_without_an_id_are_no_twins);
    RUN_TEST(test_a_row_leaves_out_what_is_in_use);
    RUN_TEST(test_twins_in_a_row_are_both_left_alone);
    RUN_TEST(test_a_row_that_is_forced_is_one_without_gaps);
    return UNITY_END();
}
