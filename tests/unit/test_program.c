#include "program.h"

#include <string.h>
#include <unity.h>

#define FLASH_BYTES 0x20000u
#define BAUD 115200

static uint8_t flash[FLASH_BYTES];
static struct program program;
static char words[160];

static void put(size_t at, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        flash[at + (size_t)i] = (uint8_t)(value >> 8 * i);
}

static void seal(uint16_t length, uint32_t crc)
{
    put(SEAL_AT, length, 2);
    put(SEAL_AT + 2, (uint16_t)~length, 2);
    put(SEAL_AT + 4, crc, 4);
}

/* The bytes whose CRC everybody knows. */
void setUp(void)
{
    memset(flash, 0xFF, sizeof flash);
    memcpy(flash, "123456789", 9);
    seal(9, 0xCBF43926);
}

void tearDown(void)
{
}

static bool take(void)
{
    return program_take(&program, flash, BAUD, words, sizeof words);
}

static void refused(const char *because)
{
    TEST_ASSERT_FALSE(take());
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(words, because), words);
}

static void test_a_sealed_one_is_taken(void)
{
    TEST_ASSERT_TRUE(take());
    TEST_ASSERT_EQUAL_UINT16(9, program.length);
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926, program.crc);
    TEST_ASSERT_EQUAL_UINT32(BAUD, program.baud);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(flash, program.slot, SLOT_BYTES);
}

static void test_without_a_seal_it_is_refused(void)
{
    memset(flash + SEAL_AT, 0xFF, SLOT_BYTES - SEAL_AT);
    refused("has no seal");
}

static void test_a_changed_one_is_refused(void)
{
    flash[4] ^= 1;
    refused("is not what its seal says");
}

static void test_bytes_that_the_seal_does_not_cover_are_refused(void)
{
    flash[9] = 0;
    refused("is not what its seal says");
    setUp();
    flash[SEAL_AT - 1] = 0;
    refused("is not what its seal says");
}

static void test_a_damaged_seal_is_refused(void)
{
    put(SEAL_AT + 2, 9, 2);
    refused("its seal is damaged");
    setUp();
    seal(0, 0);
    refused("its seal is damaged");
    seal((uint16_t)(PROGRAM_BYTES_MAX + 1), 0);
    refused("is longer than");
}

static void test_a_boot_loader_is_refused(void)
{
    flash[LOADER_START] = 0x0C;
    refused("no boot loader");
    setUp();
    flash[SLOT_BYTES] = 0;
    refused("no boot loader");
}

static void test_the_seals_page_comes_last(void)
{
    TEST_ASSERT_TRUE(take());
    TEST_ASSERT_EQUAL_UINT16(2, program_pages(&program));
    TEST_ASSERT_EQUAL_HEX16(0, program_page_at(&program, 0));
    TEST_ASSERT_EQUAL_HEX16(0xFB00, program_page_at(&program, 1));

    program.length = FLASH_PAGE_BYTES;
    TEST_ASSERT_EQUAL_UINT16(2, program_pages(&program));
    program.length = FLASH_PAGE_BYTES + 1;
    TEST_ASSERT_EQUAL_UINT16(3, program_pages(&program));
    TEST_ASSERT_EQUAL_HEX16(0x0100, program_page_at(&program, 1));
    program.length = (uint16_t)PROGRAM_BYTES_MAX;
    TEST_ASSERT_EQUAL_UINT16(PROGRAM_PAGES_MAX, program_pages(&program));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sealed_one_is_taken);
    RUN_TEST(test_without_a_seal_it_is_refused);
    RUN_TEST(test_a_changed_one_is_refused);
    RUN_TEST(test_bytes_that_the_seal_does_not_cover_are_refused);
    RUN_TEST(test_a_damaged_seal_is_refused);
    RUN_TEST(test_a_boot_loader_is_refused);
    RUN_TEST(test_the_seals_page_comes_last);
    return UNITY_END();
}
