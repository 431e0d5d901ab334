#include "radio.h"

#include <unity.h>

#define BURST 20
#define TICKS 4000

static struct radio_pipe *air;
static uint32_t sent, taken; /* bytes so far; byte i is i modulo 251 */
static uint64_t sent_at[TICKS * BURST];
static unsigned late[RADIO_TICKS_MAX + 2]; /* bytes by their delay in ticks */

void setUp(void)
{
    air = NULL;
    sent = taken = 0;
    for (unsigned i = 0; i < RADIO_TICKS_MAX + 2; i++)
        late[i] = 0;
}

void tearDown(void)
{
    radio_pipe_free(air);
}

static void given(const struct radio *radio)
{
    air = radio_pipe_new(radio, 1, RADIO_DOWN, BURST);
    TEST_ASSERT_NOT_NULL(air);
}

static struct radio small_radio(uint64_t seed)
{
    return radio_of(&(struct scenario){.body = BODY_SMALL}, seed);
}

static void put(uint64_t tick, size_t count)
{
    uint8_t bytes[BURST];

    for (size_t i = 0; i < count; i++) {
        sent_at[sent] = tick;
        bytes[i] = (uint8_t)(sent++ % 251);
    }
    radio_put(air, tick, bytes, count);
}

/* Every byte must be the next one that was sent. */
static size_t take(uint64_t tick, size_t room)
{
    uint8_t bytes[BURST];
    size_t count = radio_take(air, tick, bytes, room);

    TEST_ASSERT_TRUE(count <= room);
    for (size_t i = 0; i < count; i++) {
        uint64_t delay = tick - sent_at[taken];

        TEST_ASSERT_EQUAL_UINT8(taken++ % 251, bytes[i]);
        TEST_ASSERT_TRUE(delay <= RADIO_TICKS_MAX + 1);
        late[delay]++;
    }
    return count;
}

/* A few bytes a tick, never so many that they wait for one another. */
static void talk(void)
{
    for (uint64_t tick = 0; tick < TICKS; tick++) {
        put(tick, 1 + tick % 3);
        take(tick, BURST);
    }
}

static void test_a_cable_brings_everything_at_once(void)
{
    struct radio cable = radio_of(&(struct scenario){.body = BODY_IDEAL}, 1);

    given(&cable);
    talk();
    TEST_ASSERT_EQUAL_UINT32(sent, taken);
    TEST_ASSERT_EQUAL_UINT(sent, late[0]);
}

static void test_a_small_robots_radio_takes_one_tick_or_two(void)
{
    struct radio radio = small_radio(1);

    given(&radio);
    talk();
    TEST_ASSERT_EQUAL_UINT(taken, late[1] + late[2]);
    TEST_ASSERT_TRUE(late[1] > taken * 47 / 100 && late[2] > taken * 47 / 100);
    TEST_ASSERT_TRUE(sent - taken <= 2 * 3);
}

/* take() looks at the order; here later bytes often land earlier. */
static void test_a_wide_jitter_reorders_nothing(void)
{
    struct radio radio = {.least = 0, .jitter = RADIO_TICKS_MAX, .seed = 1};

    given(&radio);
    talk();
    TEST_ASSERT_EQUAL_UINT(taken, late[0] + late[1] + late[2] + late[3] + late[4]);
    for (unsigned delay = 0; delay <= RADIO_TICKS_MAX; delay++)
        TEST_ASSERT_TRUE(late[delay] > 0);
}

static void test_a_full_link_loses_nothing(void)
{
    struct radio radio = small_radio(2);

    given(&radio);
    for (uint64_t tick = 0; tick < TICKS; tick++) {
        put(tick, BURST);
        take(tick, BURST);
    }
    for (uint64_t tick = TICKS; tick < TICKS + 3; tick++) {
        put(tick, 0);
        take(tick, BURST);
    }
    TEST_ASSERT_EQUAL_UINT32(sent, taken);
}

static void test_what_finds_no_room_comes_next(void)
{
    struct radio cable = {.seed = 1};

    given(&cable);
    put(0, 5);
    TEST_ASSERT_EQUAL_UINT(3, take(0, 3));
    put(1, 1);
    TEST_ASSERT_EQUAL_UINT(3, take(1, BURST));
}

static void test_a_lost_link_forgets_what_was_on_its_way(void)
{
    struct radio radio = small_radio(3);

    given(&radio);
    put(0, 5);
    radio_clear(air);
    taken = sent;
    for (uint64_t tick = 1; tick < 10; tick++) {
        put(tick, 2);
        take(tick, BURST);
    }
    TEST_ASSERT_TRUE(taken > 5);
}

/* Bit n of the result: tick n's byte is two ticks late. */
static uint64_t jitter(uint64_t seed, uint16_t robot, enum radio_way way)
{
    struct radio radio = small_radio(seed);
    struct radio_pipe *one = radio_pipe_new(&radio, robot, way, 1);
    uint64_t bits = 0;
    uint8_t byte = 0;

    TEST_ASSERT_NOT_NULL(one);
    for (uint64_t tick = 0; tick < 128; tick += 2) {
        radio_put(one, tick, &byte, 1);
        radio_take(one, tick, &byte, 1);
        bits = bits << 1 | (radio_take(one, tick + 1, &byte, 1) == 0);
        radio_clear(one);
    }
    radio_pipe_free(one);
    return bits;
}

static void test_every_way_of_every_robot_has_a_jitter_of_its_own(void)
{
    uint64_t bits = jitter(1, 1, RADIO_DOWN);

    TEST_ASSERT_TRUE(bits == jitter(1, 1, RADIO_DOWN));
    TEST_ASSERT_TRUE(bits != jitter(2, 1, RADIO_DOWN));
    TEST_ASSERT_TRUE(bits != jitter(1, 2, RADIO_DOWN));
    TEST_ASSERT_TRUE(bits != jitter(1, 1, RADIO_UP));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_cable_brings_everything_at_once);
    RUN_TEST(test_a_small_robots_radio_takes_one_tick_or_two);
    RUN_TEST(test_a_wide_jitter_reorders_nothing);
    RUN_TEST(test_a_full_link_loses_nothing);
    RUN_TEST(test_what_finds_no_room_comes_next);
    RUN_TEST(test_a_lost_link_forgets_what_was_on_its_way);
    RUN_TEST(test_every_way_of_every_robot_has_a_jitter_of_its_own);
    return UNITY_END();
}
