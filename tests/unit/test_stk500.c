#include "stk500.h"

#include "random.h"

#include <string.h>
#include <unity.h>

#define BAUD 115200

static struct stk500 client;

void setUp(void)
{
    stk500_begin(&client, BAUD);
}

void tearDown(void)
{
}

/* As Atmel's programmers speak, byte for byte. */
static const uint8_t sign_on_message[] = {0x1B, 0x01, 0x00, 0x01, 0x0E, 0x01, 0x14};
static const uint8_t sign_on_answer[] = {
    0x1B, 0x01, 0x00, 0x0B, 0x0E, 0x01, 0x00, 0x08, 'A', 'V', 'R', 'I', 'S', 'P', '_', '2', 0x74,
};

/* How many answers there are in them. */
static unsigned take(const uint8_t *bytes, size_t count)
{
    unsigned answers = 0;

    for (size_t i = 0; i < count; i++)
        answers += stk500_take(&client, bytes[i]);
    return answers;
}

static size_t send_all(uint8_t *bytes, int64_t now_us)
{
    return stk500_send(&client, now_us, bytes, STK500_MESSAGE_MAX);
}

static void test_a_request_is_written_as_programmers_write_it(void)
{
    uint8_t bytes[STK500_MESSAGE_MAX];

    stk500_sign_on(&client);
    TEST_ASSERT_EQUAL_UINT64(sizeof sign_on_message, send_all(bytes, 0));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(sign_on_message, bytes, sizeof sign_on_message);
    TEST_ASSERT_EQUAL_UINT64(0, send_all(bytes, 0));
}

static void test_the_longest_request_has_its_length_in_two_bytes(void)
{
    uint8_t bytes[STK500_MESSAGE_MAX], body[STK500_BODY_MAX] = {STK500_PROGRAM_FLASH};

    stk500_ask(&client, body, sizeof body, 2);
    TEST_ASSERT_EQUAL_UINT64(STK500_MESSAGE_MAX, send_all(bytes, 0));
    TEST_ASSERT_EQUAL_HEX8(0x01, bytes[2]);
    TEST_ASSERT_EQUAL_HEX8(0x0A, bytes[3]);
}

static void test_its_answer_is_taken_once(void)
{
    stk500_sign_on(&client);
    TEST_ASSERT_EQUAL_UINT(0, take(sign_on_answer, sizeof sign_on_answer - 1));
    TEST_ASSERT_EQUAL_UINT(1, take(sign_on_answer + sizeof sign_on_answer - 1, 1));
    TEST_ASSERT_EQUAL_UINT16(11, client.reader.length);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(sign_on_answer + 5, client.reader.body, 11);
    TEST_ASSERT_EQUAL_UINT(0, take(sign_on_answer, sizeof sign_on_answer));
}

static void test_a_refusal_is_an_answer(void)
{
    uint8_t answer[STK500_MESSAGE_MAX];
    const uint8_t body[] = {STK500_READ_FLASH, 1, 0, 0x20}, refusal[] = {STK500_READ_FLASH, 0xC0};

    stk500_ask(&client, body, sizeof body, 259);
    TEST_ASSERT_EQUAL_UINT(1, take(answer, stk500_write(answer, 1, refusal, sizeof refusal)));
    TEST_ASSERT_FALSE(stk500_agreed(&client));
}

/* Those of an earlier request, of another command, too short for what was asked. */
static void test_other_answers_are_passed_over(void)
{
    uint8_t answer[STK500_MESSAGE_MAX];
    const uint8_t other[] = {STK500_LOAD_ADDRESS, STK500_OK};
    const uint8_t shorter[] = {STK500_SIGN_ON, STK500_OK};

    stk500_sign_on(&client);
    stk500_sign_on(&client);
    TEST_ASSERT_EQUAL_UINT(0, take(sign_on_answer, sizeof sign_on_answer));
    TEST_ASSERT_EQUAL_UINT(0, take(answer, stk500_write(answer, 2, other, sizeof other)));
    TEST_ASSERT_EQUAL_UINT(0, take(answer, stk500_write(answer, 2, shorter, sizeof shorter)));
    TEST_ASSERT_EQUAL_UINT(1, take(answer, stk500_write(answer, 2, sign_on_answer + 5, 11)));
}

