#include "keeper.h"

#include <string.h>
#include <unity.h>

#define ID 7

static struct keeper keeper;
static struct keeper_view view;
static struct store store;
static uint8_t eeprom[PARAMETERS_BYTES];
static int broken_at; /* this cell keeps what it has; -1: all are good */
static unsigned written;

static void switch_on(void)
{
    keeper_init(&keeper, eeprom);
    view = (struct keeper_view){.image = 0xCBF43926, .resets = 3};
    store = (struct store){false, 0, 0};
}

void setUp(void)
{
    struct parameters parameters;

    parameters_default(&parameters);
    parameters.value[PARAMETER_ID] = ID;
    parameters_write(eeprom, &parameters);
    broken_at = -1;
    written = 0;
    switch_on();
}

void tearDown(void)
{
}

/* A tick, and what the board does with what comes of it. */
static bool step(void)
{
    bool changed = false;

    store.wanted = false;
    if (keeper_is_busy(&keeper))
        changed = keeper_step(&keeper, &view, &store);

    if (store.wanted) {
        TEST_ASSERT_TRUE(store.at < PARAMETERS_BYTES);
        if (store.at != broken_at)
            eeprom[store.at] = store.byte;
        view.stored = eeprom[store.at];
        written++;
    }
    return changed;
}

static void ask(uint8_t tag, uint8_t action, uint8_t index, uint32_t value)
{
    keeper_hear(&keeper, &(struct message_ask){tag, action, index, value});
}

static void assert_answer(uint8_t tag, uint8_t result, uint8_t index, uint32_t value)
{
    TEST_ASSERT_TRUE(keeper.due);
    TEST_ASSERT_EQUAL_UINT8(tag, keeper.answer.tag);
    TEST_ASSERT_EQUAL_UINT8(result, keeper.answer.result);
    TEST_ASSERT_EQUAL_UINT8(index, keeper.answer.index);
    TEST_ASSERT_EQUAL_HEX32(value, keeper.answer.value);
    keeper.due = false;
}

static void assert_asked(uint8_t action, uint8_t index, uint32_t value, uint8_t result,
                         uint32_t value_now)
{
    ask(5, action, index, value);
    step();
    assert_answer(5, result, index, value_now);
}

/* Ticks until there is an answer. */
static int await_answer(void)
{
    for (int ticks = 0; ticks < 100; ticks++) {
        if (keeper.due)
            return ticks;
        step();
    }
    TEST_FAIL_MESSAGE("no answer");
    return 0;
}

static void save(uint8_t result)
{
    ask(9, PARAMETER_SAVE, 0, 0);
    await_answer();
    assert_answer(9, result, 0, keeper.parameters.value[PARAMETER_ID]);
}

static void test_every_parameter_can_be_read(void)
{
    assert_asked(PARAMETER_GET, PARAMETER_ID, 0, PARAMETER_DONE, ID);
    assert_asked(PARAMETER_GET, PARAMETER_RIGHT_GAIN, 0, PARAMETER_DONE, 16384);
    assert_asked(PARAMETER_GET, PARAMETER_BATTERY_CRITICAL, 0, PARAMETER_DONE, 6200);
    TEST_ASSERT_EQUAL_UINT16(ID, keeper.answer.id);
}

static void test_readings(void)
{
    assert_asked(PARAMETER_GET, PARAMETER_IMAGE, 0, PARAMETER_DONE, 0xCBF43926);
    assert_asked(PARAMETER_GET, PARAMETER_RESETS, 0, PARAMETER_DONE, 3);
    assert_asked(PARAMETER_GET, PARAMETER_EEPROM, 0, PARAMETER_DONE, 1);
    assert_asked(PARAMETER_GET, PARAMETER_UNSAVED, 0, PARAMETER_DONE, 0);
    assert_asked(PARAMETER_SET, PARAMETER_RESETS, 1, PARAMETER_READ_ONLY, 3);
}

