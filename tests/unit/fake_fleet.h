/* fake_fleet.h: a server core with robots that are nothing but their end of the wire.
 *
 * A robot takes its orders as real ones do (firmware/core/mission.h) and acknowledges them; what
 * else it says, and where it is, a test decides. */
#ifndef FAKE_FLEET_H
#define FAKE_FLEET_H

#include "mission.h"
#include "server.h"

#define FLEET_MAX 8

/* Bytes of a tick at 115,200 baud. */
#define FLEET_ROOM 230

struct fake_robot {
    struct mission mission;
    uint8_t faults;      /* for its next status */
    uint16_t bad_frames; /* likewise */
    uint8_t state;       /* likewise */
    uint16_t says_id;    /* likewise; 0: its own */
    bool deaf;           /* takes no order */
    bool unseen;         /* motion capture has no new pose of it */

    struct frame_decoder decoder;
    unsigned bad, missions; /* since power-on: frames it could not read, missions begun */

    /* In the last tick. */
    unsigned frames;
    uint8_t first; /* the first one's type */
    unsigned poses, keepalives, estops, beacons;
    struct message_pose pose;
    int32_t told;                               /* by the last keep-alive: mission time, ms */
    struct message_beacon beacon[FLEET_MAX];    /* in the order of their arrival */
    uint8_t payload[FRAME_PAYLOAD_MAX], length; /* of the last one */
};

/* What the tests play with. Robot i has the id 10 (i + 1) and stands i metres along x; the first
 * two are candidates. The range is 1 m; formation 0 has four vertices, formation 1 has three and
 * the leader's is its last; as many can be
 * drawn as there may be robots; the reference is x = 1 m/s t. */
extern struct server_config fleet_config;
extern struct server_robot fleet_robots[FLEET_MAX];
extern struct server_pose fleet_poses[FLEET_MAX];
extern struct fake_robot fleet[FLEET_MAX];
extern struct server *server;
extern size_t fleet_room; /* bytes of a link in a tick */

/* What went over the wires so far. */
extern uint64_t fleet_bytes, fleet_frames;

/* Sets all of the above; there is no server yet. */
void fleet_reset(size_t robots);
void fleet_free(void);

/* A server whose robots are linked; then also until t = 0. */
void fleet_power_on(void);
void fleet_start(void);

/* Shows the server a robot's pose, whose age is that at the tick to come; fleet_tick() does so
 * first. */
void fleet_see(size_t robot);

/* What the server has for a robot now; fleet_tick() does so at its end. */
void fleet_listen(size_t robot);

void fleet_tick(void);
void fleet_ticks(unsigned count);

/* Ticks until mission time, ms. */
void fleet_until(int32_t time);

/* A robot is reset: it knows nothing any more. */
void fleet_reset_robot(size_t robot);

/* A message, or a payload, from a robot. Beacons reach others in the next tick. */
void fleet_say(size_t robot, const struct message *message);
void fleet_say_payload(size_t robot, const uint8_t *payload, uint8_t length);
void fleet_beacon(size_t robot, enum role role, uint16_t term);
void fleet_status(size_t robot);

/* How often the server reported this so far. */
unsigned fleet_reported(enum server_report_kind kind, uint16_t id, uint32_t value);

/* How often the server gave this order so far. */
unsigned fleet_ordered(enum event_action action, size_t robot);

/* The robot heard a beacon of the other's in the last tick. */
bool fleet_hears(size_t receiver, size_t sender);

#endif
