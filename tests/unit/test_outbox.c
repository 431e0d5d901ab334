#include "outbox.h"

#include "random.h"

#include <string.h>
#include <unity.h>

static struct outbox outbox;

void setUp(void)
{
    memset(&outbox, 0, sizeof outbox);
}

void tearDown(void)
{
}

/* A frame that says who sent it and which of its beacons it is. */
static struct beacon_frame beacon_of(uint16_t sender, uint8_t number)
{
    uint8_t payload[] = {(uint8_t)sender, (uint8_t)(sender >> 8), number, 0, 0, 7, 8, 9};
    uint8_t bytes[FRAME_BYTES_MAX];
    struct beacon_frame beacon = {.sender = sender};

    beacon.length = frame_encode(bytes, payload, sizeof payload);
    memcpy(beacon.bytes, bytes, beacon.length);
    return beacon;
}

static void put(uint16_t sender, uint8_t number)
{
    struct beacon_frame beacon = beacon_of(sender, number);

    outbox_put_beacon(&outbox, &beacon);
}

/* What a robot makes of the bytes. */
struct listener {
    struct frame_decoder decoder;
    unsigned count, bad;
    uint16_t sender[1000];
    uint8_t number[1000];
};

static void listen(struct listener *listener, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        enum frame_event event = frame_decode(&listener->decoder, bytes[i]);
        const uint8_t *payload = listener->decoder.payload;

        if (event == FRAME_READY) {
            listener->sender[listener->count] = (uint16_t)(payload[0] | payload[1] << 8);
            listener->number[listener->count++] = payload[2];
        }
        listener->bad += event == FRAME_BAD;
    }
}

static void listener_init(struct listener *listener)
{
    memset(listener, 0, sizeof *listener);
    frame_decoder_init(&listener->decoder);
}

/* One tick with room for `most` bytes. */
static size_t take(struct listener *listener, size_t most)
{
    uint8_t bytes[8192 + BEACON_FRAME_MAX];
    struct outbox_room room = {bytes, most};

    memset(bytes + most, 0xEE, BEACON_FRAME_MAX);
    outbox_resume(&outbox, &room);
    outbox_send_beacons(&outbox, &room);
    for (size_t i = 0; i < BEACON_FRAME_MAX; i++)
        TEST_ASSERT_EQUAL_HEX8(0xEE, bytes[most + i]); /* beyond the room */
    listen(listener, bytes, most - room.left);
    return most - room.left;
}

static void test_beacons_leave_in_the_order_of_their_arrival(void)
{
    struct listener listener;

    listener_init(&listener);
    put(30, 1);
    put(10, 2);
    put(20, 3);
    take(&listener, 8192);
    TEST_ASSERT_EQUAL_UINT(3, listener.count);
    TEST_ASSERT_EQUAL_UINT16(30, listener.sender[0]);
    TEST_ASSERT_EQUAL_UINT16(10, listener.sender[1]);
    TEST_ASSERT_EQUAL_UINT16(20, listener.sender[2]);
    TEST_ASSERT_EQUAL_UINT64(3, outbox.frames);
    TEST_ASSERT_EQUAL_UINT64(0, outbox.dropped);
}

static void test_a_newer_beacon_takes_the_place_of_its_senders_older_one(void)
{
    struct listener listener;

    listener_init(&listener);
    put(1, 1);
    put(2, 2);
    put(1, 3);
    take(&listener, 8192);
    TEST_ASSERT_EQUAL_UINT(2, listener.count);
    TEST_ASSERT_EQUAL_UINT16(1, listener.sender[0]);
    TEST_ASSERT_EQUAL_UINT8(3, listener.number[0]);
    TEST_ASSERT_EQUAL_UINT16(2, listener.sender[1]);
    TEST_ASSERT_EQUAL_UINT64(1, outbox.dropped);
}

static void test_a_full_box_drops_newcomers_and_counts(void)
{
    struct listener listener;

    listener_init(&listener);
    for (uint16_t sender = 1; sender <= OUTBOX_BEACONS + 5; sender++)
        put(sender, 1);
    TEST_ASSERT_EQUAL_UINT64(5, outbox.dropped);
    put(OUTBOX_BEACONS, 2); /* has its place */
    take(&listener, 8192);
    TEST_ASSERT_EQUAL_UINT(OUTBOX_BEACONS, listener.count);
    for (uint16_t i = 0; i < OUTBOX_BEACONS; i++)
        TEST_ASSERT_EQUAL_UINT16(i + 1, listener.sender[i]);
    TEST_ASSERT_EQUAL_UINT8(2, listener.number[OUTBOX_BEACONS - 1]);
}

