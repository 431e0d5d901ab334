#include "network.h"

#include "random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#define STATIONS_MAX 40
#define FLIGHTS_MAX 8

static struct station stations[STATIONS_MAX];
static int32_t cells[2 * STATIONS_MAX];
static struct beacon_in_flight flights[FLIGHTS_MAX];
static struct outbox outboxes[STATIONS_MAX];
static struct network network;
static uint32_t sequence;

void setUp(void)
{
    sequence = 0;
}

void tearDown(void)
{
}

/* Robots 1, 2, ... all at the origin, with nothing between them. */
static void given(size_t count, double range)
{
    size_t buckets = 1;

    while (buckets < count)
        buckets *= 2;
    network = (struct network){
        .seed = 1,
        .range = range,
        .station_count = count,
        .station = stations,
        .cell_count = buckets,
        .cell = cells,
        .flight_room = FLIGHTS_MAX,
        .flight = flights,
    };
    for (size_t i = 0; i < count; i++) {
        stations[i] = (struct station){.tracked = true, .linked = true, .id = (uint16_t)(i + 1)};
        memset(&outboxes[i], 0, sizeof outboxes[i]);
    }
}

static void given_at(size_t robot, double x, double y)
{
    stations[robot].x = x;
    stations[robot].y = y;
}

static void send_at(uint64_t tick, size_t sender, bool to_all)
{
    struct beacon_frame frame = {
        .sender = stations[sender].id, .length = 1, .bytes = {(uint8_t)sequence}};

    network_send(&network, tick, sender, sequence++, to_all, &frame);
}

/* How many of the beacons delivered by `tick` wait for the robot, which takes them all. */
static unsigned heard_by(uint64_t tick, size_t robot)
{
    network_deliver(&network, tick, outboxes);
    unsigned count = outboxes[robot].count;
    outbox_clear(&outboxes[robot]);
    return count;
}

static bool hears(size_t receiver, size_t sender)
{
    send_at(0, sender, false);
    return heard_by(0, receiver) == 1;
}

static bool hears_far(size_t receiver, size_t sender)
{
    send_at(0, sender, true);
    return heard_by(0, receiver) == 1;
}

static void test_the_range_is_inclusive(void)
{
    given(2, 1);
    given_at(0, 0.6, 0.8);
    TEST_ASSERT_TRUE(hears(0, 1));
    TEST_ASSERT_TRUE(hears(1, 0));
    given_at(0, 0.6, 0.8001);
    TEST_ASSERT_FALSE(hears(0, 1));
    TEST_ASSERT_FALSE(hears(1, 0));
}

static void test_a_range_of_0_reaches_the_same_place(void)
{
    given(3, 0);
    given_at(0, -3, 7);
    given_at(1, -3, 7);
    given_at(2, -3, 7.001);
    TEST_ASSERT_TRUE(hears(1, 0));
    TEST_ASSERT_FALSE(hears(2, 0));
}

static void test_nobody_hears_itself(void)
{
    given(2, 1);
    TEST_ASSERT_FALSE(hears(0, 0));
    TEST_ASSERT_FALSE(hears_far(0, 0));
}

static void test_the_long_range_reaches_all(void)
{
    given(3, 1);
    given_at(1, 2000, -2000);
    given_at(2, 2, 0);
    TEST_ASSERT_FALSE(hears(2, 0));
    TEST_ASSERT_TRUE(hears_far(2, 0));
    TEST_ASSERT_TRUE(hears_far(1, 0));
}

static void test_without_a_place_only_the_long_range_works(void)
{
    given(2, 1);
    stations[1].tracked = false;
    TEST_ASSERT_FALSE(hears(0, 1));
    TEST_ASSERT_FALSE(hears(1, 0));
    TEST_ASSERT_TRUE(hears_far(0, 1));
    TEST_ASSERT_TRUE(hears_far(1, 0));
}

static void test_without_a_link_nothing_is_heard(void)
{
    given(2, 1);
    stations[1].linked = false;
    TEST_ASSERT_FALSE(hears(1, 0));
    TEST_ASSERT_FALSE(hears_far(1, 0));
}

static void test_muted_is_lost_both_ways(void)
{
    given(3, 1);
    stations[1].muted = true;
    TEST_ASSERT_FALSE(hears(1, 0));
    TEST_ASSERT_FALSE(hears_far(1, 0));
    TEST_ASSERT_FALSE(hears(0, 1));
    TEST_ASSERT_FALSE(hears_far(0, 1));
    TEST_ASSERT_TRUE(hears(2, 0));
}