static void test_a_changed_byte_makes_it_none(void)
{
    for (size_t i = 0; i < sizeof sign_on_answer; i++) {
        uint8_t answer[sizeof sign_on_answer];

        setUp();
        stk500_sign_on(&client);
        memcpy(answer, sign_on_answer, sizeof answer);
        answer[i] ^= 0x40;
        TEST_ASSERT_EQUAL_UINT(0, take(answer, sizeof answer));
    }
}

static void test_noise_before_an_answer_costs_nothing_without_a_start(void)
{
    static const uint8_t noise[] = {0x00, 0x0E, 0xFF, 0x01};

    stk500_sign_on(&client);
    TEST_ASSERT_EQUAL_UINT(0, take(noise, sizeof noise));
    TEST_ASSERT_EQUAL_UINT(1, take(sign_on_answer, sizeof sign_on_answer));
}

/* A false start swallows what follows, until it is asked again. */
static void test_asking_again_begins_afresh(void)
{
    static const uint8_t start[] = {0x1B, 0x01, 0x01, 0x00, 0x0E};
    uint8_t answer[STK500_MESSAGE_MAX];

    stk500_sign_on(&client);
    TEST_ASSERT_EQUAL_UINT(0, take(start, sizeof start));
    stk500_sign_on(&client);
    TEST_ASSERT_EQUAL_UINT(1, take(answer, stk500_write(answer, 2, sign_on_answer + 5, 11)));
}

static void test_lengths_that_are_none_are_not_waited_for(void)
{
    static const uint8_t none[] = {0x1B, 0x01, 0x00, 0x00};
    static const uint8_t huge[] = {0x1B, 0x01, 0x01, 0x0B};

    stk500_sign_on(&client);
    TEST_ASSERT_EQUAL_UINT(0, take(none, sizeof none));
    TEST_ASSERT_EQUAL_UINT(0, take(huge, sizeof huge));
    TEST_ASSERT_EQUAL_UINT(1, take(sign_on_answer, sizeof sign_on_answer));
}

static void test_it_is_late_when_bytes_radio_and_loader_have_had_their_time(void)
{
    uint8_t bytes[STK500_MESSAGE_MAX], body[STK500_BODY_MAX] = {STK500_PROGRAM_FLASH};
    int64_t line_us = (STK500_MESSAGE_MAX + STK500_FRAME_BYTES + 2) * 10 * 1000000ll / BAUD;

    stk500_ask(&client, body, sizeof body, 2);
    TEST_ASSERT_FALSE(stk500_late(&client, 1000000000)); /* nothing is sent yet */
    stk500_send(&client, 0, bytes, 100);
    TEST_ASSERT_FALSE(stk500_late(&client, 1000000000));
    send_all(bytes, 1000);
    TEST_ASSERT_FALSE(stk500_late(&client, 1000 + line_us + 150000));
    TEST_ASSERT_TRUE(stk500_late(&client, 1000 + line_us + 300000));
    stk500_forget(&client);
    TEST_ASSERT_FALSE(stk500_late(&client, 1000000000));
}

static void test_a_request_goes_out_in_any_pieces(void)
{
    uint8_t bytes[STK500_MESSAGE_MAX + 1];
    size_t count = 0;

    stk500_sign_on(&client);
    for (int i = 0; i < 7; i++) {
        bytes[count + 1] = 0xEE;
        TEST_ASSERT_EQUAL_UINT64(0, stk500_send(&client, 0, bytes + count, 0));
        count += stk500_send(&client, 0, bytes + count, 1);
        TEST_ASSERT_EQUAL_HEX8(0xEE, bytes[count]); /* beyond the room */
    }
    TEST_ASSERT_EQUAL_HEX8_ARRAY(sign_on_message, bytes, sizeof sign_on_message);
}

