/* election.h: who leads (figure 3 of the paper).
 *
 *        t1: closest candidate to the reference, nobody leads
 *      C ----------------------------------------------------> L
 *      ^ \  t2: someone leads                                  |
 *      |  `--> F                                               |
 *      `-------'-----------------------------------------------'
 *        t3: the leader is silent or reports a fault
 *
 * A robot that is no candidate stays F. Candidates compare the distance to the reference, then
 * the id. Every election has a term, one above any heard of; where two leaders meet, the later
 * term stays, then the smaller id, so an old leader that comes back steps down.
 *
 * A lost packet is not a lost leader: every beacon says when its sender last had word of the
 * leader, so a robot takes the leader for silent only when nobody it hears has had word for
 * ELECTION_SILENCE_MS: eight beacons at 20 Hz and a tick. */
#ifndef ELECTION_H
#define ELECTION_H

#include "message.h"

#define ELECTION_SILENCE_MS 420

/* How long a candidate listens in C before it may lead: two beacons of every other one. */
#define ELECTION_WINDOW_TICKS 6

/* A candidate unheard for this long does not stand in an election. */
#define ELECTION_FRESH_TICKS (TICKS_PER_S / 2)

/* Candidates may elect this long before the mission starts (mission time, ms). */
#define ELECTION_START_MS (-300)

struct election {
    uint8_t role;         /* enum role */
    uint8_t waited;       /* ticks in C, stops at ELECTION_WINDOW_TICKS */
    uint16_t leader;      /* id, may be this robot's own; 0 = none */
    uint16_t term;        /* of that leader; kept when it is lost */
    uint16_t latest_term; /* highest heard of */
    int32_t word;         /* mission time of the last word of the leader, ms */
};

void election_begin(struct election *election, bool candidate);

/* A beacon came in; `now` is mission time, `own` this robot's id. */
void election_hear(struct election *election, const struct message_beacon *beacon, uint16_t own,
                   int32_t now);

/* What a candidate knows at a tick. */
struct election_view {
    uint16_t own;
    int32_t now; /* mission time, ms */
    bool candidate;
    bool able;    /* no fault, pose fresh, reference known, time to elect */
    bool closest; /* no other candidate is closer to the reference, ties by id; asked for
                     only when election_ripe() */
};

/* This candidate has listened long enough and may lead in this tick. */
bool election_ripe(const struct election *election);

/* Once a tick, after the beacons. */
void election_step(struct election *election, const struct election_view *view);

/* Ticks from the last word of the leader to `time` (mission time, ms), rounded up, 255 at most;
 * what a beacon carries as leader_age. */
uint8_t election_leader_age(const struct election *election, uint16_t own, int32_t time);

#endif
