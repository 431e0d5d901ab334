/* server_state.h: the server core's own memory, seen by its parts only.
 *
 *   server.c           life, time, links, what may be looked at
 *   uplink.c           what robots say
 *   downlink.c         what robots are told
 *   events.c           what the scenario does
 *   drawn.c            the formation in force, and those drawn while it runs
 *   host_allocation.c  vertices given out by the host, for comparison with the robots' own way
 */
#ifndef SERVER_STATE_H
#define SERVER_STATE_H

#include "assignment.h"
#include "network.h"
#include "outbox.h"
#include "server.h"
#include "upload.h"

#define NO_VERTEX UINT16_MAX

/* A robot or a vertex to be matched. */
struct site {
    double x, y; /* m */
    size_t name; /* the robot's index, the vertex's number */
};

struct member {
    struct server_view view;
    struct frame_decoder decoder;
    struct upload upload;
    uint8_t mission; /* the upload's number, on the wire */
    struct server_pose pose;
    uint32_t beacons;           /* heard, numbers them for the loss */
    uint8_t uploaded_formation; /* number, 0 = none */
    uint16_t uploaded_vertex;   /* NO_VERTEX = none */
    uint16_t assigned;          /* vertex it should hold, with rigid and optimal */
    uint32_t next_knot;
    uint16_t bad_frames; /* it has reported */
    uint64_t bytes;      /* taken for its link */
    bool pose_due;
    bool wired;    /* has a link, whether it takes part or not */
    bool met;      /* has told of itself since its link came up */
    uint64_t told; /* tick of the last keep-alive */
    bool known;    /* has sent a beacon since its link came up */
};

struct server {
    const struct server_config *config;
    uint64_t tick;
    int32_t time;
    bool started;
    bool begun; /* server_begin() */
    bool estopped;
    uint64_t estop_tick;
    uint16_t formation;         /* index */
    uint8_t formation_number;   /* on the wire, 1..255 */
    uint16_t formation_of[256]; /* index by number */
    struct server_formation *drawn;
    struct polar_vertex *drawn_vertex; /* config->drawn_vertices of each */
    size_t drawn_next;                 /* place of the next one, unless it is in force */
    uint32_t knot;                     /* in force */
    size_t leader;
    bool assign_due;
    uint64_t received_frames, received_bytes, bad_frames;
    struct network network;
    struct member *member;
    struct outbox *outbox;
    bool *event_done;
    struct assignment_node *nodes;
    uint32_t *chosen;
    struct site *followers, *vertices;
    size_t report_room, report_first, report_count;
    struct server_report *report;
    size_t order_room, order_count, order_first;
    struct server_order *order;
};

/* server.c */
void server_add_report(struct server *s, enum server_report_kind kind, size_t robot, uint32_t value,
                       uint32_t was);
void server_add_order(struct server *s, enum event_action action, size_t robot);
uint32_t server_ticks_of(double seconds);                      /* nearest */
void server_meet(struct server *s, size_t robot, uint16_t id); /* a robot says its id */

/* downlink.c */
void downlink_begin(struct server *s, size_t robot); /* uploads the mission from its start */
void downlink_tick(struct server *s, size_t robot);  /* adds what the mission now asks for */
bool takes_part(const struct server *s, size_t robot);
bool host_allocates(const struct server *s);

/* drawn.c */
void server_take_formation(struct server *s, uint16_t formation);
const struct server_formation *server_formation_at(const struct server *s, uint16_t formation);

/* events.c */
void events_run(struct server *s);

/* host_allocation.c: does nothing while robots allocate, or there is no leader. */
void host_allocate(struct server *s);

#endif