static void test_what_is_not_in_the_table_is_unknown(void)
{
    static const uint8_t none[] = {PARAMETERS_STORED_COUNT, PARAMETERS_READ_FROM - 1,
                                   PARAMETERS_END, 255};

    for (size_t i = 0; i < sizeof none; i++) {
        assert_asked(PARAMETER_GET, none[i], 0, PARAMETER_UNKNOWN, 0);
        assert_asked(PARAMETER_SET, none[i], 1, PARAMETER_UNKNOWN, 0);
    }
    assert_asked(PARAMETER_RESET + 1, PARAMETER_ID, 0, PARAMETER_UNKNOWN, ID);
}

static void test_a_value_set_is_in_force_at_once(void)
{
    ask(1, PARAMETER_SET, PARAMETER_TRACK, 333);
    TEST_ASSERT_TRUE(step());
    assert_answer(1, PARAMETER_DONE, PARAMETER_TRACK, 333);
    TEST_ASSERT_EQUAL_UINT16(333, keeper.parameters.value[PARAMETER_TRACK]);
    assert_asked(PARAMETER_GET, PARAMETER_UNSAVED, 0, PARAMETER_DONE, 1);
    ask(1, PARAMETER_SET, PARAMETER_TRACK, 0);
    step();
    keeper.due = false;
    assert_asked(PARAMETER_GET, PARAMETER_UNSAVED, 0, PARAMETER_DONE, 0);
}

static void test_what_the_table_does_not_allow_is_refused(void)
{
    ask(1, PARAMETER_SET, PARAMETER_TRACK, 8001);
    TEST_ASSERT_FALSE(step());
    assert_answer(1, PARAMETER_RANGE, PARAMETER_TRACK, 0);
    assert_asked(PARAMETER_SET, PARAMETER_ID, 65536 + 3, PARAMETER_RANGE, ID);
}

static void test_an_id_stays_while_a_mission_is_under_way(void)
{
    view.under_way = true;
    assert_asked(PARAMETER_SET, PARAMETER_ID, 8, PARAMETER_BUSY, ID);
    assert_asked(PARAMETER_SET, PARAMETER_TRACK, 8, PARAMETER_DONE, 8);
    view.under_way = false;
    assert_asked(PARAMETER_SET, PARAMETER_ID, 8, PARAMETER_DONE, 8);
    TEST_ASSERT_EQUAL_UINT16(8, keeper.answer.id);
}

static void test_a_reset_keeps_the_id(void)
{
    assert_asked(PARAMETER_SET, PARAMETER_LEFT_GAIN, 9999, PARAMETER_DONE, 9999);
    ask(1, PARAMETER_RESET, 0, 0);
    TEST_ASSERT_TRUE(step());
    assert_answer(1, PARAMETER_DONE, 0, ID);
    TEST_ASSERT_EQUAL_UINT16(16384, keeper.parameters.value[PARAMETER_LEFT_GAIN]);
}

static void test_there_is_room_for_one_answer(void)
{
    ask(1, PARAMETER_GET, PARAMETER_ID, 0);
    step();
    ask(2, PARAMETER_GET, PARAMETER_TRACK, 0);
    step();
    assert_answer(1, PARAMETER_DONE, PARAMETER_ID, ID);
    step();
    assert_answer(2, PARAMETER_DONE, PARAMETER_TRACK, 0);
    step();
    TEST_ASSERT_FALSE(keeper.due);
}

static void test_what_is_saved_is_there_after_a_power_cycle(void)
{
    assert_asked(PARAMETER_SET, PARAMETER_TRACK, 333, PARAMETER_DONE, 333);
    ask(9, PARAMETER_SAVE, 0, 0);
    int ticks = await_answer();
    TEST_ASSERT_TRUE(ticks > PARAMETERS_RECORD_BYTES && ticks < 100);
    assert_answer(9, PARAMETER_DONE, 0, ID);
    assert_asked(PARAMETER_GET, PARAMETER_UNSAVED, 0, PARAMETER_DONE, 0);
    assert_asked(PARAMETER_GET, PARAMETER_EEPROM, 0, PARAMETER_DONE, 2);
    switch_on();
    assert_asked(PARAMETER_GET, PARAMETER_TRACK, 0, PARAMETER_DONE, 333);
    assert_asked(PARAMETER_GET, PARAMETER_ID, 0, PARAMETER_DONE, ID);
    assert_asked(PARAMETER_GET, PARAMETER_EEPROM, 0, PARAMETER_DONE, 2);
}

