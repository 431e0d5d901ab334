#include "decimal.h"

#include <string.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_value(double expected, const char *text)
{
    double value = 0;

    TEST_ASSERT_TRUE_MESSAGE(decimal_read(text, strlen(text), &value), text);
    TEST_ASSERT_TRUE_MESSAGE(value == expected, text);
}

static void assert_refused(const char *text)
{
    double value;

    TEST_ASSERT_FALSE_MESSAGE(decimal_read(text, strlen(text), &value), text);
}

static void test_numbers(void)
{
    assert_value(0, "0");
    assert_value(-1.5, "-1.5");
    assert_value(1.5, "+1.5");
    assert_value(0.25, ".25");
    assert_value(3, "3.");
    assert_value(-1.25e-3, "-1.25e-3");
    assert_value(1e9, "1E+9");
}

static void test_what_is_no_number(void)
{
    static const char *const wrong[] = {"",    ".",   "-",   "1,5",   "1.5 ",  " 1",
                                        "1e",  "0x1", "nan", "inf",   "1e999", "1.2.3",
                                        "--1", "1d0", "e5",  "1e5.0", "1_000"};
    char longest[80];

    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(wrong[i]);
    memset(longest, '1', sizeof longest);
    longest[64] = '\0';
    assert_refused(longest);
}

static void test_only_what_belongs_to_it_is_read(void)
{
    double value;

    TEST_ASSERT_TRUE(decimal_read("12345", 2, &value));
    TEST_ASSERT_TRUE(value == 12);
    TEST_ASSERT_FALSE(decimal_read("12345", 0, &value));
}

static void test_whole_numbers(void)
{
    int64_t value;

    TEST_ASSERT_TRUE(decimal_read_whole("-12", 3, -12, 12, &value));
    TEST_ASSERT_TRUE(value == -12);
    TEST_ASSERT_TRUE(decimal_read_whole("007", 3, 0, 7, &value));
    TEST_ASSERT_TRUE(value == 7);
    TEST_ASSERT_FALSE(decimal_read_whole("8", 1, 0, 7, &value));
    TEST_ASSERT_FALSE(decimal_read_whole("-1", 2, 0, 7, &value));
    TEST_ASSERT_FALSE(decimal_read_whole("-", 1, -7, 7, &value));
    TEST_ASSERT_FALSE(decimal_read_whole("", 0, 0, 7, &value));
    TEST_ASSERT_FALSE(decimal_read_whole("1.0", 3, 0, 7, &value));
    TEST_ASSERT_FALSE(decimal_read_whole("+1", 2, 0, 7, &value));
    TEST_ASSERT_FALSE(decimal_read_whole("9999999999999999999", 19, 0, INT64_MAX, &value));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_numbers);
    RUN_TEST(test_what_is_no_number);
    RUN_TEST(test_only_what_belongs_to_it_is_read);
    RUN_TEST(test_whole_numbers);
    return UNITY_END();
}
