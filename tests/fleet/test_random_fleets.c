/* Fifty fleets of eight chips from random places, a ring of seven vertices, range 1 m. Each has
 * 20 s to complete; most take less than five. */
#include "fleet.h"

#include <stdio.h>
#include <unity.h>

#define FLEETS 50
#define ROBOTS 8

void setUp(void)
{
}
void tearDown(void)
{
}

/* A number in [-reach, reach], the same on every machine. */
static double draw(uint32_t *state, double reach)
{
    *state = *state * 1664525u + 1013904223u;
    return ((*state >> 8) / (double)(1u << 23) - 1) * reach;
}

static void write_scenario(char *text, size_t room, uint32_t seed)
{
    uint32_t state = seed * 2654435761u;
    size_t used = (size_t)snprintf(text, room,
                                   "schema: 1\nname: random\nduration: 20\n"
                                   "network: {range: 1.0}\n"
                                   "trajectory: {start: [0, 0, 0], v: 0.3, omega: 0}\n"
                                   "formations:\n  ring: {count: 8, L: 'i == 1 ? 0 : 1.2', "
                                   "psi: '2*pi*(i-2)/7'}\nformation: ring\nrobots:\n");

    for (int id = 1; id <= ROBOTS; id++) {
        double x = draw(&state, 4);
        double y = draw(&state, 4);
        double theta = draw(&state, 3.14);

        used += (size_t)snprintf(text + used, room - used,
                                 "  - {id: %d, pose: [%.4f, %.4f, %.4f], candidate: %s}\n", id, x,
                                 y, theta, id <= 2 ? "true" : "false");
    }
}

static void every_one_completes(void)
{
    char text[2048];
    char words[64];

    for (uint32_t seed = 1; seed <= FLEETS; seed++) {
        write_scenario(text, sizeof text, seed);
        struct fleet_result r = fleet_run(&(struct fleet_run){.text = text, .robots = SIM_AVR});

        snprintf(words, sizeof words, "fleet %u", seed);
        TEST_ASSERT_TRUE_MESSAGE(r.summary.metrics.complete, words);
        TEST_ASSERT_EQUAL_UINT_MESSAGE(1, r.summary.metrics.elections, words);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_one_completes);
    return UNITY_END();
}
