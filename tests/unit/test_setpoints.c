#include "setpoints.h"

#include "limits.h"

#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void test_the_bytes_of_a_datagram(void)
{
    static const struct setpoint two[] = {{0x0102, 0x0304, -2}, {3, -PWM_STEPS, PWM_STEPS}};
    static const uint8_t expected[] = {'M',  'S',  'P', 1, 0x02, 0x01, 0x04, 0x03,
                                       0xFE, 0xFF, 3,   0, 0x01, 0xC0, 0xFF, 0x3F};
    uint8_t bytes[sizeof expected];

    TEST_ASSERT_EQUAL_UINT(sizeof expected, setpoints_bytes(2));
    setpoints_write(two, 2, bytes);
    TEST_ASSERT_EQUAL_MEMORY(expected, bytes, sizeof expected);
}

static void test_what_is_written_is_read(void)
{
    static const struct setpoint three[] = {{1, 0, 0}, {65534, 12345, -12345}, {7, -1, 1}};
    uint8_t bytes[SETPOINTS_HEADER + 3 * SETPOINTS_ENTRY];
    size_t count;

    setpoints_write(three, 3, bytes);
    TEST_ASSERT_TRUE(setpoints_count(bytes, sizeof bytes, &count));
    TEST_ASSERT_EQUAL_UINT(3, count);
    for (size_t i = 0; i < count; i++) {
        struct setpoint read = setpoints_read(bytes, i);

        TEST_ASSERT_EQUAL_UINT(three[i].id, read.id);
        TEST_ASSERT_EQUAL_INT(three[i].left, read.left);
        TEST_ASSERT_EQUAL_INT(three[i].right, read.right);
    }
}

static void test_no_robots_are_a_datagram(void)
{
    uint8_t bytes[SETPOINTS_HEADER];
    size_t count = 1;

    setpoints_write(NULL, 0, bytes);
    TEST_ASSERT_TRUE(setpoints_count(bytes, sizeof bytes, &count));
    TEST_ASSERT_EQUAL_UINT(0, count);
}

static void test_what_is_no_datagram_is_refused(void)
{
    uint8_t bytes[SETPOINTS_HEADER + SETPOINTS_ENTRY];
    size_t count;

    setpoints_write(&(struct setpoint){1, 2, 3}, 1, bytes);
    for (size_t length = 0; length < sizeof bytes; length++)
        TEST_ASSERT_EQUAL(length == SETPOINTS_HEADER, setpoints_count(bytes, length, &count));
    for (size_t i = 0; i < SETPOINTS_HEADER; i++) {
        bytes[i] ^= 1;
        TEST_ASSERT_FALSE(setpoints_count(bytes, sizeof bytes, &count));
        bytes[i] ^= 1;
    }
}

static void test_beyond_full_scale_is_full_scale(void)
{
    uint8_t bytes[SETPOINTS_HEADER + SETPOINTS_ENTRY];

    setpoints_write(&(struct setpoint){1, INT16_MIN, INT16_MAX}, 1, bytes);
    struct setpoint read = setpoints_read(bytes, 0);
    TEST_ASSERT_EQUAL_INT(-PWM_STEPS, read.left);
    TEST_ASSERT_EQUAL_INT(PWM_STEPS, read.right);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_bytes_of_a_datagram);
    RUN_TEST(test_what_is_written_is_read);
    RUN_TEST(test_no_robots_are_a_datagram);
    RUN_TEST(test_what_is_no_datagram_is_refused);
    RUN_TEST(test_beyond_full_scale_is_full_scale);
    return UNITY_END();
}
