#include "parameters.h"

#include "frame.h"
#include "limits.h"

#include <string.h>
#include <unity.h>

static struct parameters parameters, read;
static struct parameters_source source;
static uint8_t eeprom[PARAMETERS_BYTES];
static uint8_t *const second = eeprom + PARAMETERS_BANK_BYTES;

void setUp(void)
{
    memset(eeprom, 0xFF, sizeof eeprom);
    parameters_default(&parameters);
    parameters.value[PARAMETER_ID] = 3;
}

void tearDown(void)
{
}

/* A whole bank with that id. */
static void put(uint8_t *bank, uint8_t sequence, uint16_t id)
{
    parameters.value[PARAMETER_ID] = id;
    parameters_record(&parameters, sequence, bank);
}

/* Makes the CRC right of a bank that has `count` values. */
static void seal(uint8_t *bank, uint8_t count)
{
    uint16_t crc = CRC16_INITIAL;
    uint8_t length = (uint8_t)(3 + 2 * count);

    for (uint8_t i = 0; i < length; i++)
        crc = crc16_update(crc, bank[i]);
    bank[length] = (uint8_t)crc;
    bank[length + 1] = (uint8_t)(crc >> 8);
}

static void look(void)
{
    memset(&read, 0x55, sizeof read);
    source = parameters_read(&read, eeprom);
}

static void assert_found(uint8_t whole, uint8_t bank, uint16_t id)
{
    look();
    TEST_ASSERT_EQUAL_UINT8(whole, source.whole);
    TEST_ASSERT_EQUAL_UINT8(bank, source.bank);
    TEST_ASSERT_EQUAL_UINT16(id, read.value[PARAMETER_ID]);
}

static void assert_none(void)
{
    struct parameters unless_set;

    assert_found(0, 1, 0);
    parameters_default(&unless_set);
    TEST_ASSERT_EQUAL_MEMORY(&unless_set, &read, sizeof read);
}

static void test_every_value_is_kept(void)
{
    for (uint8_t i = 0; i < PARAMETERS_STORED_COUNT; i++) {
        setUp();
        parameters.value[i]++;
        parameters_write(eeprom, &parameters);
        look();
        TEST_ASSERT_EQUAL_UINT8(1, source.whole);
        TEST_ASSERT_EQUAL_UINT8(0, source.bank);
        TEST_ASSERT_EQUAL_MEMORY(&parameters, &read, sizeof read);
    }
}

static void test_the_record_has_its_known_answer(void)
{
    static const uint8_t known[PARAMETERS_RECORD_BYTES] = {
        0x02, 0x07, 0x09, 0x34, 0x12, 0x00, 0x40, 0x00, 0x40, 0x00, 0x00, 0x00,
        0x00, 0x00, 0x00, 0x00, 0x00, 0xC8, 0x19, 0x38, 0x18, 0xE3, 0xCB};

    put(eeprom, 7, 0x1234);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(known, eeprom, PARAMETERS_RECORD_BYTES);
}

static void test_a_blank_eeprom_holds_none(void)
{
    assert_none();
    memset(eeprom, 0, sizeof eeprom);
    assert_none();
}

static void test_every_flipped_bit_is_noticed(void)
{
    for (unsigned bit = 0; bit < 8 * PARAMETERS_RECORD_BYTES; bit++) {
        parameters_write(eeprom, &parameters);
        eeprom[bit / 8] ^= (uint8_t)(1 << bit % 8);
        assert_none();
    }
}

static void test_another_format_is_no_record(void)
{
    parameters_write(eeprom, &parameters);
    eeprom[0]++;
    seal(eeprom, PARAMETERS_STORED_COUNT);
    assert_none();
}

static void test_a_value_that_is_not_allowed_makes_the_record_none(void)
{
    put(eeprom, 0, ROBOT_ID_MAX);
    assert_found(1, 0, ROBOT_ID_MAX);
    put(eeprom, 0, ROBOT_ID_MAX + 1);
    assert_none();
}

static void test_the_later_bank_counts(void)
{
    put(eeprom, 7, 3);
    put(second, 8, 4);
    assert_found(2, 1, 4);
    TEST_ASSERT_EQUAL_UINT8(8, source.sequence);
    put(eeprom, 9, 5);
    assert_found(2, 0, 5);
    TEST_ASSERT_EQUAL_UINT8(9, source.sequence);
}

