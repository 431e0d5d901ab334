#include "election.h"

#include <unity.h>

#define OWN 5

static struct election election;
static int32_t now;

void setUp(void)
{
    now = 10000;
    election_begin(&election, true);
}

void tearDown(void)
{
}

static void hear(uint16_t id, uint8_t role, uint16_t term)
{
    struct message_beacon beacon = {.id = id,
                                    .role = role,
                                    .term = term,
                                    .candidate = true,
                                    .time = (uint16_t)now,
                                    .leader_age = UINT8_MAX};

    election_hear(&election, &beacon, OWN, now);
}

static void step(bool closest)
{
    struct election_view view = {
        .own = OWN, .now = now, .candidate = true, .able = true, .closest = closest};

    election_step(&election, &view);
    now += TICK_MS;
}

static void win(void)
{
    for (int i = 0; i <= ELECTION_WINDOW_TICKS; i++)
        step(true);
    TEST_ASSERT_EQUAL(ROLE_LEADER, election.role);
}

static void test_the_closest_leads_after_the_window(void)
{
    for (int i = 0; i < ELECTION_WINDOW_TICKS; i++) {
        step(true);
        TEST_ASSERT_EQUAL(ROLE_CANDIDATE, election.role);
    }
    step(true);
    TEST_ASSERT_EQUAL(ROLE_LEADER, election.role);
    TEST_ASSERT_EQUAL(OWN, election.leader);
    TEST_ASSERT_EQUAL(1, election.term);
}

static void test_another_that_is_closer_is_waited_for(void)
{
    for (int i = 0; i < 100; i++)
        step(false);
    TEST_ASSERT_EQUAL(ROLE_CANDIDATE, election.role);
    hear(7, ROLE_LEADER, 1);
    TEST_ASSERT_EQUAL(ROLE_FOLLOWER, election.role);
    TEST_ASSERT_EQUAL(7, election.leader);
}

static void test_a_silent_leader_is_lost_after_eight_beacons(void)
{
    hear(7, ROLE_LEADER, 1);
    int32_t heard = now;
    while (election.role == ROLE_FOLLOWER)
        step(false);
    TEST_ASSERT_EQUAL(ROLE_CANDIDATE, election.role);
    TEST_ASSERT_INT32_WITHIN(TICK_MS, 8 * 50 + TICK_MS, now - heard - TICK_MS);
}

static void test_seven_lost_beacons_are_no_lost_leader(void)
{
    for (int i = 0; i < 100; i++) {
        hear(7, ROLE_LEADER, 1);
        for (int32_t until = now + 8 * 50; now < until;)
            step(true);
        TEST_ASSERT_EQUAL(ROLE_FOLLOWER, election.role);
    }
}

static void test_word_of_the_leader_by_others_counts(void)
{
    hear(7, ROLE_LEADER, 3);
    for (int i = 0; i < 200; i++) {
        struct message_beacon beacon = {
            .id = 9, .role = ROLE_FOLLOWER, .term = 3, .time = (uint16_t)now, .leader_age = 5};

        if (i % 10 == 0)
            election_hear(&election, &beacon, OWN, now);
        step(true);
        TEST_ASSERT_EQUAL(7, election.leader);
    }
}

static void test_word_of_another_term_does_not(void)
{
    hear(7, ROLE_LEADER, 3);
    for (int i = 0; i < 25; i++) {
        struct message_beacon beacon = {
            .id = 9, .role = ROLE_FOLLOWER, .term = 2, .time = (uint16_t)now, .leader_age = 0};

        election_hear(&election, &beacon, OWN, now);
        step(false);
    }
    TEST_ASSERT_EQUAL(0, election.leader);
}

static void test_hearsay_does_not_grow_younger_by_being_passed_on(void)
{
    struct election other;

    election_begin(&other, true);
    hear(7, ROLE_LEADER, 1);
    struct message_beacon leader = {
        .id = 7, .role = ROLE_LEADER, .term = 1, .time = (uint16_t)now, .candidate = true};
    election_hear(&other, &leader, 6, now);
    int32_t first = election.word;
    for (int i = 0; i < 40; i++) {
        struct message_beacon a = {.id = OWN,
                                   .role = ROLE_FOLLOWER,
                                   .term = 1,
                                   .time = (uint16_t)now,
                                   .leader_age = election_leader_age(&election, OWN, now)};
        election_hear(&other, &a, 6, now + 50);
        struct message_beacon b = {.id = 6,
                                   .role = ROLE_FOLLOWER,
                                   .term = 1,
                                   .time = (uint16_t)now,
                                   .leader_age = election_leader_age(&other, 6, now)};
        election_hear(&election, &b, OWN, now + 50);
        now += 7;
    }
    TEST_ASSERT_EQUAL_INT32(first, election.word);
}

