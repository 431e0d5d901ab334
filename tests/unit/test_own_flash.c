/* Each test writes a few instructions to where the loader is, and lets them run. */
#include "own_flash.h"

#include "avr_core.h"

#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define PAGE 0x0300u
#define CYCLES_PER_MS 16000u

/* Any sts and spm between the two is in time. */
enum { NOP = 0x0000, SPM = 0x95E8, LPM_R18_Z = 0x9124, STAY = 0xCFFF };
enum { R0 = 0, R1 = 1, R16 = 16, ZL = 30, ZH = 31 };

static uint8_t no_code[FLASH_BYTES];
static const struct avr_image image = {.flash = no_code, .f_cpu = 16000000, .baud = 115200};
static struct own_flash *flash;
static struct avr_core *core;
static uint32_t at;

static void word(unsigned opcode)
{
    flash->bytes[at++] = (uint8_t)opcode;
    flash->bytes[at++] = (uint8_t)(opcode >> 8);
}

static void load(unsigned reg, uint8_t value)
{
    word(0xE000u | (value & 0xF0u) << 4 | (reg - 16) << 4 | (value & 0x0Fu));
}

static void point_z(uint16_t to)
{
    load(ZL, (uint8_t)to);
    load(ZH, (uint8_t)(to >> 8));
}

/* SPMCSR is given a command. */
static void command(uint8_t value)
{
    load(R16, value);
    word(0x9200u | R16 << 4);
    word(SPMCSR);
}

static void store(uint8_t value)
{
    command(value);
    word(SPM);
}

/* The word of the page buffer that Z points to. */
static void fill(uint8_t low, uint8_t high)
{
    load(R16, low);
    word(0x2C00u | R0 << 4 | 0x0200u | (R16 & 15)); /* mov */
    load(R16, high);
    word(0x2C00u | R1 << 4 | 0x0200u | (R16 & 15));
    store(SPM_ENABLE);
}

static void power_off(void)
{
    if (core != NULL)
        avr_core_free(core);
    core = NULL;
}

static void power_on(void)
{
    core = avr_core_new_with_flash(&image, flash);
    TEST_ASSERT_NOT_NULL(core);
}

/* What was written so far, from the reset on. */
static bool run_ms(unsigned ms)
{
    word(STAY);
    if (core == NULL)
        power_on();
    return avr_core_run(core, avr_core_cycle(core) + (uint64_t)ms * CYCLES_PER_MS);
}

static void assert_blamed(const char *words)
{
    TEST_ASSERT_FALSE(run_ms(1));
    TEST_ASSERT_EQUAL_STRING(words, flash->fault);
}

void setUp(void)
{
    flash = own_flash_new();
    TEST_ASSERT_NOT_NULL(flash);
    memset(flash->bytes + PAGE, 0x55, FLASH_PAGE_BYTES);
    at = LOADER_START;
    point_z(PAGE + 8);
}

void tearDown(void)
{
    power_off();
    free(flash);
}

static bool page_is(uint8_t value)
{
    for (int i = 0; i < FLASH_PAGE_BYTES; i++)
        if (flash->bytes[PAGE + i] != value)
            return false;
    return true;
}

static void test_erasing_takes_its_time(void)
{
    store(SPM_ERASE | SPM_ENABLE);
    TEST_ASSERT_TRUE(run_ms(4));
    TEST_ASSERT_TRUE(flash->busy);
    TEST_ASSERT_FALSE(page_is(0x55) || page_is(0xFF));
    TEST_ASSERT_BITS_HIGH(SPM_ENABLE | SPM_BLOCKED, avr_core_data(core)[SPMCSR]);
    TEST_ASSERT_TRUE(run_ms(1));
    TEST_ASSERT_FALSE(flash->busy);
    TEST_ASSERT_TRUE(page_is(0xFF));
    TEST_ASSERT_EQUAL_HEX8(SPM_BLOCKED, avr_core_data(core)[SPMCSR]);
    TEST_ASSERT_EQUAL_HEX8(0xFF, flash->bytes[PAGE - 1]);
    TEST_ASSERT_EQUAL_UINT(1, flash->operations);
}

