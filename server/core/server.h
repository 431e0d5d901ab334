/* server.h: the host end, without a clock, socket, file or allocation in it.
 *
 * A loop hands in what came from the robots' links (server_receive) and the poses (server_see),
 * ticks every TICK_MS (server_tick), and takes what goes out (server_take): in virtual time once a
 * tick, in real time whenever there is a new pose. The same core runs beside simulated robots and
 * beside real ones.
 *
 * It sends each robot its own pose, uploads the mission, relays beacons as the paper's network
 * would (to all for those sent with the long range, else to the robots in range), emulates loss,
 * delay and partitions, and carries out the scenario's events. */
#ifndef SERVER_H
#define SERVER_H

#include "event.h"
#include "formation.h"
#include "message.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct server_robot {
    uint16_t id;
    bool candidate;
};

struct server_formation {
    uint16_t count;
    uint8_t scale; /* formation.h */
    const struct polar_vertex *vertex;
};

/* Formations that are drawn while it runs, and kept, at the most. */
#define SERVER_DRAWN_MAX 8

enum server_allocation { SERVER_CPA, SERVER_CPA_LITERAL, SERVER_RIGID, SERVER_OPTIMAL };

/* Everything pointed to must outlive the server. */
struct server_config {
    size_t robot_count;
    const struct server_robot *robots;
    size_t formation_count;
    const struct server_formation *formations;
    uint16_t formation;      /* the first one's index */
    uint16_t drawn_vertices; /* of one that server_draw() brings, at the most; 0: it brings none */
    size_t knot_count;
    const struct knot *knots; /* of the trajectory, as trajectory.h wants them */
    size_t event_count;
    const struct event *events;
    /* For every robot; `candidate` and `allocation` are set. `mission` is the number of the first
     * upload: every further one to a robot has the next, so that it drops what it held. */
    struct message_mission mission;
    enum server_allocation allocation;
    double range, loss, delay; /* m, probability, s */
    uint64_t seed;
    bool waits; /* the count-down waits for server_begin(), and a robot is given no mission before
                   it has told of itself: it may be another one, or have one from another server */
};

/* What motion capture knows of one robot. */
struct server_pose {
    double x, y, theta; /* m, rad */
    bool tracked;
    int16_t
        age_ms; /* at the last tick, since it was measured; negative: it was measured after it */
};

/* An older pose is none: its robot is told that it is not tracked. */
#define SERVER_POSE_OLD_MS 200

/* What a robot said of itself last. */
struct server_view {
    bool linked;  /* and takes part */
    uint8_t role; /* enum role; F while there is no link, C or F before the first beacon */
    uint16_t term;
    uint16_t vertex;
    uint8_t state, faults; /* supervisor state, enum fault */
    uint16_t battery, tick_cycles, stack_free, vertices_max;
    uint8_t version, reset_cause;
    bool acknowledged; /* the mission, all of it; what comes later it may still lack */
    bool halted;       /* server_halt() */
    bool stranger;     /* says that it is another robot, `id`: takes no part until that ends */
    uint16_t id;
    uint32_t frames, bad_frames; /* heard from it, and since its link came up: lost on either end */
};

struct server_counters {
    uint64_t frames, bytes; /* both ways */
    uint64_t dropped;       /* beacons that gave way to a newer one or found no room */
    uint64_t bad_frames;    /* failed their CRC or were no message, both ends */
};

enum server_report_kind {
    REPORT_START,    /* t = 0 */
    REPORT_ROLE,     /* value: enum role */
    REPORT_ELECTION, /* value: term */
    REPORT_VERTEX,   /* value: vertex, was: the one before */
    REPORT_FAULT,    /* value: set of enum fault */
    REPORT_LINK,     /* value: bad frames since boot */
    REPORT_RESTART,  /* a robot lost its mission (it was reset) and is given it again */
    REPORT_EVENT,    /* value: enum event_action */
    REPORT_STRANGER, /* value: the id that a robot says it has, 0 = none */
};