static void test_saves_take_turns_between_the_banks(void)
{
    for (uint16_t i = 1; i <= 300; i++) {
        assert_asked(PARAMETER_SET, PARAMETER_TRACK, i, PARAMETER_DONE, i);
        save(PARAMETER_DONE);
        switch_on();
        TEST_ASSERT_EQUAL_UINT16(i, keeper.parameters.value[PARAMETER_TRACK]);
        TEST_ASSERT_EQUAL_UINT8(i % 2, keeper.source.bank);
    }
}

static void test_the_last_of_many_saves_counts(void)
{
    for (uint16_t i = 1; i <= 5; i++) {
        assert_asked(PARAMETER_SET, PARAMETER_TRACK, i, PARAMETER_DONE, i);
        save(PARAMETER_DONE);
    }
    switch_on();
    TEST_ASSERT_EQUAL_UINT16(5, keeper.parameters.value[PARAMETER_TRACK]);
}

static void test_a_save_that_ends_waits_for_the_answer_before(void)
{
    assert_asked(PARAMETER_SET, PARAMETER_TRACK, 333, PARAMETER_DONE, 333);
    ask(9, PARAMETER_SAVE, 0, 0);
    for (int i = 0; i < 10; i++)
        step();
    ask(1, PARAMETER_GET, PARAMETER_TRACK, 0);
    for (int i = 0; i < 100; i++)
        step();
    assert_answer(1, PARAMETER_DONE, PARAMETER_TRACK, 333);
    await_answer();
    assert_answer(9, PARAMETER_DONE, 0, ID);
}

static void test_a_save_cut_short_anywhere_loses_nothing(void)
{
    for (int cut = 0; cut <= PARAMETERS_RECORD_BYTES; cut++) {
        setUp();
        assert_asked(PARAMETER_SET, PARAMETER_TRACK, 333, PARAMETER_DONE, 333);
        save(PARAMETER_DONE);
        assert_asked(PARAMETER_SET, PARAMETER_TRACK, 444, PARAMETER_DONE, 444);
        ask(1, PARAMETER_SAVE, 0, 0);
        for (int i = 0; i < 1 + cut; i++)
            step();
        switch_on();
        TEST_ASSERT_EQUAL_UINT16(cut == PARAMETERS_RECORD_BYTES ? 444 : 333,
                                 keeper.parameters.value[PARAMETER_TRACK]);
        TEST_ASSERT_EQUAL_UINT16(ID, keeper.parameters.value[PARAMETER_ID]);
        TEST_ASSERT_NOT_EQUAL(0, keeper.source.whole);
    }
}

static void test_a_blank_eeprom_can_be_saved_to(void)
{
    memset(eeprom, 0xFF, sizeof eeprom);
    switch_on();
    assert_asked(PARAMETER_GET, PARAMETER_UNSAVED, 0, PARAMETER_DONE, 1);
    assert_asked(PARAMETER_GET, PARAMETER_EEPROM, 0, PARAMETER_DONE, 0);
    assert_asked(PARAMETER_SET, PARAMETER_ID, 12, PARAMETER_DONE, 12);
    save(PARAMETER_DONE);
    assert_asked(PARAMETER_GET, PARAMETER_EEPROM, 0, PARAMETER_DONE, 1);
    switch_on();
    TEST_ASSERT_EQUAL_UINT16(12, keeper.parameters.value[PARAMETER_ID]);
}

static void test_with_nothing_to_save_no_byte_is_written(void)
{
    save(PARAMETER_DONE);
    TEST_ASSERT_EQUAL(0, written);
}