static void test_beacons_pass_within_a_group_only(void)
{
    given(3, 1);
    stations[1].group = stations[2].group = 5;
    TEST_ASSERT_FALSE(hears(1, 0));
    TEST_ASSERT_FALSE(hears_far(1, 0));
    TEST_ASSERT_FALSE(hears_far(0, 1));
    TEST_ASSERT_TRUE(hears(2, 1));
    TEST_ASSERT_TRUE(hears_far(1, 2));
}

static void test_a_delay_is_counted_in_ticks(void)
{
    given(2, 1);
    network.delay_ticks = 3;
    send_at(100, 0, false);
    TEST_ASSERT_EQUAL_UINT(0, heard_by(102, 1));
    TEST_ASSERT_EQUAL_UINT(1, heard_by(103, 1));
    TEST_ASSERT_EQUAL_UINT(0, heard_by(104, 1));
}

static void test_who_hears_is_decided_on_arrival(void)
{
    given(2, 1);
    network.delay_ticks = 5;
    given_at(1, 9, 0);
    send_at(0, 0, false);
    given_at(1, 1, 0);
    TEST_ASSERT_EQUAL_UINT(1, heard_by(5, 1));
    send_at(10, 0, false);
    stations[0].muted = true;
    TEST_ASSERT_EQUAL_UINT(0, heard_by(15, 1));
}

static void test_a_beacon_outlives_its_senders_link(void)
{
    given(2, 1);
    network.delay_ticks = 5;
    given_at(0, 100, 0);
    given_at(1, 101, 0);
    send_at(0, 0, false);
    stations[0].linked = false;
    TEST_ASSERT_EQUAL_UINT(1, heard_by(5, 1));
}

static void test_a_shorter_delay_does_not_overtake(void)
{
    given(3, 1);
    network.delay_ticks = 5;
    send_at(0, 0, false);
    network.delay_ticks = 0;
    send_at(1, 1, false);
    TEST_ASSERT_EQUAL_UINT(0, heard_by(4, 2));
    network_deliver(&network, 5, outboxes);
    TEST_ASSERT_EQUAL_UINT8(2, outboxes[2].count);
    TEST_ASSERT_EQUAL_UINT16(1, outboxes[2].beacon[0].sender);
    TEST_ASSERT_EQUAL_UINT16(2, outboxes[2].beacon[1].sender);
}

static void test_a_full_air_drops_and_counts(void)
{
    given(STATIONS_MAX, 1);
    network.delay_ticks = 1;
    for (size_t i = 0; i < FLIGHTS_MAX + 3; i++)
        send_at(0, i, false);
    TEST_ASSERT_EQUAL_UINT64(3, network.dropped);
    TEST_ASSERT_EQUAL_UINT(FLIGHTS_MAX, heard_by(1, STATIONS_MAX - 1));
    send_at(1, 0, false);
    TEST_ASSERT_EQUAL_UINT(1, heard_by(2, STATIONS_MAX - 1));
    TEST_ASSERT_EQUAL_UINT64(3, network.dropped);
}

static void test_loss_0_loses_none_and_loss_1_all(void)
{
    given(2, 1);
    for (unsigned i = 0; i < 1000; i++)
        TEST_ASSERT_TRUE(hears(1, 0));
    network.loss = 1;
    for (unsigned i = 0; i < 1000; i++)
        TEST_ASSERT_FALSE(hears(1, 0));
}

/* Over 100,000 beacons a count's standard deviation is below 160: 0.0016. */
static void test_every_pair_loses_its_share(void)
{
    static const double shares[] = {0.01, 0.2, 0.5, 0.9};
    const uint32_t beacons = 100000;

    given(2, 1);
    for (size_t s = 0; s < sizeof shares / sizeof shares[0]; s++) {
        for (uint16_t sender = 1; sender <= 3; sender++) {
            uint32_t lost = 0;

            network.loss = shares[s];
            for (uint32_t i = 0; i < beacons; i++)
                lost += network_loses(&network, sender, 4, i);
            TEST_ASSERT_DOUBLE_WITHIN(0.007, shares[s], (double)lost / beacons);
        }
    }
}

