#include "codec.h"

#include "chip.h"
#include "message_vectors.h"

#include <string.h>
#include <unity.h>

static struct chip chip;

void setUp(void)
{
    chip_start(&chip);
}

void tearDown(void)
{
    chip_stop(&chip);
}

static void assert_sends(const struct message_vector *vector)
{
    uint8_t frame[sizeof vector->frame];

    chip_read(&chip, frame, vector->frame_length);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(vector->frame, frame, vector->frame_length);
}

static void await_known_answers(void)
{
    for (size_t v = 0; v < MESSAGE_VECTORS; v++)
        assert_sends(&message_vectors[v]);
    chip_await_end(&chip);
}

static void test_the_chip_gives_every_known_answer(void)
{
    await_known_answers();
}

static void test_the_chip_reads_every_message(void)
{
    await_known_answers();
    for (size_t v = 0; v < MESSAGE_VECTORS; v++) {
        chip_write(&chip, message_vectors[v].frame, message_vectors[v].frame_length);
        assert_sends(&message_vectors[v]);
    }
}

static void assert_refuses(const struct message_vector *vector, unsigned bit)
{
    uint8_t frame[sizeof vector->frame];
    uint8_t said;

    memcpy(frame, vector->frame, sizeof frame);
    frame[bit / 8] ^= (uint8_t)(1 << bit % 8);
    chip_write(&chip, frame, vector->frame_length);
    chip_read(&chip, &said, 1);
    TEST_ASSERT_EQUAL_HEX8(REFUSED, said);
}

/* A bit that makes a zero makes two bad frames of one: those are left out. */
static bool makes_a_zero(const struct message_vector *vector, unsigned bit)
{
    return vector->frame[bit / 8] == 1 << bit % 8;
}

static void test_the_chip_refuses_every_flipped_bit(void)
{
    await_known_answers();
    for (size_t v = 0; v < MESSAGE_VECTORS; v++)
        for (unsigned bit = 0; bit < 8u * (message_vectors[v].frame_length - 1u); bit++)
            if (!makes_a_zero(&message_vectors[v], bit))
                assert_refuses(&message_vectors[v], bit);
}

int main(int argc, char **argv)
{
    (void)argc;
    chip_path = argv[1];
    UNITY_BEGIN();
    RUN_TEST(test_the_chip_gives_every_known_answer);
    RUN_TEST(test_the_chip_reads_every_message);
    RUN_TEST(test_the_chip_refuses_every_flipped_bit);
    return UNITY_END();
}