static void test_a_cut_frame_goes_on_in_the_next_tick(void)
{
    for (size_t room = 1; room < 40; room++) {
        struct listener listener;
        unsigned ticks = 0;

        setUp();
        listener_init(&listener);
        for (uint16_t sender = 1; sender <= 20; sender++)
            put(sender, (uint8_t)sender);
        while (take(&listener, room) == room)
            ticks++;
        TEST_ASSERT_EQUAL_UINT(20 * beacon_of(1, 1).length / room, ticks);
        TEST_ASSERT_EQUAL_UINT(0, listener.bad);
        TEST_ASSERT_EQUAL_UINT(20, listener.count);
        for (uint16_t i = 0; i < 20; i++)
            TEST_ASSERT_EQUAL_UINT16(i + 1, listener.sender[i]);
        TEST_ASSERT_EQUAL_UINT64(20, outbox.frames);
    }
}

static void test_a_newer_beacon_leaves_the_rest_of_a_cut_one_alone(void)
{
    struct listener listener;

    listener_init(&listener);
    put(1, 1);
    take(&listener, 5);
    put(1, 2);
    take(&listener, 8192);
    TEST_ASSERT_EQUAL_UINT(0, listener.bad);
    TEST_ASSERT_EQUAL_UINT(2, listener.count);
    TEST_ASSERT_EQUAL_UINT8(1, listener.number[0]);
    TEST_ASSERT_EQUAL_UINT8(2, listener.number[1]);
    TEST_ASSERT_EQUAL_UINT64(0, outbox.dropped);
}

static void test_the_longest_frame_can_be_cut_anywhere(void)
{
    uint8_t payload[FRAME_PAYLOAD_MAX], frame[FRAME_BYTES_MAX], got[FRAME_BYTES_MAX + 1];

    memset(payload, 0, sizeof payload);
    TEST_ASSERT_EQUAL_UINT8(FRAME_BYTES_MAX, frame_encode(frame, payload, sizeof payload));
    for (size_t cut = 1; cut <= sizeof frame; cut++) {
        struct outbox_room first = {got, cut}, second = {got + cut, sizeof frame - cut};

        got[cut] = 0xEE;
        outbox_send(&outbox, &first, frame, sizeof frame);
        TEST_ASSERT_EQUAL_UINT64(0, first.left);
        TEST_ASSERT_EQUAL_HEX8(0xEE, got[cut]); /* beyond the room */
        outbox_resume(&outbox, &second);
        TEST_ASSERT_EQUAL_UINT64(0, second.left);
        TEST_ASSERT_EQUAL_HEX8_ARRAY(frame, got, sizeof frame);
    }
}

static void test_a_cleared_box_holds_nothing_and_has_counted(void)
{
    struct listener listener;

    listener_init(&listener);
    put(1, 1);
    put(2, 1);
    put(2, 2);
    take(&listener, 5);
    outbox_clear(&outbox);
    TEST_ASSERT_EQUAL_UINT64(0, take(&listener, 8192));
    TEST_ASSERT_EQUAL_UINT64(1, outbox.frames);
    TEST_ASSERT_EQUAL_UINT64(1, outbox.dropped);
}

/* Every beacon arrives whole and each sender's in order; what was put was either sent, replaced
 * or still waits. */
static void test_nothing_is_lost_without_being_counted(void)
{
    struct listener listener;
    uint32_t state = 1;
    uint8_t numbers[7] = {0}, last[7] = {0};
    unsigned puts = 0;

    listener_init(&listener);
    for (unsigned tick = 0; tick < 200; tick++) {
        for (unsigned i = random_next(&state) % 8; i > 0; i--) {
            uint16_t sender = random_next(&state) % 7;

            put(sender, ++numbers[sender]);
            puts++;
        }
        take(&listener, random_next(&state) % 60);
    }
    take(&listener, 8192);
    TEST_ASSERT_EQUAL_UINT(0, listener.bad);
    TEST_ASSERT_EQUAL_UINT64(puts, listener.count + outbox.dropped);
    for (unsigned i = 0; i < listener.count; i++) {
        uint16_t sender = listener.sender[i];

        TEST_ASSERT_TRUE((uint8_t)(listener.number[i] - last[sender]) < 128);
        last[sender] = listener.number[i];
    }
    TEST_ASSERT_EQUAL_UINT8_ARRAY(numbers, last, 7);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_beacons_leave_in_the_order_of_their_arrival);
    RUN_TEST(test_a_newer_beacon_takes_the_place_of_its_senders_older_one);
    RUN_TEST(test_a_full_box_drops_newcomers_and_counts);
    RUN_TEST(test_a_cut_frame_goes_on_in_the_next_tick);
    RUN_TEST(test_a_newer_beacon_leaves_the_rest_of_a_cut_one_alone);
    RUN_TEST(test_the_longest_frame_can_be_cut_anywhere);
    RUN_TEST(test_a_cleared_box_holds_nothing_and_has_counted);
    RUN_TEST(test_nothing_is_lost_without_being_counted);
    return UNITY_END();
}
