#include "cdr.h"

#include <math.h>
#include <string.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_values_are_aligned_to_their_size_from_behind_the_head(void)
{
    static const uint8_t expected[] = {
        0,    1,    0,    0,                      /* head */
        0x81, 0,    0x02, 0x01,                   /* u8, gap, u16 */
        0x06, 0x05, 0x04, 0x03,                   /* u32 */
        0x07, 0,    0,    0,    0, 0, 0,    0,    /* u8, gap */
        0,    0,    0,    0,    0, 0, 0xF8, 0x3F, /* f64 */
        0xFE, 0xFF, 0xFF, 0xFF, 1,                /* i32, bool */
    };
    uint8_t bytes[64];
    struct cdr_writer cdr = cdr_begin(bytes, sizeof bytes);

    memset(bytes + 4, 0xAA, sizeof bytes - 4);
    cdr_u8(&cdr, 0x81);
    cdr_u16(&cdr, 0x0102);
    cdr_u32(&cdr, 0x03040506);
    cdr_u8(&cdr, 7);
    cdr_f64(&cdr, 1.5);
    cdr_i32(&cdr, -2);
    cdr_bool(&cdr, true);
    TEST_ASSERT_EQUAL_UINT(sizeof expected, cdr_end(&cdr));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, bytes, sizeof expected);
}

static void test_what_is_written_is_read(void)
{
    uint8_t bytes[64];
    char text[8];
    struct cdr_writer out = cdr_begin(bytes, sizeof bytes);

    cdr_u8(&out, 0x81);
    cdr_u16(&out, 0x0102);
    cdr_string(&out, "abc");
    cdr_i32(&out, -2);
    cdr_f64(&out, NAN);
    cdr_bool(&out, true);
    struct cdr_reader in = cdr_open(bytes, cdr_end(&out));
    TEST_ASSERT_EQUAL_UINT(0x81, cdr_take_u8(&in));
    TEST_ASSERT_EQUAL_UINT(0x0102, cdr_take_u16(&in));
    cdr_take_string(&in, text, sizeof text);
    TEST_ASSERT_EQUAL_STRING("abc", text);
    TEST_ASSERT_EQUAL_INT(-2, cdr_take_i32(&in));
    TEST_ASSERT_TRUE(isnan(cdr_take_f64(&in)));
    TEST_ASSERT_TRUE(cdr_take_bool(&in));
    TEST_ASSERT_FALSE(in.short_of);
    TEST_ASSERT_EQUAL_UINT(in.count, in.used);
}

static void test_a_string_has_its_length_with_its_end(void)
{
    static const uint8_t expected[] = {0, 1, 0, 0, 3, 0, 0, 0, 'a', 'b', 0, 0, 1, 0, 0, 0, 0};
    uint8_t bytes[32];
    struct cdr_writer cdr = cdr_begin(bytes, sizeof bytes);

    cdr_string(&cdr, "ab");
    cdr_string(&cdr, "");
    TEST_ASSERT_EQUAL_UINT(sizeof expected, cdr_end(&cdr));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, bytes, sizeof expected);
}

static void check_mended(const char *expected, const char *text)
{
    uint8_t bytes[64];
    struct cdr_writer cdr = cdr_begin(bytes, sizeof bytes);

    cdr_string(&cdr, text);
    TEST_ASSERT_EQUAL_STRING(expected, (char *)bytes + 8);
}

/* Markus Kuhn's stress test has the kinds of them. */
static void test_strings_are_utf_8(void)
{
    check_mended("Zürich € 𐍈 ퟿", "Zürich € 𐍈 ퟿");
    check_mended("a?b", "a\xFF"
                        "b");
    check_mended("??", "\xC0\xAF");           /* overlong */
    check_mended("???", "\xE0\x80\xAF");      /* overlong */
    check_mended("???", "\xED\xA0\x80");      /* a surrogate */
    check_mended("????", "\xF4\x90\x80\x80"); /* above U+10FFFF */
    check_mended("????", "\xF0\x8F\xBF\xBF"); /* overlong */
    check_mended("?", "\xBF");
    check_mended("??", "\xE2\x82"); /* cut off */
    check_mended("\xF4\x8F\xBF\xBF", "\xF4\x8F\xBF\xBF");
}

static void check_time(int32_t time_ms, int32_t s, uint32_t ns)
{
    uint8_t bytes[12];
    struct cdr_writer out = cdr_begin(bytes, sizeof bytes);

    cdr_time(&out, time_ms);
    struct cdr_reader in = cdr_open(bytes, cdr_end(&out));
    TEST_ASSERT_EQUAL_INT(s, cdr_take_i32(&in));
    TEST_ASSERT_EQUAL_UINT(ns, cdr_take_u32(&in));
    in = cdr_open(bytes, sizeof bytes);
    TEST_ASSERT_EQUAL_INT(time_ms, cdr_take_time(&in));
    TEST_ASSERT_FALSE(in.short_of);
}

static void test_times_before_0_too(void)
{
    check_time(0, 0, 0);
    check_time(12340, 12, 340000000);
    check_time(-500, -1, 500000000);
    check_time(-2000, -2, 0);
    check_time(INT32_MAX, 2147483, 647000000);
    check_time(INT32_MIN, -2147484, 352000000);
}

static void check_no_time(int32_t s, uint32_t ns)
{
    uint8_t bytes[12];
    struct cdr_writer out = cdr_begin(bytes, sizeof bytes);

    cdr_i32(&out, s);
    cdr_u32(&out, ns);
    struct cdr_reader in = cdr_open(bytes, sizeof bytes);
    TEST_ASSERT_EQUAL_INT(0, cdr_take_time(&in));
    TEST_ASSERT_TRUE(in.short_of);
}

