#include "message.h"

#include "message_vectors.h"

#include <stdio.h>
#include <string.h>
#include <unity.h>

/* The payload of a vector's frame. */
struct payload {
    uint8_t length;
    uint8_t bytes[FRAME_PAYLOAD_MAX];
};

void setUp(void)
{
}

void tearDown(void)
{
}

static struct payload payload_of(uint8_t type)
{
    struct payload payload = {0};
    struct frame_decoder decoder;

    frame_decoder_init(&decoder);
    for (size_t v = 0; v < MESSAGE_VECTORS; v++)
        for (uint8_t i = 0;
             message_vectors[v].message.type == type && i < message_vectors[v].frame_length; i++)
            if (frame_decode(&decoder, message_vectors[v].frame[i]) == FRAME_READY) {
                payload.length = decoder.length;
                memcpy(payload.bytes, decoder.payload, decoder.length);
            }
    TEST_ASSERT_NOT_EQUAL(0, payload.length);
    return payload;
}

static bool readable(const struct payload *payload)
{
    struct message message;

    return message_read(&message, payload->bytes, payload->length);
}

static void test_every_message_has_its_known_answer(void)
{
    for (size_t v = 0; v < MESSAGE_VECTORS; v++) {
        uint8_t payload[FRAME_PAYLOAD_MAX];
        uint8_t frame[FRAME_BYTES_MAX];
        uint8_t length = message_write(payload, &message_vectors[v].message);

        TEST_ASSERT_EQUAL_UINT8(message_vectors[v].frame_length,
                                frame_encode(frame, payload, length));
        TEST_ASSERT_EQUAL_HEX8_ARRAY(message_vectors[v].frame, frame,
                                     message_vectors[v].frame_length);
    }
}

/* docs/PROTOCOL.md, found from where this source lies. */
static char *read_document(void)
{
    static const char here[] = __FILE__;
    static char text[65536];
    char path[sizeof here + 32] = "";
    FILE *file;

    memcpy(path, here, (size_t)(strrchr(here, '/') - here));
    strcat(path, "/../../docs/PROTOCOL.md");
    file = fopen(path, "r");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

static void test_the_document_gives_the_same_answers(void)
{
    char *document = read_document();

    for (size_t v = 0; v < MESSAGE_VECTORS; v++) {
        char line[3 * sizeof message_vectors[v].frame + 8] = "\n   ";

        for (uint8_t i = 0; i < message_vectors[v].frame_length; i++)
            sprintf(line + strlen(line), " %02X", message_vectors[v].frame[i]);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(document, strcat(line, "\n")), line);
    }
}

/* With commas between thousands. */
static const char *with_commas(char text[8], unsigned number)
{
    if (number < 1000)
        snprintf(text, 8, "%u", number);
    else
        snprintf(text, 8, "%u,%03u", number / 1000 % 1000, number % 1000);
    return text;
}

static void assert_parameter(unsigned index, const char *name, const char *unit, unsigned per_unit,
                             unsigned low, unsigned high, unsigned unless_set)
{
    char row[160], per[8], from[8], to[8], set[8];
    bool has_unit = unit[0] != '\0';

    snprintf(row, sizeof row, "\n| %u | %s | %s%s%s | %s, %s | %s | ", index, name,
             with_commas(per, per_unit), has_unit ? " / " : "", unit, with_commas(from, low),
             with_commas(to, high), with_commas(set, unless_set));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(read_document(), row), row);
}

static void assert_reading(unsigned index, const char *name)
{
    char row[80];

    snprintf(row, sizeof row, "\n| %u | %s | 1 | read only | | ", index, name);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(read_document(), row), row);
}