static void test_writing_makes_no_ones(void)
{
    fill(0x0F, 0xF0);
    store(SPM_WRITE | SPM_ENABLE);
    TEST_ASSERT_TRUE(run_ms(5));
    TEST_ASSERT_EQUAL_HEX8(0x55, flash->bytes[PAGE + 7]);
    TEST_ASSERT_EQUAL_HEX8(0x05, flash->bytes[PAGE + 8]);
    TEST_ASSERT_EQUAL_HEX8(0x50, flash->bytes[PAGE + 9]);
    TEST_ASSERT_EQUAL_HEX8(0x55, flash->bytes[PAGE + 10]);
}

static void test_a_page_cut_short_holds_the_same_rubbish_each_time(void)
{
    uint8_t rubbish[FLASH_PAGE_BYTES];

    store(SPM_ERASE | SPM_ENABLE);
    TEST_ASSERT_TRUE(run_ms(1));
    memcpy(rubbish, flash->bytes + PAGE, sizeof rubbish);
    power_off();
    TEST_ASSERT_EQUAL_HEX8_ARRAY(rubbish, flash->bytes + PAGE, sizeof rubbish);
    tearDown();
    setUp();
    store(SPM_ERASE | SPM_ENABLE);
    TEST_ASSERT_TRUE(run_ms(1));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(rubbish, flash->bytes + PAGE, sizeof rubbish);
}

static void test_a_reset_cuts_short_as_well(void)
{
    store(SPM_ERASE | SPM_ENABLE);
    TEST_ASSERT_TRUE(run_ms(1));
    at = LOADER_START;
    word(STAY);
    avr_core_reset(core);
    TEST_ASSERT_TRUE(run_ms(10));
    TEST_ASSERT_FALSE(flash->busy || page_is(0xFF));
}

static void test_reading_is_possible_again_after_its_command(void)
{
    store(SPM_ERASE | SPM_ENABLE);
    TEST_ASSERT_TRUE(run_ms(5));
    at -= 2; /* the program goes on */
    store(SPM_READABLE | SPM_ENABLE);
    word(LPM_R18_Z);
    TEST_ASSERT_TRUE(run_ms(1));
    TEST_ASSERT_EQUAL_HEX8(0xFF, avr_core_data(core)[18]);
}

static void test_reading_before_it_is_a_fault(void)
{
    store(SPM_ERASE | SPM_ENABLE);
    word(LPM_R18_Z);
    assert_blamed("the flash was read while it cannot be");
}

static void test_storing_while_it_is_busy_is_a_fault(void)
{
    store(SPM_ERASE | SPM_ENABLE);
    store(SPM_ENABLE);
    assert_blamed("SPM while a page was erased or written");
}

static void test_storing_too_late_is_a_fault(void)
{
    command(SPM_ENABLE);
    for (int i = 0; i < 5; i++)
        word(NOP);
    word(SPM);
    assert_blamed("SPM more than four cycles after its command");
}

static void test_storing_to_the_loader_is_a_fault(void)
{
    load(R16, 1);
    word(0xB800u | 0x0600u | (R16 & 15) << 4 | 0x0100u | 0x0Bu); /* out RAMPZ */
    point_z((uint16_t)LOADER_START);
    store(SPM_ERASE | SPM_ENABLE);
    assert_blamed("a page of the loader was to be erased or written");
}

static void test_the_program_cannot_store(void)
{
    word(0x940C); /* jmp 0 */
    word(0);
    at = 0;
    store(SPM_ERASE | SPM_ENABLE);
    assert_blamed("SPM outside of the loader");
}

static void test_fuses_are_read_by_the_next_instruction(void)
{
    point_z(3);
    command(SPM_FUSES | SPM_ENABLE);
    word(LPM_R18_Z);
    TEST_ASSERT_TRUE(run_ms(1));
    TEST_ASSERT_EQUAL_HEX8(0x84, avr_core_data(core)[18]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_erasing_takes_its_time);
    RUN_TEST(test_writing_makes_no_ones);
    RUN_TEST(test_a_page_cut_short_holds_the_same_rubbish_each_time);
    RUN_TEST(test_a_reset_cuts_short_as_well);
    RUN_TEST(test_reading_is_possible_again_after_its_command);
    RUN_TEST(test_reading_before_it_is_a_fault);
    RUN_TEST(test_storing_while_it_is_busy_is_a_fault);
    RUN_TEST(test_storing_too_late_is_a_fault);
    RUN_TEST(test_storing_to_the_loader_is_a_fault);
    RUN_TEST(test_the_program_cannot_store);
    RUN_TEST(test_fuses_are_read_by_the_next_instruction);
    return UNITY_END();
}