static void test_times_that_are_none(void)
{
    check_no_time(0, 1000000000);
    check_no_time(2147483, 648000000);
    check_no_time(-2147484, 351000000);
}

static void test_a_message_that_does_not_fit_is_none(void)
{
    uint8_t bytes[13];

    for (size_t room = 0; room < 13; room++) {
        struct cdr_writer cdr = cdr_begin(bytes, room);

        memset(bytes, 0xAA, sizeof bytes);
        cdr_u8(&cdr, 1);
        cdr_i32(&cdr, 1);
        cdr_u8(&cdr, 1); /* would fit into 12 again without the ones before */
        TEST_ASSERT_EQUAL_UINT(0, cdr_end(&cdr));
        TEST_ASSERT_EQUAL_HEX8(0xAA, bytes[room]);
    }
    struct cdr_writer cdr = cdr_begin(bytes, 13);
    cdr_u8(&cdr, 1);
    cdr_i32(&cdr, 1);
    cdr_u8(&cdr, 1);
    TEST_ASSERT_EQUAL_UINT(13, cdr_end(&cdr));
}

static void test_nothing_comes_after_the_end(void)
{
    static const uint8_t bytes[] = {0, 1, 0, 0, 1, 0, 0, 0, 2, 3};
    struct cdr_reader cdr = cdr_open(bytes, sizeof bytes);

    TEST_ASSERT_EQUAL_UINT(1, cdr_take_u32(&cdr));
    TEST_ASSERT_EQUAL_UINT(0, cdr_take_u32(&cdr));
    TEST_ASSERT_TRUE(cdr.short_of);
    TEST_ASSERT_EQUAL_UINT(0, cdr_take_u8(&cdr)); /* though two bytes were left */
}

static void test_another_encoding_is_none(void)
{
    static const uint8_t big_endian[] = {0, 0, 0, 0, 1}, version_2[] = {0, 7, 0, 0, 1};
    struct cdr_reader cdr = cdr_open(big_endian, sizeof big_endian);

    TEST_ASSERT_EQUAL_UINT(0, cdr_take_u8(&cdr));
    TEST_ASSERT_TRUE(cdr.short_of);
    cdr = cdr_open(version_2, sizeof version_2);
    TEST_ASSERT_EQUAL_UINT(0, cdr_take_u8(&cdr));
    cdr = cdr_open(big_endian, 3);
    TEST_ASSERT_TRUE(cdr.short_of);
}

static bool reads_string(uint8_t length, const char *four, size_t room)
{
    uint8_t bytes[12] = {0, 1, 0, 0, length};
    char text[8] = "before";
    struct cdr_reader cdr = cdr_open(bytes, sizeof bytes);

    memcpy(bytes + 8, four, 4);
    cdr_take_string(&cdr, text, room);
    TEST_ASSERT_EQUAL_STRING(cdr.short_of ? "" : four, text);
    return !cdr.short_of;
}

static void test_strings_that_are_none(void)
{
    TEST_ASSERT_TRUE(reads_string(4, "abc", 4));
    TEST_ASSERT_FALSE(reads_string(4, "abc", 3));    /* no room */
    TEST_ASSERT_FALSE(reads_string(5, "abc", 8));    /* goes on behind the message */
    TEST_ASSERT_FALSE(reads_string(3, "abc", 8));    /* no end */
    TEST_ASSERT_FALSE(reads_string(4, "a\0c\0", 8)); /* two ends */
    TEST_ASSERT_FALSE(reads_string(0, "abc", 8));
}

static void test_counts_are_weighed_before_they_are_believed(void)
{
    uint8_t bytes[24] = {0, 1, 0, 0, 2};
    struct cdr_reader cdr = cdr_open(bytes, sizeof bytes);

    TEST_ASSERT_EQUAL_UINT(2, cdr_take_count(&cdr, 8));
    cdr = cdr_open(bytes, sizeof bytes);
    TEST_ASSERT_EQUAL_UINT(0, cdr_take_count(&cdr, 9));
    TEST_ASSERT_TRUE(cdr.short_of);
    memset(bytes + 4, 0xFF, 4);
    cdr = cdr_open(bytes, sizeof bytes);
    TEST_ASSERT_EQUAL_UINT(0, cdr_take_count(&cdr, 80));
    TEST_ASSERT_TRUE(cdr.short_of);
}

static void test_true_is_1(void)
{
    static const uint8_t bytes[] = {0, 1, 0, 0, 0, 1, 2};
    struct cdr_reader cdr = cdr_open(bytes, sizeof bytes);

    TEST_ASSERT_FALSE(cdr_take_bool(&cdr));
    TEST_ASSERT_TRUE(cdr_take_bool(&cdr));
    TEST_ASSERT_FALSE(cdr.short_of);
    TEST_ASSERT_FALSE(cdr_take_bool(&cdr));
    TEST_ASSERT_TRUE(cdr.short_of);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_values_are_aligned_to_their_size_from_behind_the_head);
    RUN_TEST(test_what_is_written_is_read);
    RUN_TEST(test_a_string_has_its_length_with_its_end);
    RUN_TEST(test_strings_are_utf_8);
    RUN_TEST(test_times_before_0_too);
    RUN_TEST(test_times_that_are_none);
    RUN_TEST(test_a_message_that_does_not_fit_is_none);
    RUN_TEST(test_nothing_comes_after_the_end);
    RUN_TEST(test_another_encoding_is_none);
    RUN_TEST(test_strings_that_are_none);
    RUN_TEST(test_counts_are_weighed_before_they_are_believed);
    RUN_TEST(test_true_is_1);
    return UNITY_END();
}
