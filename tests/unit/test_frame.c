#include "frame.h"
#include "message_vectors.h"
#include "random.h"

#include <string.h>
#include <unity.h>

static struct frame_decoder decoder;
static uint32_t state;

void setUp(void)
{
    frame_decoder_init(&decoder);
    state = 1;
}

void tearDown(void)
{
}

/* What came out of a run of bytes. */
struct outcome {
    unsigned ready, bad;
    uint8_t length; /* of the last payload */
    uint8_t payload[FRAME_PAYLOAD_MAX];
};

static void feed(struct outcome *outcome, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        switch (frame_decode(&decoder, bytes[i])) {
        case FRAME_READY:
            outcome->ready++;
            outcome->length = decoder.length;
            memcpy(outcome->payload, decoder.payload, decoder.length);
            break;
        case FRAME_BAD: outcome->bad++; break;
        case FRAME_PENDING: break;
        }
    }
}

static void feed_nonzero(struct outcome *outcome, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint8_t noise = (uint8_t)(1 + random_next(&state) % 255);

        feed(outcome, &noise, 1);
    }
}

static void feed_zeros(struct outcome *outcome, size_t count)
{
    static const uint8_t zero;

    for (size_t i = 0; i < count; i++)
        feed(outcome, &zero, 1);
}

static const uint8_t greeting[] = {1, 0, 2, 0, 0, 3};

static void feed_greeting(struct outcome *outcome)
{
    uint8_t frame[FRAME_BYTES_MAX];

    feed(outcome, frame, frame_encode(frame, greeting, sizeof greeting));
}

static void assert_greeting(const struct outcome *outcome)
{
    TEST_ASSERT_EQUAL_UINT8(sizeof greeting, outcome->length);
    TEST_ASSERT_EQUAL_MEMORY(greeting, outcome->payload, sizeof greeting);
}

static void test_the_crc_has_its_check_value(void)
{
    uint16_t crc = CRC16_INITIAL;

    for (const char *c = "123456789"; *c != '\0'; c++)
        crc = crc16_update(crc, (uint8_t)*c);
    TEST_ASSERT_EQUAL_HEX16(0x6F91, crc);
}

static void assert_round_trip(const uint8_t *payload, uint8_t length)
{
    uint8_t frame[FRAME_BYTES_MAX];
    uint8_t bytes = frame_encode(frame, payload, length);
    struct outcome outcome = {0};

    TEST_ASSERT_EQUAL_UINT8(length + FRAME_CRC_BYTES + 2, bytes);
    TEST_ASSERT_EQUAL_PTR(frame + bytes - 1, memchr(frame, 0, bytes));
    feed(&outcome, frame, bytes);
    TEST_ASSERT_EQUAL(1, outcome.ready);
    TEST_ASSERT_EQUAL(0, outcome.bad);
    TEST_ASSERT_EQUAL_UINT8(length, outcome.length);
    TEST_ASSERT_EQUAL_MEMORY(payload, outcome.payload, length);
}

static void test_payloads_of_every_length_come_back(void)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];

    for (uint8_t length = 1; length <= FRAME_PAYLOAD_MAX; length++) {
        memset(payload, 0, sizeof payload);
        assert_round_trip(payload, length);
        memset(payload, 0xFF, sizeof payload);
        assert_round_trip(payload, length);
        for (int round = 0; round < 100; round++) {
            for (uint8_t i = 0; i < length; i++)
                payload[i] = (uint8_t)(random_next(&state) % 3); /* zeros everywhere */
            assert_round_trip(payload, length);
        }
    }
}

static void test_lengths_out_of_range_are_refused(void)
{
    uint8_t frame[FRAME_BYTES_MAX];
    uint8_t payload[FRAME_PAYLOAD_MAX + 1] = {0};

    TEST_ASSERT_EQUAL_UINT8(0, frame_encode(frame, payload, 0));
    TEST_ASSERT_EQUAL_UINT8(0, frame_encode(frame, payload, FRAME_PAYLOAD_MAX + 1));
}

/* Whatever one byte becomes, the message never comes out changed, and the one after the next
 * zero always comes out. */
static void assert_corruption_caught(const struct message_vector *vector, uint8_t at, uint8_t flip)
{
    uint8_t frame[sizeof vector->frame];
    struct outcome outcome = {0};

    memcpy(frame, vector->frame, sizeof frame);
    frame[at] ^= flip;
    feed(&outcome, frame, vector->frame_length);
    TEST_ASSERT_EQUAL(0, outcome.ready);
    feed_zeros(&outcome, 1);
    TEST_ASSERT_EQUAL(0, outcome.ready);
    TEST_ASSERT_NOT_EQUAL(0, outcome.bad);
    feed_greeting(&outcome);
    TEST_ASSERT_EQUAL(1, outcome.ready);
    assert_greeting(&outcome);
}

static void test_every_corruption_of_one_byte_is_caught(void)
{
    for (size_t v = 0; v < MESSAGE_VECTORS; v++)
        /* The delimiter's turn comes below: without it the message is not over. */
        for (uint8_t at = 0; at < message_vectors[v].frame_length - 1; at++)
            for (unsigned flip = 1; flip < 256; flip++)
                assert_corruption_caught(&message_vectors[v], at, (uint8_t)flip);
}