/* At a loss of one half, fates that have nothing to do with one another agree half the time. */
static void test_fates_are_independent(void)
{
    const uint32_t beacons = 100000;
    uint32_t receivers = 0, directions = 0, successors = 0, seeds = 0;

    given(2, 1);
    network.loss = 0.5;
    struct network other = network;
    other.seed++;
    for (uint32_t i = 0; i < beacons; i++) {
        bool lost = network_loses(&network, 1, 2, i);

        receivers += lost == network_loses(&network, 1, 3, i);
        directions += lost == network_loses(&network, 2, 1, i);
        successors += lost == network_loses(&network, 1, 2, i + 1);
        seeds += lost == network_loses(&other, 1, 2, i);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.007, 0.5, (double)receivers / beacons);
    TEST_ASSERT_DOUBLE_WITHIN(0.007, 0.5, (double)directions / beacons);
    TEST_ASSERT_DOUBLE_WITHIN(0.007, 0.5, (double)successors / beacons);
    TEST_ASSERT_DOUBLE_WITHIN(0.007, 0.5, (double)seeds / beacons);
}

/* Which of 100 beacons from robot 1 robot 2 hears. */
static void hear_100(bool heard[100])
{
    for (uint32_t i = 0; i < 100; i++) {
        sequence = i;
        heard[i] = hears(1, 0);
    }
}

static void test_a_fate_depends_on_the_beacon_alone(void)
{
    bool alone[100], in_a_crowd[100];

    given(2, 1);
    network.loss = 0.3;
    hear_100(alone);

    given(STATIONS_MAX, 5);
    network.loss = 0.3;
    given_at(1, -3, 4);
    for (size_t i = 2; i < STATIONS_MAX; i++)
        hears(1, i);
    hear_100(in_a_crowd);
    TEST_ASSERT_EQUAL_MEMORY(alone, in_a_crowd, sizeof alone);
}

/* Half the fleets stand on a lattice, where distances equal the range and places coincide. */
static double draw_place(uint32_t *state, bool lattice)
{
    if (lattice)
        return (int)(random_next(state) % 21 - 10) / 10.0;
    return random_next(state) / (double)UINT32_MAX * 8 - 4;
}

static void test_the_grid_finds_whom_all_pairs_find(void)
{
    static const double ranges[] = {0, 0.01, 0.1, 0.3, 0.7, 1, 2.5, 100};
    uint32_t state = 1;

    for (unsigned fleet = 0; fleet < 4000; fleet++) {
        size_t count = 1 + random_next(&state) % STATIONS_MAX;

        given(count, ranges[random_next(&state) % (sizeof ranges / sizeof ranges[0])]);
        for (size_t i = 0; i < count; i++)
            given_at(i, draw_place(&state, fleet % 2), draw_place(&state, fleet % 2));
        size_t sender = random_next(&state) % count;
        send_at(0, sender, false);
        network_deliver(&network, 0, outboxes);
        for (size_t i = 0; i < count; i++) {
            double distance =
                hypot(stations[i].x - stations[sender].x, stations[i].y - stations[sender].y);
            bool near = i != sender && distance <= network.range + 1e-12;

            TEST_ASSERT_EQUAL_UINT8(near, outboxes[i].count);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_range_is_inclusive);
    RUN_TEST(test_a_range_of_0_reaches_the_same_place);
    RUN_TEST(test_nobody_hears_itself);
    RUN_TEST(test_the_long_range_reaches_all);
    RUN_TEST(test_without_a_place_only_the_long_range_works);
    RUN_TEST(test_without_a_link_nothing_is_heard);
    RUN_TEST(test_muted_is_lost_both_ways);
    RUN_TEST(test_beacons_pass_within_a_group_only);
    RUN_TEST(test_a_delay_is_counted_in_ticks);
    RUN_TEST(test_who_hears_is_decided_on_arrival);
    RUN_TEST(test_a_beacon_outlives_its_senders_link);
    RUN_TEST(test_a_shorter_delay_does_not_overtake);
    RUN_TEST(test_a_full_air_drops_and_counts);
    RUN_TEST(test_loss_0_loses_none_and_loss_1_all);
    RUN_TEST(test_every_pair_loses_its_share);
    RUN_TEST(test_fates_are_independent);
    RUN_TEST(test_a_fate_depends_on_the_beacon_alone);
    RUN_TEST(test_the_grid_finds_whom_all_pairs_find);
    return UNITY_END();
}