static void test_while_saving_nothing_changes(void)
{
    assert_asked(PARAMETER_SET, PARAMETER_TRACK, 333, PARAMETER_DONE, 333);
    ask(9, PARAMETER_SAVE, 0, 0);
    step();
    step();
    assert_asked(PARAMETER_SET, PARAMETER_TRACK, 444, PARAMETER_BUSY, 333);
    assert_asked(PARAMETER_RESET, 0, 0, PARAMETER_BUSY, ID);
    assert_asked(PARAMETER_GET, PARAMETER_TRACK, 0, PARAMETER_DONE, 333);
    assert_asked(PARAMETER_GET, PARAMETER_UNSAVED, 0, PARAMETER_DONE, 1);
    await_answer();
    assert_answer(9, PARAMETER_DONE, 0, ID);
    switch_on();
    TEST_ASSERT_EQUAL_UINT16(333, keeper.parameters.value[PARAMETER_TRACK]);
}

static void test_a_save_asked_for_again_is_the_same_save(void)
{
    assert_asked(PARAMETER_SET, PARAMETER_TRACK, 333, PARAMETER_DONE, 333);
    ask(9, PARAMETER_SAVE, 0, 0);
    for (int i = 0; i < 10; i++)
        step();
    save(PARAMETER_DONE);
    TEST_ASSERT_EQUAL(PARAMETERS_RECORD_BYTES, written);
    save(PARAMETER_DONE);
    TEST_ASSERT_EQUAL(PARAMETERS_RECORD_BYTES, written);
}

/* The cells of the second bank that a save has to change. */
static void test_a_cell_that_does_not_hold_ends_the_save(void)
{
    for (int cell = 0; cell < PARAMETERS_RECORD_BYTES; cell++) {
        setUp();
        broken_at = PARAMETERS_BANK_BYTES + cell;
        assert_asked(PARAMETER_SET, PARAMETER_TRACK, 333, PARAMETER_DONE, 333);
        save(PARAMETER_BROKEN);
        assert_asked(PARAMETER_GET, PARAMETER_UNSAVED, 0, PARAMETER_DONE, 1);
        assert_asked(PARAMETER_GET, PARAMETER_EEPROM, 0, PARAMETER_DONE, 1);
        switch_on();
        TEST_ASSERT_EQUAL_UINT16(0, keeper.parameters.value[PARAMETER_TRACK]);
        TEST_ASSERT_EQUAL_UINT16(ID, keeper.parameters.value[PARAMETER_ID]);
    }
}

static void test_a_cell_that_breaks_later_leaves_one_copy(void)
{
    assert_asked(PARAMETER_SET, PARAMETER_TRACK, 333, PARAMETER_DONE, 333);
    save(PARAMETER_DONE);
    broken_at = 1; /* the first bank's sequence */
    assert_asked(PARAMETER_SET, PARAMETER_TRACK, 444, PARAMETER_DONE, 444);
    save(PARAMETER_BROKEN);
    assert_asked(PARAMETER_GET, PARAMETER_EEPROM, 0, PARAMETER_DONE, 1);
    save(PARAMETER_BROKEN);
    switch_on();
    TEST_ASSERT_EQUAL_UINT16(333, keeper.parameters.value[PARAMETER_TRACK]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_parameter_can_be_read);
    RUN_TEST(test_readings);
    RUN_TEST(test_what_is_not_in_the_table_is_unknown);
    RUN_TEST(test_a_value_set_is_in_force_at_once);
    RUN_TEST(test_what_the_table_does_not_allow_is_refused);
    RUN_TEST(test_an_id_stays_while_a_mission_is_under_way);
    RUN_TEST(test_a_reset_keeps_the_id);
    RUN_TEST(test_there_is_room_for_one_answer);
    RUN_TEST(test_what_is_saved_is_there_after_a_power_cycle);
    RUN_TEST(test_saves_take_turns_between_the_banks);
    RUN_TEST(test_the_last_of_many_saves_counts);
    RUN_TEST(test_a_save_that_ends_waits_for_the_answer_before);
    RUN_TEST(test_a_save_cut_short_anywhere_loses_nothing);
    RUN_TEST(test_a_blank_eeprom_can_be_saved_to);
    RUN_TEST(test_with_nothing_to_save_no_byte_is_written);
    RUN_TEST(test_while_saving_nothing_changes);
    RUN_TEST(test_a_save_asked_for_again_is_the_same_save);
    RUN_TEST(test_a_cell_that_does_not_hold_ends_the_save);
    RUN_TEST(test_a_cell_that_breaks_later_leaves_one_copy);
    return UNITY_END();
}