static void test_a_leader_that_reports_a_fault_is_lost_at_once(void)
{
    struct message_beacon beacon = {
        .id = 7, .role = ROLE_LEADER, .fault = true, .term = 1, .time = (uint16_t)now};

    hear(7, ROLE_LEADER, 1);
    election_hear(&election, &beacon, OWN, now);
    step(false);
    TEST_ASSERT_EQUAL(ROLE_CANDIDATE, election.role);
}

static void test_a_leader_that_is_not_able_steps_down(void)
{
    struct election_view view = {.own = OWN, .now = now, .candidate = true};

    win();
    view.now = now;
    election_step(&election, &view);
    TEST_ASSERT_EQUAL(ROLE_CANDIDATE, election.role);
    TEST_ASSERT_EQUAL(0, election.leader);
}

static void test_a_later_term_demotes_a_leader(void)
{
    win();
    hear(9, ROLE_LEADER, 2);
    TEST_ASSERT_EQUAL(ROLE_FOLLOWER, election.role);
    TEST_ASSERT_EQUAL(9, election.leader);
}

static void test_an_old_leader_that_comes_back_makes_no_second_one(void)
{
    hear(9, ROLE_LEADER, 4);
    hear(1, ROLE_LEADER, 3);
    TEST_ASSERT_EQUAL(9, election.leader);
}

static void test_of_two_leaders_of_one_term_the_smaller_id_stays(void)
{
    win();
    hear(9, ROLE_LEADER, 1);
    TEST_ASSERT_EQUAL(ROLE_LEADER, election.role);
    hear(3, ROLE_LEADER, 1);
    TEST_ASSERT_EQUAL(ROLE_FOLLOWER, election.role);
    TEST_ASSERT_EQUAL(3, election.leader);
}

static void test_a_new_term_is_above_any_heard_of(void)
{
    hear(9, ROLE_CANDIDATE, 41);
    win();
    TEST_ASSERT_EQUAL(42, election.term);
}

static void test_a_follower_never_stands(void)
{
    struct election_view view = {.own = OWN, .closest = true, .able = true};

    election_begin(&election, false);
    for (int i = 0; i < 100; i++) {
        view.now = now += TICK_MS;
        election_step(&election, &view);
    }
    TEST_ASSERT_EQUAL(ROLE_FOLLOWER, election.role);
}

static void test_leader_age_is_rounded_up(void)
{
    hear(7, ROLE_LEADER, 1);
    TEST_ASSERT_EQUAL(0, election_leader_age(&election, OWN, now - 1));
    TEST_ASSERT_EQUAL(1, election_leader_age(&election, OWN, now + 1));
    TEST_ASSERT_EQUAL(1, election_leader_age(&election, OWN, now + TICK_MS));
    TEST_ASSERT_EQUAL(UINT8_MAX, election_leader_age(&election, OWN, now + 10000));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_closest_leads_after_the_window);
    RUN_TEST(test_another_that_is_closer_is_waited_for);
    RUN_TEST(test_a_silent_leader_is_lost_after_eight_beacons);
    RUN_TEST(test_seven_lost_beacons_are_no_lost_leader);
    RUN_TEST(test_word_of_the_leader_by_others_counts);
    RUN_TEST(test_word_of_another_term_does_not);
    RUN_TEST(test_hearsay_does_not_grow_younger_by_being_passed_on);
    RUN_TEST(test_a_leader_that_reports_a_fault_is_lost_at_once);
    RUN_TEST(test_a_leader_that_is_not_able_steps_down);
    RUN_TEST(test_a_later_term_demotes_a_leader);
    RUN_TEST(test_an_old_leader_that_comes_back_makes_no_second_one);
    RUN_TEST(test_of_two_leaders_of_one_term_the_smaller_id_stays);
    RUN_TEST(test_a_new_term_is_above_any_heard_of);
    RUN_TEST(test_a_follower_never_stands);
    RUN_TEST(test_leader_age_is_rounded_up);
    return UNITY_END();
}
