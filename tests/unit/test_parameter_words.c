#include "parameter_words.h"

#include <string.h>
#include <unity.h>

static char words[PARAMETER_WORDS_MAX];
static char error[160];

void setUp(void)
{
    error[0] = '\0';
}

void tearDown(void)
{
}

static void test_names_are_found_stored_and_read(void)
{
    uint8_t index;

    TEST_ASSERT_TRUE(parameter_find("track", &index, error, sizeof error));
    TEST_ASSERT_EQUAL_UINT(PARAMETER_TRACK, index);
    TEST_ASSERT_TRUE(parameter_is_stored(index));
    TEST_ASSERT_TRUE(parameter_find("image", &index, error, sizeof error));
    TEST_ASSERT_EQUAL_UINT(PARAMETER_IMAGE, index);
    TEST_ASSERT_FALSE(parameter_is_stored(index));
}

static void test_a_name_that_is_none_is_told_with_what_was_meant(void)
{
    uint8_t index;

    TEST_ASSERT_FALSE(parameter_find("left_gian", &index, error, sizeof error));
    TEST_ASSERT_EQUAL_STRING("no parameter is called 'left_gian'; perhaps 'left_gain'", error);
    TEST_ASSERT_FALSE(parameter_find("colour", &index, error, sizeof error));
    TEST_ASSERT_EQUAL_STRING("no parameter is called 'colour'; 'muster param list' names them",
                             error);
}

static void test_lines_are_of_the_table(void)
{
    const struct parameter_line *line = parameter_line(PARAMETER_BATTERY_WARNING);

    TEST_ASSERT_EQUAL_STRING("battery_warning", line->name);
    TEST_ASSERT_EQUAL_STRING("V", line->unit);
    TEST_ASSERT_EQUAL_UINT(1000, line->per_unit);
    TEST_ASSERT_EQUAL_UINT(30000, line->high);
    TEST_ASSERT_EQUAL_UINT(6600, line->unless_set);
    TEST_ASSERT_EQUAL_STRING("resets", parameter_line(PARAMETER_RESETS)->name);
    TEST_ASSERT_NULL(parameter_line(PARAMETERS_STORED_COUNT));
    TEST_ASSERT_NULL(parameter_line(PARAMETERS_READ_FROM - 1));
    TEST_ASSERT_NULL(parameter_line(PARAMETERS_END));
}

static void test_words_have_units(void)
{
    TEST_ASSERT_EQUAL_STRING("1.00000", parameter_words(PARAMETER_LEFT_GAIN, 16384, words));
    TEST_ASSERT_EQUAL_STRING("7.400 V", parameter_words(PARAMETER_BATTERY_WARNING, 7400, words));
    TEST_ASSERT_EQUAL_STRING("0.0803 m", parameter_words(PARAMETER_TRACK, 321, words));
    TEST_ASSERT_EQUAL_STRING("65534", parameter_words(PARAMETER_ID, 65534, words));
    TEST_ASSERT_EQUAL_STRING("000C55AA", parameter_words(PARAMETER_IMAGE, 0xC55AA, words));
    TEST_ASSERT_EQUAL_STRING("FFFFFFFF", parameter_words(PARAMETER_IMAGE, UINT32_MAX, words));
    TEST_ASSERT_EQUAL_STRING("4294967295", parameter_words(PARAMETER_RESETS, UINT32_MAX, words));
}

/* Every value that the table allows. */
static void test_what_is_written_is_read(void)
{
    for (uint8_t index = 0; index < PARAMETERS_STORED_COUNT; index++) {
        const struct parameter_line *line = parameter_line(index);

        for (uint32_t value = line->low; value <= line->high; value++) {
            uint16_t read = 0;

            parameter_number(index, value, words);
            if (!parameter_value(index, words, &read, error, sizeof error))
                TEST_FAIL_MESSAGE(error);
            TEST_ASSERT_EQUAL_UINT_MESSAGE(value, read, words);
        }
    }
}

static void refuse(uint8_t index, const char *text, const char *expected)
{
    uint16_t value = 1;

    TEST_ASSERT_FALSE(parameter_value(index, text, &value, error, sizeof error));
    TEST_ASSERT_EQUAL_STRING_LEN(expected, error, strlen(expected));
    TEST_ASSERT_EQUAL_UINT(1, value);
}

static void test_values_that_are_none(void)
{
    refuse(PARAMETER_LEFT_GAIN, "1.51", "left_gain is 1.51; a number from 0.5 to 1.5 is allowed");
    refuse(PARAMETER_RIGHT_DEAD_BAND, "-0.01",
           "right_dead_band is -0.01; a number from 0 to 0.3 is allowed");
    refuse(PARAMETER_MOTOR_LAG, "0.51", "motor_lag is 0.51; a number from 0 to 0.5 s is allowed");
    refuse(PARAMETER_ID, "1.5", "id is 1.5; a whole number from 0 to 65534 is allowed");
    refuse(PARAMETER_ID, "65535", "id is 65535; a whole number from 0 to 65534 is allowed");
    refuse(PARAMETER_TRACK, "1/0", "track is inf; a number from 0 to 2 m is allowed");
    refuse(PARAMETER_TRACK, "sqrt(-1)", "track is ");
    refuse(PARAMETER_TRACK, "wide", "track is 'wide', no number: ");
    refuse(PARAMETER_TRACK, "", "track is '', no number: ");
    refuse(PARAMETER_RESETS, "0", "resets is a reading; only stored parameters can be set");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_names_are_found_stored_and_read);
    RUN_TEST(test_a_name_that_is_none_is_told_with_what_was_meant);
    RUN_TEST(test_lines_are_of_the_table);
    RUN_TEST(test_words_have_units);
    RUN_TEST(test_what_is_written_is_read);
    RUN_TEST(test_values_that_are_none);
    return UNITY_END();
}
