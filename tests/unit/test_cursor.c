#include "cursor.h"

#include <math.h>
#include <string.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static const uint8_t eight[] = {1, 2, 3, 4, 5, 6, 7, 0x88};

static void test_numbers_in_both_orders(void)
{
    struct cursor cursor = cursor_over(eight, sizeof eight);

    TEST_ASSERT_EQUAL_HEX16(0x0201, cursor_u16_le(&cursor));
    TEST_ASSERT_EQUAL_HEX16(0x0304, cursor_u16_be(&cursor));
    TEST_ASSERT_EQUAL_HEX8(5, cursor_u8(&cursor));
    TEST_ASSERT_EQUAL_UINT(3, cursor.left);
    cursor = cursor_over(eight, sizeof eight);
    TEST_ASSERT_EQUAL_HEX32(0x04030201, cursor_u32_le(&cursor));
    TEST_ASSERT_EQUAL_HEX32(0x05060788, cursor_u32_be(&cursor));
    cursor = cursor_over(eight, sizeof eight);
    TEST_ASSERT_TRUE(cursor_u64_le(&cursor) == UINT64_C(0x8807060504030201));
    cursor = cursor_over(eight, sizeof eight);
    TEST_ASSERT_TRUE(cursor_u64_be(&cursor) == UINT64_C(0x0102030405060788));
    TEST_ASSERT_TRUE(cursor_good(&cursor));
}

static void test_signs_and_fractions(void)
{
    struct cursor cursor = cursor_over("\xFE\xFF\xFF\xFE\xFD\xFF\xFF\xFF\xFF\xFF\xFF\xFD", 12);

    TEST_ASSERT_EQUAL_INT(-2, cursor_i16_le(&cursor));
    TEST_ASSERT_EQUAL_INT(-2, cursor_i16_be(&cursor));
    TEST_ASSERT_EQUAL_INT(-3, cursor_i32_le(&cursor));
    TEST_ASSERT_EQUAL_INT(-3, cursor_i32_be(&cursor));
    cursor = cursor_over("\0\0\xC0\x3F\xBF\xC0\0\0", 8);
    TEST_ASSERT_TRUE(cursor_f32_le(&cursor) == 1.5f);
    TEST_ASSERT_TRUE(cursor_f32_be(&cursor) == -1.5f);
    cursor = cursor_over("\0\0\0\0\0\0\xF8\x3F\xBF\xF8\0\0\0\0\0\0", 16);
    TEST_ASSERT_TRUE(cursor_f64_le(&cursor) == 1.5);
    TEST_ASSERT_TRUE(cursor_f64_be(&cursor) == -1.5);
    TEST_ASSERT_TRUE(cursor_good(&cursor));
}

static void test_nothing_comes_after_the_end(void)
{
    struct cursor cursor = cursor_over(eight, 5);

    cursor_u32_le(&cursor);
    TEST_ASSERT_TRUE(cursor_good(&cursor));
    TEST_ASSERT_EQUAL_UINT(0, cursor_u16_le(&cursor));
    TEST_ASSERT_FALSE(cursor_good(&cursor));
    TEST_ASSERT_EQUAL_UINT(0, cursor_u8(&cursor)); /* though one byte was left */
    TEST_ASSERT_FALSE(cursor_good(&cursor));
}

static void test_counts_are_weighed_before_they_are_believed(void)
{
    struct cursor cursor = cursor_over(eight, sizeof eight);

    TEST_ASSERT_TRUE(cursor_holds(&cursor, 4, 2));
    TEST_ASSERT_FALSE(cursor_holds(&cursor, 5, 2));
    cursor = cursor_over(eight, sizeof eight);
    TEST_ASSERT_FALSE(cursor_holds(&cursor, (uint64_t)-1, 16)); /* whose product is small again */
    cursor = cursor_over(eight, sizeof eight);
    cursor_skip_all(&cursor, 2, 3);
    TEST_ASSERT_EQUAL_HEX8(7, cursor_u8(&cursor));
    cursor_skip_all(&cursor, 2, 1);
    TEST_ASSERT_FALSE(cursor_good(&cursor));
}

static void test_parts(void)
{
    struct cursor cursor = cursor_over(eight, sizeof eight);
    struct cursor part = cursor_part(&cursor, 3);

    TEST_ASSERT_EQUAL_UINT(3, part.left);
    cursor_skip(&part, 3);
    TEST_ASSERT_TRUE(cursor_good(&part));
    cursor_u8(&part);
    TEST_ASSERT_FALSE(cursor_good(&part));
    TEST_ASSERT_EQUAL_HEX8(4, cursor_u8(&cursor));
    part = cursor_part(&cursor, 5);
    TEST_ASSERT_FALSE(cursor_good(&part));
    TEST_ASSERT_FALSE(cursor_good(&cursor));
}

static void test_strings(void)
{
    char text[4];
    struct cursor cursor = cursor_over("abc\0long\0abcd\0end", 17);

    cursor_string(&cursor, text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("abc", text);
    cursor_string_cut(&cursor, text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("lon", text);
    TEST_ASSERT_TRUE(cursor_good(&cursor));
    struct cursor strict = cursor;
    cursor_string(&strict, text, sizeof text);
    TEST_ASSERT_FALSE(cursor_good(&strict));
    TEST_ASSERT_EQUAL_STRING("", text);
    cursor_string_cut(&cursor, NULL, 0);
    TEST_ASSERT_TRUE(cursor_good(&cursor));
    cursor_string_cut(&cursor, text, sizeof text); /* no NUL */
    TEST_ASSERT_FALSE(cursor_good(&cursor));
    TEST_ASSERT_EQUAL_STRING("", text);
}

static void test_text_of_fixed_width(void)
{
    char text[4];
    struct cursor cursor = cursor_over("ab\0xyzuvw", 9);

    cursor_text(&cursor, 5, text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("ab", text);
    cursor_text(&cursor, 4, text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("zuv", text);
    TEST_ASSERT_TRUE(cursor_good(&cursor));
    cursor_text(&cursor, 1, text, sizeof text);
    TEST_ASSERT_FALSE(cursor_good(&cursor));
}

static void test_control_characters_do_not_come_through(void)
{
    char text[16];
    struct cursor cursor = cursor_over("a\x1B[m\n\x7F\xC3\xA9", 9);

    cursor_string(&cursor, text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("a?[m??\xC3\xA9", text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_numbers_in_both_orders);
    RUN_TEST(test_signs_and_fractions);
    RUN_TEST(test_nothing_comes_after_the_end);
    RUN_TEST(test_counts_are_weighed_before_they_are_believed);
    RUN_TEST(test_parts);
    RUN_TEST(test_strings);
    RUN_TEST(test_text_of_fixed_width);
    RUN_TEST(test_control_characters_do_not_come_through);
    return UNITY_END();
}