struct server_report {
    enum server_report_kind kind;
    uint16_t robot; /* id, 0 = all */
    uint32_t value, was;
};

/* What the core cannot do itself: power and wheels. */
struct server_order {
    enum event_action action; /* EVENT_KILL, EVENT_REVIVE, EVENT_STALL, EVENT_DRAIN */
    size_t robot;             /* index */
};

struct server;

#define SERVER_NOBODY SIZE_MAX

/* Bytes of memory that server_init() needs, aligned as malloc aligns. */
size_t server_footprint(const struct server_config *config);

/* A server whose robots are all unlinked and whose mission is being uploaded. */
struct server *server_init(void *memory, const struct server_config *config);

/* A robot's link came up or went down. Up: the mission is uploaded from its start. */
void server_link(struct server *server, size_t robot, bool up);

/* Bytes from a robot's link. */
void server_receive(struct server *server, size_t robot, const uint8_t *bytes, size_t count);

/* A robot's newest pose: it goes out with the next bytes taken. */
void server_see(struct server *server, size_t robot, const struct server_pose *pose);

/* One control tick later. */
void server_tick(struct server *server);

/* Ends the wait of a server that `waits`: the mission begins with those that are linked and have
 * acknowledged it, as soon as anyone has. Others join when they do. */
void server_begin(struct server *server);

/* Stops one robot, with SERVER_NOBODY all: it is told that the mission has not begun, and counts as
 * one whose link is down; what it says of its state is still heard. */
void server_halt(struct server *server, size_t robot);

/* Takes it in again: its mission is uploaded from its start. */
void server_resume(struct server *server, size_t robot);

/* Everyone stops, and stays stopped until switched off. */
void server_estop(struct server *server);

/* Carries an event out now, with its report and its order, whatever its moment is. False, and
 * nothing is done, when it names a robot that there is not, or the leader where there is none. */
bool server_act(struct server *server, const struct event *event);

/* A new formation, of 1 to `drawn_vertices`, is copied and takes effect at once, with the report of
 * EVENT_FORMATION. Returns its index, one of SERVER_DRAWN_MAX that follow the configuration's: the
 * drawn one that was there before is gone. None of them is the one in force. */
uint16_t server_draw(struct server *server, const struct server_formation *formation);

/* Writes up to `room` bytes for a robot's link and returns how many: what the link can carry by
 * then, at least once a tick. Different robots' may be called for from different threads, while
 * nothing else is called. */
size_t server_take(struct server *server, size_t robot, uint8_t *bytes, size_t room);

/* Mission time in ms; below 0 until every linked robot has acknowledged the mission. */
int32_t server_time(const struct server *server);

/* Index of a robot that has not acknowledged its mission yet, SERVER_NOBODY when all have. */
size_t server_waits_for(const struct server *server);

/* Index of the leader: the linked robot that leads with the latest term, SERVER_NOBODY. */
size_t server_leader(const struct server *server);

const struct server_view *server_look(const struct server *server, size_t robot);
struct server_counters server_count(const struct server *server);

/* The radio between the robots, as it now is. */
struct server_radio {
    double range, loss, delay; /* m, probability, s */
};

struct server_radio server_radio(const struct server *server);

/* A robot's place in it, and in motion capture. */
struct server_station {
    bool muted;
    uint16_t group;  /* of a partition */
    double pose_age; /* s, at the last tick, since what it was told of its pose was measured; 0: or
                        after that tick; NAN: it is not tracked */
};

struct server_station server_station(const struct server *server, size_t robot);

bool server_estopped(const struct server *server);

/* The formation in force, as an index: of the configuration's, or as server_draw() returned it. */
uint16_t server_formation(const struct server *server);

/* The oldest report or order not yet taken. False when there is none. Both must be drained
 * after every tick; reports beyond four a robot and tick are lost. */
bool server_next_report(struct server *server, struct server_report *report);
bool server_next_order(struct server *server, struct server_order *order);

#endif
