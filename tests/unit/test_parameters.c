#include "parameters.h"

#include "frame.h"
#include "limits.h"

#include <string.h>
#include <unity.h>

void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_kept(uint16_t id)
{
    uint8_t record[PARAMETERS_BYTES];
    struct parameters written = {id}, read = {0};

    parameters_write(record, &written);
    TEST_ASSERT_TRUE(parameters_read(&read, record));
    TEST_ASSERT_EQUAL_UINT16(id, read.id);
}

static void assert_refused(const uint8_t record[PARAMETERS_BYTES])
{
    struct parameters read = {77};

    TEST_ASSERT_FALSE(parameters_read(&read, record));
    TEST_ASSERT_EQUAL_UINT16(0, read.id);
}

static void test_ids_are_kept(void)
{
    assert_kept(1);
    assert_kept(0x1234);
    assert_kept(ROBOT_ID_MAX);
}

static void test_the_record_has_its_known_answer(void)
{
    static const uint8_t known[PARAMETERS_BYTES] = {0x01, 0x34, 0x12, 0xBE, 0x81};
    uint8_t record[PARAMETERS_BYTES];
    struct parameters parameters = {0x1234};

    parameters_write(record, &parameters);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(known, record, PARAMETERS_BYTES);
}

static void test_a_blank_eeprom_holds_no_id(void)
{
    uint8_t record[PARAMETERS_BYTES];

    memset(record, 0xFF, sizeof record);
    assert_refused(record);
    memset(record, 0, sizeof record);
    assert_refused(record);
}

static void test_every_flipped_bit_is_noticed(void)
{
    struct parameters parameters = {3};

    for (unsigned bit = 0; bit < 8 * PARAMETERS_BYTES; bit++) {
        uint8_t record[PARAMETERS_BYTES];

        parameters_write(record, &parameters);
        record[bit / 8] ^= (uint8_t)(1 << bit % 8);
        assert_refused(record);
    }
}

static void test_another_version_is_no_record(void)
{
    uint8_t record[PARAMETERS_BYTES] = {PARAMETERS_VERSION + 1, 0x34, 0x12};
    uint16_t crc = CRC16_INITIAL;

    for (uint8_t i = 0; i < 3; i++)
        crc = crc16_update(crc, record[i]);
    record[3] = (uint8_t)crc;
    record[4] = (uint8_t)(crc >> 8);
    assert_refused(record);
}

static void test_ids_out_of_range_are_refused(void)
{
    uint8_t record[PARAMETERS_BYTES];
    struct parameters nobody = {0}, beyond = {ROBOT_ID_MAX + 1};

    parameters_write(record, &nobody);
    assert_refused(record);
    parameters_write(record, &beyond);
    assert_refused(record);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_ids_are_kept);
    RUN_TEST(test_the_record_has_its_known_answer);
    RUN_TEST(test_a_blank_eeprom_holds_no_id);
    RUN_TEST(test_every_flipped_bit_is_noticed);
    RUN_TEST(test_another_version_is_no_record);
    RUN_TEST(test_ids_out_of_range_are_refused);
    return UNITY_END();
}