static void test_a_damaged_delimiter_costs_both_its_messages_and_no_more(void)
{
    for (unsigned noise = 1; noise < 256; noise++) {
        uint8_t frame[FRAME_BYTES_MAX];
        uint8_t bytes = frame_encode(frame, greeting, sizeof greeting);
        struct outcome outcome = {0};

        frame[bytes - 1] = (uint8_t)noise;
        feed(&outcome, frame, bytes);
        feed_greeting(&outcome);
        TEST_ASSERT_EQUAL(0, outcome.ready);
        TEST_ASSERT_EQUAL(1, outcome.bad);
        feed_greeting(&outcome);
        TEST_ASSERT_EQUAL(1, outcome.ready);
        assert_greeting(&outcome);
    }
}

static void test_noise_costs_at_most_the_message_it_touches(void)
{
    for (int round = 0; round < 1000; round++) {
        struct outcome outcome = {0};

        feed_nonzero(&outcome, random_next(&state) % 80);
        feed_greeting(&outcome);
        outcome.ready = 0;
        feed_greeting(&outcome);
        TEST_ASSERT_EQUAL(1, outcome.ready);
        assert_greeting(&outcome);
    }
}

static void test_a_lost_byte_is_caught(void)
{
    for (size_t v = 0; v < MESSAGE_VECTORS; v++) {
        const struct message_vector *vector = &message_vectors[v];

        for (uint8_t lost = 0; lost < vector->frame_length - 1; lost++) {
            struct outcome outcome = {0};

            feed(&outcome, vector->frame, lost);
            feed(&outcome, vector->frame + lost + 1, vector->frame_length - lost - 1u);
            TEST_ASSERT_EQUAL(0, outcome.ready);
            TEST_ASSERT_EQUAL(1, outcome.bad);
            feed_greeting(&outcome);
            assert_greeting(&outcome);
        }
    }
}

static void test_a_message_cut_short_is_caught(void)
{
    for (size_t v = 0; v < MESSAGE_VECTORS; v++) {
        const struct message_vector *vector = &message_vectors[v];

        for (uint8_t cut = 1; cut < vector->frame_length - 1; cut++) {
            struct outcome outcome = {0};

            feed(&outcome, vector->frame, cut);
            feed_zeros(&outcome, 1);
            TEST_ASSERT_EQUAL(0, outcome.ready);
            TEST_ASSERT_EQUAL(1, outcome.bad);
        }
    }
}

static void test_what_is_too_long_is_one_bad_frame(void)
{
    struct outcome outcome = {0};

    feed_nonzero(&outcome, 1000);
    feed_zeros(&outcome, 1);
    TEST_ASSERT_EQUAL(0, outcome.ready);
    TEST_ASSERT_EQUAL(1, outcome.bad);
    feed_greeting(&outcome);
    assert_greeting(&outcome);
}

/* A good message of full length with one byte more behind it, all of it proper COBS. */
static void test_one_byte_too_many_is_bad(void)
{
    uint8_t frame[FRAME_BYTES_MAX + 1];
    uint8_t payload[FRAME_PAYLOAD_MAX];
    struct outcome outcome = {0};
    uint8_t end;

    memset(payload, 0x55, sizeof payload);
    end = frame_encode(frame, payload, sizeof payload);
    TEST_ASSERT_EQUAL_UINT8(end - 1, frame[0]); /* no zero in it, CRC included */
    frame[0]++;
    frame[end - 1] = 0x55;
    frame[end] = 0;
    feed(&outcome, frame, end + 1u);
    TEST_ASSERT_EQUAL(0, outcome.ready);
    TEST_ASSERT_EQUAL(1, outcome.bad);
}

static void test_zeros_between_messages_mean_nothing(void)
{
    struct outcome outcome = {0};

    feed_zeros(&outcome, 10);
    feed_greeting(&outcome);
    feed_zeros(&outcome, 10);
    feed_greeting(&outcome);
    TEST_ASSERT_EQUAL(2, outcome.ready);
    TEST_ASSERT_EQUAL(0, outcome.bad);
}

static void test_an_empty_message_is_bad(void)
{
    static const uint8_t no_payload[] = {3, 0xFF, 0xFF, 0}; /* only the CRC of nothing */
    static const uint8_t not_even_a_crc[] = {1, 0};
    struct outcome outcome = {0};

    feed(&outcome, no_payload, sizeof no_payload);
    feed(&outcome, not_even_a_crc, sizeof not_even_a_crc);
    TEST_ASSERT_EQUAL(0, outcome.ready);
    TEST_ASSERT_EQUAL(2, outcome.bad);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_crc_has_its_check_value);
    RUN_TEST(test_payloads_of_every_length_come_back);
    RUN_TEST(test_lengths_out_of_range_are_refused);
    RUN_TEST(test_every_corruption_of_one_byte_is_caught);
    RUN_TEST(test_a_damaged_delimiter_costs_both_its_messages_and_no_more);
    RUN_TEST(test_noise_costs_at_most_the_message_it_touches);
    RUN_TEST(test_a_lost_byte_is_caught);
    RUN_TEST(test_a_message_cut_short_is_caught);
    RUN_TEST(test_what_is_too_long_is_one_bad_frame);
    RUN_TEST(test_one_byte_too_many_is_bad);
    RUN_TEST(test_zeros_between_messages_mean_nothing);
    RUN_TEST(test_an_empty_message_is_bad);
    return UNITY_END();
}
