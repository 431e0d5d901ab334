#include "uart.h"

#include <string.h>
#include <unity.h>

static struct uart uart;

void setUp(void)
{
    memset(&uart, 0, sizeof uart);
}

void tearDown(void)
{
}

/* Many times around the ring, in pieces that never fit it evenly. */
static void test_bytes_keep_their_order(void)
{
    uint8_t in = 0, out = 0, bytes[300];

    for (int round = 0; round < 1000; round++) {
        for (size_t i = 0; i < 230; i++)
            bytes[i] = in++;
        uart_put(&uart, bytes, 230);
        size_t taken = uart_take(&uart, bytes, (size_t)(round % 300));
        for (size_t i = 0; i < taken; i++)
            TEST_ASSERT_EQUAL_HEX8(out++, bytes[i]);
        taken = uart_take(&uart, bytes, sizeof bytes);
        for (size_t i = 0; i < taken; i++)
            TEST_ASSERT_EQUAL_HEX8(out++, bytes[i]);
    }
    TEST_ASSERT_EQUAL_UINT(0, uart.lost);
    TEST_ASSERT_EQUAL_UINT(0, uart.count);
}

static void test_what_finds_no_room_is_lost(void)
{
    static uint8_t bytes[UART_ROOM + 10];

    memset(bytes, 1, UART_ROOM - 1);
    uart_put(&uart, bytes, UART_ROOM - 1);
    memset(bytes, 2, 5);
    uart_put(&uart, bytes, 5);
    TEST_ASSERT_EQUAL_UINT(4, uart.lost);
    TEST_ASSERT_EQUAL_UINT(UART_ROOM, uart_take(&uart, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_HEX8(1, bytes[UART_ROOM - 2]);
    TEST_ASSERT_EQUAL_HEX8(2, bytes[UART_ROOM - 1]);
    TEST_ASSERT_EQUAL_UINT(0, uart_take(&uart, bytes, sizeof bytes));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_bytes_keep_their_order);
    RUN_TEST(test_what_finds_no_room_is_lost);
    return UNITY_END();
}