static void test_whatever_is_written_is_read(void)
{
    struct stk500_reader reader = {0};
    uint8_t message[STK500_MESSAGE_MAX], body[STK500_BODY_MAX];
    uint32_t state = 1;

    for (uint16_t length = 1; length <= STK500_BODY_MAX; length++) {
        unsigned whole = 0;

        for (uint16_t i = 0; i < length; i++)
            body[i] = (uint8_t)random_next(&state);
        uint16_t count = stk500_write(message, (uint8_t)length, body, length);
        for (uint16_t i = 0; i < count; i++)
            whole += stk500_read(&reader, message[i]);
        TEST_ASSERT_EQUAL_UINT(1, whole);
        TEST_ASSERT_EQUAL_UINT16(length, reader.length);
        TEST_ASSERT_EQUAL_UINT8((uint8_t)length, reader.sequence);
        TEST_ASSERT_EQUAL_HEX8_ARRAY(body, reader.body, length);
    }
}

static void says(const uint8_t *bytes, size_t count)
{
    uint8_t sent[STK500_MESSAGE_MAX];
    size_t length = send_all(sent, 0);

    TEST_ASSERT_EQUAL_UINT64(STK500_FRAME_BYTES + count, length);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(bytes, sent + 5, count);
}

#define SAYS(...) says((const uint8_t[]){__VA_ARGS__}, sizeof((const uint8_t[]){__VA_ARGS__}))

/* By AVR068, and as avrdude asks an ATmega128. */
static void test_requests_are_those_of_the_application_note(void)
{
    uint8_t page[256],
        programmed[10 + sizeof page] = {0x13, 0x01, 0x00, 0xC1, 10, 0x40, 0x4C, 0x20};

    memset(page, 0xA5, sizeof page);
    memset(programmed + 10, 0xA5, sizeof page);
    stk500_sign_on(&client);
    SAYS(0x01);
    stk500_enter_progmode(&client);
    SAYS(0x10, 200, 100, 25, 32, 0, 0x53, 3, 0xAC, 0x53, 0, 0);
    stk500_read_signature(&client, 2);
    SAYS(0x1D, 4, 4, 0, 0x30, 0, 2, 0);
    stk500_load_address(&client, 0xFB00);
    SAYS(0x06, 0, 0, 0x7D, 0x80);
    stk500_read_flash(&client, 256);
    SAYS(0x14, 0x01, 0x00, 0x20);
    stk500_program_flash(&client, page, sizeof page);
    says(programmed, sizeof programmed);
    stk500_leave_progmode(&client);
    SAYS(0x11, 1, 1);
}

static void test_answers_hold_what_was_asked_for(void)
{
    uint8_t answer[STK500_MESSAGE_MAX], flash[3 + 4] = {0x14, 0, 1, 2, 3, 4, 0};
    const uint8_t signature[] = {0x1D, 0, 0, 0x30, 0, 0x97, 0};

    stk500_read_signature(&client, 1);
    TEST_ASSERT_EQUAL_UINT(1, take(answer, stk500_write(answer, 1, signature, sizeof signature)));
    TEST_ASSERT_TRUE(stk500_agreed(&client));
    TEST_ASSERT_EQUAL_HEX8(0x97, stk500_signature(&client));
    stk500_read_flash(&client, 4);
    TEST_ASSERT_EQUAL_UINT(1, take(answer, stk500_write(answer, 2, flash, sizeof flash)));
    TEST_ASSERT_TRUE(stk500_agreed(&client));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(flash + 2, stk500_flash(&client), 4);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_request_is_written_as_programmers_write_it);
    RUN_TEST(test_the_longest_request_has_its_length_in_two_bytes);
    RUN_TEST(test_its_answer_is_taken_once);
    RUN_TEST(test_a_refusal_is_an_answer);
    RUN_TEST(test_other_answers_are_passed_over);
    RUN_TEST(test_a_changed_byte_makes_it_none);
    RUN_TEST(test_noise_before_an_answer_costs_nothing_without_a_start);
    RUN_TEST(test_asking_again_begins_afresh);
    RUN_TEST(test_lengths_that_are_none_are_not_waited_for);
    RUN_TEST(test_it_is_late_when_bytes_radio_and_loader_have_had_their_time);
    RUN_TEST(test_a_request_goes_out_in_any_pieces);
    RUN_TEST(test_whatever_is_written_is_read);
    RUN_TEST(test_requests_are_those_of_the_application_note);
    RUN_TEST(test_answers_hold_what_was_asked_for);
    return UNITY_END();
}