#define ASSERT_PARAMETER(symbol, name, unit, per_unit, low, high, unless_set, what)                \
    assert_parameter(PARAMETER_##symbol, name, unit, per_unit, low, high, unless_set);
#define ASSERT_READING(symbol, name, unit, per_unit, what) assert_reading(PARAMETER_##symbol, name);

static void test_the_document_has_every_parameter(void)
{
    PARAMETERS_STORED(ASSERT_PARAMETER)
    PARAMETER_READINGS(ASSERT_READING)
}

/* Only if every field was read does writing them again give the same bytes. */
static void test_what_was_read_is_what_was_written(void)
{
    for (size_t v = 0; v < MESSAGE_VECTORS; v++) {
        struct payload payload = payload_of(message_vectors[v].message.type);
        uint8_t again[FRAME_PAYLOAD_MAX];
        struct message message;

        memset(&message, 0xA5, sizeof message);
        TEST_ASSERT_TRUE(message_read(&message, payload.bytes, payload.length));
        TEST_ASSERT_EQUAL_UINT8(payload.length, message_write(again, &message));
        TEST_ASSERT_EQUAL_HEX8_ARRAY(payload.bytes, again, payload.length);
    }
}

static void test_a_short_message_is_refused(void)
{
    for (size_t v = 0; v < MESSAGE_VECTORS; v++) {
        struct payload payload = payload_of(message_vectors[v].message.type);

        while (payload.length-- > 0)
            TEST_ASSERT_FALSE(readable(&payload));
    }
}

static void test_appended_bytes_are_ignored(void)
{
    for (size_t v = 0; v < MESSAGE_VECTORS; v++) {
        struct payload payload = payload_of(message_vectors[v].message.type);
        struct message message;
        uint8_t again[FRAME_PAYLOAD_MAX];
        uint8_t length = payload.length;

        memset(payload.bytes + length, 0xA5, FRAME_PAYLOAD_MAX - length);
        payload.length = FRAME_PAYLOAD_MAX;
        TEST_ASSERT_TRUE(message_read(&message, payload.bytes, payload.length));
        TEST_ASSERT_EQUAL_UINT8(length, message_write(again, &message));
        TEST_ASSERT_EQUAL_HEX8_ARRAY(payload.bytes, again, length);
    }
}

static void test_an_unknown_type_is_no_error(void)
{
    static const uint8_t newer[] = {0x7E, 1, 2, 3};
    struct message message;

    TEST_ASSERT_TRUE(message_read(&message, newer, sizeof newer));
    TEST_ASSERT_EQUAL_HEX8(0x7E, message.type);
}

/* Is the message of this type still readable with the byte at `at` set to `value`? */
static bool readable_with(uint8_t type, uint8_t at, uint8_t value)
{
    struct payload payload = payload_of(type);

    payload.bytes[at] = value;
    return readable(&payload);
}

static void test_a_mission_out_of_range_is_refused(void)
{
    TEST_ASSERT_FALSE(readable_with(MESSAGE_MISSION, 1, 1)); /* not number 0 of its count */
    TEST_ASSERT_FALSE(readable_with(MESSAGE_MISSION, 3, 0)); /* mission 0 is none */
    TEST_ASSERT_FALSE(readable_with(MESSAGE_MISSION, 5, LAW_PID + 1));
    TEST_ASSERT_FALSE(readable_with(MESSAGE_MISSION, 6, ALLOCATION_ASSIGNED + 1));
    for (uint8_t high = 12; high <= 18; high += 2) /* v_max, omega_max, track, wheel_max < 0 */
        TEST_ASSERT_FALSE(readable_with(MESSAGE_MISSION, high, 0x80));
    TEST_ASSERT_TRUE(readable_with(MESSAGE_MISSION, 5, LAW_PID));
    TEST_ASSERT_TRUE(readable_with(MESSAGE_MISSION, 6, ALLOCATION_ASSIGNED));
}

static void test_vertices_out_of_range_are_refused(void)
{
    TEST_ASSERT_FALSE(readable_with(MESSAGE_VERTICES, 2, 0));  /* formation 0 is none */
    TEST_ASSERT_FALSE(readable_with(MESSAGE_VERTICES, 3, 10)); /* scale */
    TEST_ASSERT_FALSE(readable_with(MESSAGE_VERTICES, 4, 3));  /* fewer in all than in here */
    TEST_ASSERT_FALSE(readable_with(MESSAGE_VERTICES, 6, 1));  /* the last one beyond the total */
    TEST_ASSERT_FALSE(readable_with(MESSAGE_VERTICES, 8, 0));
    TEST_ASSERT_FALSE(readable_with(MESSAGE_VERTICES, 8, 5)); /* more than there are bytes for */
    TEST_ASSERT_FALSE(readable_with(MESSAGE_VERTICES, 8, VERTICES_PER_MESSAGE + 1));
    TEST_ASSERT_TRUE(readable_with(MESSAGE_VERTICES, 3, 9));
}

static void test_the_largest_vertices_message_fits(void)
{
    struct message message = {.type = MESSAGE_VERTICES,
                              .vertices = {.formation = 1, .total = 128, .first = 120, .count = 8}};
    uint8_t payload[FRAME_PAYLOAD_MAX];

    TEST_ASSERT_EQUAL_UINT8(49, message_write(payload, &message));
    TEST_ASSERT_TRUE(message_read(&message, payload, 49));
}

static void test_a_knot_before_the_start_is_refused(void)
{
    TEST_ASSERT_FALSE(readable_with(MESSAGE_KNOT, 5, 0x80));
}

static void test_a_drive_out_of_range_is_refused(void)
{
    TEST_ASSERT_FALSE(readable_with(MESSAGE_DRIVE, 2, 0x40));
    TEST_ASSERT_FALSE(readable_with(MESSAGE_DRIVE, 4, 0x80));
    TEST_ASSERT_TRUE(readable_with(MESSAGE_DRIVE, 2, 0x3F));
    TEST_ASSERT_TRUE(readable_with(MESSAGE_DRIVE, 5, 0xFE)); /* bits of a later version */
}

static void test_a_beacon_from_nobody_is_refused(void)
{
    struct payload beacon = payload_of(MESSAGE_BEACON);

    TEST_ASSERT_FALSE(readable_with(MESSAGE_BEACON, 1, 0)); /* id 0 */
    TEST_ASSERT_FALSE(readable_with(MESSAGE_BEACON, 17, ROLE_FOLLOWER + 1));
    beacon.bytes[1] = beacon.bytes[2] = 0xFF;
    TEST_ASSERT_FALSE(readable(&beacon));
}

static void test_a_beacons_flags_are_told_apart(void)
{
    const struct {
        uint8_t bits;
        bool candidate, fault, to_all;
    } cases[] = {{4, true, false, false}, {8, false, true, false}, {16, false, false, true}, {0}};

    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct payload payload = payload_of(MESSAGE_BEACON);
        struct message message;

        payload.bytes[17] = cases[i].bits | ROLE_FOLLOWER;
        TEST_ASSERT_TRUE(message_read(&message, payload.bytes, payload.length));
        TEST_ASSERT_EQUAL(ROLE_FOLLOWER, message.beacon.role);
        TEST_ASSERT_EQUAL(cases[i].candidate, message.beacon.candidate);
        TEST_ASSERT_EQUAL(cases[i].fault, message.beacon.fault);
        TEST_ASSERT_EQUAL(cases[i].to_all, message.beacon.to_all);
    }
}

