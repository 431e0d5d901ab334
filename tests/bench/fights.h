/* fights.h: what a pass of allocation is measured with, the same on the chip and on the host.
 *
 * A fight is one robot's: n vertices in the leader's frame, m neighbours that hold some of them.
 * Each number 0 to FIGHTS - 1 is another combination of what makes a pass long; the first
 * FIGHTS_PLAIN begin with nothing on the taboo list. */
#ifndef FIGHTS_H
#define FIGHTS_H

#include "formation.h"
#include "message.h"

#define FIGHTS 576
#define FIGHTS_PLAIN 48

#define FIGHT_OWN_ID 1000
#define FIGHT_LEADER_ID 999

/* How leader and robot move: narrow, rate. */
#define FIGHT_BASE_V (NARROW_PER_M / 2)
#define FIGHT_BASE_OMEGA (RATE_ONE / 5)
#define FIGHT_OWN_V NARROW_PER_M
#define FIGHT_OWN_OMEGA (RATE_ONE / 2)

/* The age of their poses in the fights of whole ticks, ms. */
#define FIGHT_BASE_AGE 45
#define FIGHT_OWN_AGE 25

/* With these gains and limits, and wheels: Q8.8, narrow, rate, narrow. */
#define FIGHT_K GAIN_ONE
#define FIGHT_K_THETA (3 * GAIN_ONE)
#define FIGHT_V_MAX (4 * NARROW_PER_M)
#define FIGHT_OMEGA_MAX (10 * RATE_ONE)
#define FIGHT_TRACK (NARROW_PER_M / 10)
#define FIGHT_WHEEL_MAX (4 * NARROW_PER_M)

struct fight_size {
    uint8_t vertices, neighbours;
};

#define FIGHT_SIZES 4
extern const struct fight_size fight_sizes[FIGHT_SIZES];

/* Of the fights in which whole ticks are reckoned. */
extern const struct fight_size fight_in_tick;

/* In which order the vertices' numbers approach the robot. */
enum fight_order { FIGHT_APPROACHING, FIGHT_RECEDING, FIGHT_MIXED, FIGHT_TIED };
/* What the neighbours hold. */
enum fight_claims { FIGHT_NEAREST, FIGHT_ONE, FIGHT_SCATTERED };
/* Where they stand: on their vertex; where the robot is; beyond the vertex, a little farther from
 * it than the robot; anywhere around it, as far as the robot more or less. */
enum fight_stance { FIGHT_ON_VERTEX, FIGHT_BESIDE, FIGHT_BEYOND, FIGHT_AROUND };
enum fight_taboo { FIGHT_EMPTY, FIGHT_FULL, FIGHT_HALF };

struct fight {
    struct fight_size size;
    uint32_t seed;
    enum fight_order order;
    enum fight_claims claims;
    enum fight_stance stance;
    enum fight_taboo taboo;
    bool far; /* the robot is, and has to reckon coarsely */
    bool old; /* the neighbours' beacons are, and they were fast */
    uint8_t scale;
    uint16_t leader; /* the leader's vertex, 1..n */
    uint16_t now;    /* ms modulo 65,536 */
    struct pose base;
    struct vec16 about; /* the vertices lie about this place of the leader's frame */
    struct pose own;
};

struct fight fight_begin(struct fight_size size, uint16_t number);

/* The vertex (1..n) that is the `rank`th closest to the robot, from 0, and its place. The leader's
 * is the last. */
uint16_t fight_vertex(const struct fight *fight, uint8_t rank, struct vec16 *place);

/* Whether the vertex is on the taboo list when the pass begins. */
bool fight_is_taboo(const struct fight *fight, uint16_t vertex);

/* What the neighbour last said, index < m. */
struct message_beacon fight_beacon(const struct fight *fight, uint8_t index);

#endif
