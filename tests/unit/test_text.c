#include "text.h"

#include <string.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_good(size_t good, const char *bytes)
{
    TEST_ASSERT_EQUAL_UINT(good, text_length(bytes, strlen(bytes)));
}

static void test_plain_text(void)
{
    assert_good(0, "");
    assert_good(11, "a: 1\r\n\tb: 2");
    TEST_ASSERT_EQUAL_UINT(1, text_length("a\0b", 3));
    assert_good(1, "a\x1B[m");
    assert_good(1, "a\x7F");
}

static void test_utf8(void)
{
    assert_good(2, "\xC3\xA9");
    assert_good(3, "\xE2\x82\xAC");
    assert_good(4, "\xF0\x9F\xA4\x96");
    assert_good(0, "\x80");
    assert_good(0, "\xC3");
    assert_good(0, "\xC3(");
    assert_good(0, "\xC0\x80");         /* two bytes for a NUL */
    assert_good(0, "\xE0\x80\xAF");     /* three for a slash */
    assert_good(0, "\xED\xA0\x80");     /* half a surrogate pair */
    assert_good(0, "\xF4\x90\x80\x80"); /* beyond Unicode */
}

static void test_distance(void)
{
    TEST_ASSERT_EQUAL_UINT(0, text_distance("loss", "loss"));
    TEST_ASSERT_EQUAL_UINT(1, text_distance("los", "loss"));
    TEST_ASSERT_EQUAL_UINT(1, text_distance("lsos", "loss"));
    TEST_ASSERT_EQUAL_UINT(3, text_distance("kitten", "sitting"));
    TEST_ASSERT_EQUAL_UINT(4, text_distance("", "loss"));
}

static void test_nearest(void)
{
    static const char *const words[] = {"range", "loss", "delay", NULL};

    TEST_ASSERT_EQUAL_STRING("loss", text_nearest("losses", words));
    TEST_ASSERT_EQUAL_STRING("delay", text_nearest("dealy", words));
    TEST_ASSERT_NULL(text_nearest("x", words));
    TEST_ASSERT_NULL(text_nearest("bandwidth", words));
    TEST_ASSERT_NULL(text_nearest("a word of more than thirty-one letters", words));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_plain_text);
    RUN_TEST(test_utf8);
    RUN_TEST(test_distance);
    RUN_TEST(test_nearest);
    return UNITY_END();
}
