/* Faults beyond the paper's two simulations, on native robots, each for several seeds at 10 % loss.
 * Every one must end complete for the robots that live. */
#include "fleet.h"

#include <stdio.h>
#include <unity.h>

#define SEEDS 5

void setUp(void) {}
void tearDown(void) {}

static const char four[] = "  - {id: 1, pose: [-2, 1, 0], candidate: true}\n"
                           "  - {id: 2, pose: [2, 1, 0], candidate: true}\n"
                           "  - {id: 3, pose: [-2, -1, 0]}\n"
                           "  - {id: 4, pose: [-2, -3, 0]}\n";
static const char spare[] = "  - {id: 5, pose: [-3, -2, 0]}\n";

static const char *scenario(const char *more_robots, const char *events)
{
    static char text[2048];

    snprintf(text, sizeof text,
             "schema: 1\nname: situation\nduration: 40\nrobots:\n%s%s"
             "network: {range: 3.0, loss: 0.1}\n"
             "trajectory: {start: [0, 0, -pi], v: 0.5, omega: \"-0.1*tanh(0.1*(t-15))\"}\n"
             "formations:\n  G1: {L: [0, 1, 1, 1], psi: [0, -pi/3, pi/3, pi]}\n"
             "  G2: {L: [0, 1.5, 1.5, 1.5], psi: [0, 0, 2*pi/3, -2*pi/3]}\n"
             "  G3: {L: [0, -1, -1, -2], psi: [0, -pi/4, pi/4, 0]}\n"
             "formation: G1\nevents:\n%s",
             four, more_robots, events);
    return text;
}

static struct fleet_result last;

/* Runs every seed; the leader at the end must be `leader`. */
static void ends_complete(const char *more_robots, const char *events, uint16_t leader)
{
    char words[64];

    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        last = fleet_run(&(struct fleet_run){.text = scenario(more_robots, events),
                                             .robots = SIM_NATIVE,
                                             .seed = seed,
                                             .out = "last"});
        snprintf(words, sizeof words, "seed %u", (unsigned)seed);
        TEST_ASSERT_TRUE_MESSAGE(last.summary.metrics.complete, words);
        TEST_ASSERT_EQUAL_UINT_MESSAGE(leader, last.leader, words);
    }
}

static void a_follower_dies(void)
{
    ends_complete("", "  - {at: 10, kill: 3}\n", 1);
}

static void both_candidates_die_and_one_comes_back(void)
{
    ends_complete("", "  - {at: 5, kill: 1}\n  - {at: 12, kill: 2}\n  - {at: 20, revive: 1}\n", 1);
}

static void with_no_candidate_followers_stop(void)
{
    struct fleet_row row;
    double speed = 0;

    fleet_run(&(struct fleet_run){
        .text = scenario("", "  - {at: 5, kill: 1}\n  - {at: 12, kill: 2}\n"),
        .robots = SIM_NATIVE,
        .out = "abandoned"});
    FILE *trace = fleet_trace("abandoned");
    while (fleet_next(trace, &row))
        if (row.alive && row.t > 14 && row.v > speed)
            speed = row.v;
    TEST_ASSERT_TRUE(speed == 0);
}

static void an_old_leader_that_comes_back_follows(void)
{
    ends_complete("", "  - {at: 5, kill: 1}\n  - {at: 12, revive: 1}\n", 2);
    TEST_ASSERT_EQUAL_UINT(2, last.summary.metrics.elections);
}

static void a_spare_moves_up(void)
{
    ends_complete(spare, "  - {at: 15, kill: 3}\n", 1);
}

static void a_leader_that_stalls_hands_over(void)
{
    ends_complete("", "  - {at: 10, stall: leader}\n", 2);
    double taken_over = fleet_leads_at("last", 2, 10);
    TEST_ASSERT_TRUE(taken_over <= 11.5);
}

static void a_leader_whose_radio_fails_is_replaced_and_gives_way(void)
{
    ends_complete("", "  - {at: 10, mute: 1}\n  - {at: 20, unmute: 1}\n", 2);
}

static void two_leaders_that_meet_settle_it_within_three_beacons(void)
{
    struct fleet_row row;
    double both = 0;

    ends_complete("", "  - {at: 8, partition: [[1, 3], [2, 4]]}\n  - {at: 15, heal: true}\n", 2);
    FILE *trace = fleet_trace("last");
    unsigned leaders = 0;
    double t = 0;
    while (fleet_next(trace, &row)) {
        if (row.t != t) {
            if (leaders > 1)
                both = t;
            leaders = 0;
            t = row.t;
        }
        leaders += row.alive && row.role == 'L';
    }
    TEST_ASSERT_TRUE(both > 14 && both <= 15.25);
}

static void formation_change_and_leader_fault_at_once(void)
{
    ends_complete("", "  - {at: 10, formation: G2}\n  - {at: 10.06, kill: leader}\n", 2);
}

static void three_formations_in_a_row(void)
{
    ends_complete("", "  - {at: 8, formation: G2}\n  - {at: 16, formation: G3}\n"
                      "  - {when: \"leader.x < -8\", formation: G1}\n", 1);
}

static void an_emergency_stop_stops_all_and_stays(void)
{
    struct fleet_row row;
    double speed = 0;

    fleet_run(&(struct fleet_run){.text = scenario("", "  - {at: 10, estop: true}\n"),
                                  .robots = SIM_NATIVE,
                                  .out = "estop"});
    FILE *trace = fleet_trace("estop");
    while (fleet_next(trace, &row))
        if (row.t > 10.3 && row.v * row.v + row.omega * row.omega > speed)
            speed = row.v * row.v + row.omega * row.omega;
    TEST_ASSERT_TRUE(speed == 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_follower_dies);
    RUN_TEST(both_candidates_die_and_one_comes_back);
    RUN_TEST(with_no_candidate_followers_stop);
    RUN_TEST(an_old_leader_that_comes_back_follows);
    RUN_TEST(a_spare_moves_up);
    RUN_TEST(a_leader_that_stalls_hands_over);
    RUN_TEST(a_leader_whose_radio_fails_is_replaced_and_gives_way);
    RUN_TEST(two_leaders_that_meet_settle_it_within_three_beacons);
    RUN_TEST(formation_change_and_leader_fault_at_once);
    RUN_TEST(three_formations_in_a_row);
    RUN_TEST(an_emergency_stop_stops_all_and_stays);
    return UNITY_END();
}