static void test_sequences_wrap(void)
{
    put(eeprom, 255, 3);
    put(second, 0, 4);
    assert_found(2, 1, 4);
    put(eeprom, 0, 3);
    put(second, 255, 4);
    assert_found(2, 0, 3);
}

static void test_a_bank_that_was_cut_short_leaves_the_other_one(void)
{
    for (uint8_t bytes = 0; bytes < PARAMETERS_RECORD_BYTES; bytes++) {
        put(eeprom, 7, 3);
        put(second, 6, 4);
        uint8_t old[PARAMETERS_RECORD_BYTES];
        memcpy(old, second, sizeof old);
        put(second, 8, 5);
        uint8_t whole = 1 + (memcmp(old, second, sizeof old) == 0);
        memcpy(second + bytes, old + bytes, (size_t)(PARAMETERS_RECORD_BYTES - bytes));
        if (memcmp(second, old, sizeof old) == 0)
            whole = 2;
        assert_found(whole, 0, 3);
    }
    put(second, 8, 5);
    assert_found(2, 1, 5);
}

static void test_an_older_record_leaves_what_it_does_not_have_at_its_default(void)
{
    put(eeprom, 0, 3);
    eeprom[2] = 2;
    eeprom[5] = 0x39; /* left_gain 0x3039 */
    eeprom[6] = 0x30;
    seal(eeprom, 2);
    look();
    TEST_ASSERT_EQUAL_UINT8(1, source.whole);
    TEST_ASSERT_EQUAL_UINT16(3, read.value[PARAMETER_ID]);
    TEST_ASSERT_EQUAL_UINT16(0x3039, read.value[PARAMETER_LEFT_GAIN]);
    TEST_ASSERT_EQUAL_UINT16(16384, read.value[PARAMETER_RIGHT_GAIN]);
    TEST_ASSERT_EQUAL_UINT16(6200, read.value[PARAMETER_BATTERY_CRITICAL]);
}

static void test_of_a_newer_record_the_first_are_read(void)
{
    put(eeprom, 0, 3);
    eeprom[2] = 29;
    memset(eeprom + PARAMETERS_RECORD_BYTES - 2, 0xEE, 40);
    seal(eeprom, 29);
    assert_found(1, 0, 3);
    TEST_ASSERT_EQUAL_MEMORY(&parameters, &read, sizeof read);
    eeprom[2] = 30; /* more than a bank has room for */
    seal(eeprom, 30);
    assert_none();
}

static void test_what_the_table_allows(void)
{
    TEST_ASSERT_TRUE(parameters_allow(PARAMETER_ID, 0));
    TEST_ASSERT_TRUE(parameters_allow(PARAMETER_ID, 65534));
    TEST_ASSERT_FALSE(parameters_allow(PARAMETER_ID, 65535));
    TEST_ASSERT_FALSE(parameters_allow(PARAMETER_ID, 65536 + 3));
    TEST_ASSERT_FALSE(parameters_allow(PARAMETER_LEFT_GAIN, 8191));
    TEST_ASSERT_TRUE(parameters_allow(PARAMETER_LEFT_GAIN, 8192));
    TEST_ASSERT_FALSE(parameters_allow(PARAMETERS_STORED_COUNT, 0));
    TEST_ASSERT_FALSE(parameters_allow(PARAMETER_IMAGE, 0));
}

static void test_defaults_are_allowed(void)
{
    parameters_default(&parameters);
    for (uint8_t i = 0; i < PARAMETERS_STORED_COUNT; i++)
        TEST_ASSERT_TRUE(parameters_allow(i, parameters.value[i]));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_value_is_kept);
    RUN_TEST(test_the_record_has_its_known_answer);
    RUN_TEST(test_a_blank_eeprom_holds_none);
    RUN_TEST(test_every_flipped_bit_is_noticed);
    RUN_TEST(test_another_format_is_no_record);
    RUN_TEST(test_a_value_that_is_not_allowed_makes_the_record_none);
    RUN_TEST(test_the_later_bank_counts);
    RUN_TEST(test_sequences_wrap);
    RUN_TEST(test_a_bank_that_was_cut_short_leaves_the_other_one);
    RUN_TEST(test_an_older_record_leaves_what_it_does_not_have_at_its_default);
    RUN_TEST(test_of_a_newer_record_the_first_are_read);
    RUN_TEST(test_what_the_table_allows);
    RUN_TEST(test_defaults_are_allowed);
    return UNITY_END();
}