/* Every speed that is read can be negated. */
static void test_the_lowest_number_is_read_as_its_neighbour(void)
{
    struct payload payload = payload_of(MESSAGE_BEACON);
    struct message message;

    payload.bytes[13] = 0x00;
    payload.bytes[14] = 0x80;
    TEST_ASSERT_TRUE(message_read(&message, payload.bytes, payload.length));
    TEST_ASSERT_EQUAL_INT16(-32767, message.beacon.v);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_message_has_its_known_answer);
    RUN_TEST(test_the_document_gives_the_same_answers);
    RUN_TEST(test_the_document_has_every_parameter);
    RUN_TEST(test_what_was_read_is_what_was_written);
    RUN_TEST(test_a_short_message_is_refused);
    RUN_TEST(test_appended_bytes_are_ignored);
    RUN_TEST(test_an_unknown_type_is_no_error);
    RUN_TEST(test_a_mission_out_of_range_is_refused);
    RUN_TEST(test_vertices_out_of_range_are_refused);
    RUN_TEST(test_the_largest_vertices_message_fits);
    RUN_TEST(test_a_knot_before_the_start_is_refused);
    RUN_TEST(test_a_drive_out_of_range_is_refused);
    RUN_TEST(test_a_beacon_from_nobody_is_refused);
    RUN_TEST(test_a_beacons_flags_are_told_apart);
    RUN_TEST(test_the_lowest_number_is_read_as_its_neighbour);
    return UNITY_END();
}
