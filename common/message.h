/* message.h: every message between the host server and a robot, one place for every byte.
 *
 * docs/PROTOCOL.md is the same in prose. All numbers are little-endian; units are those of
 * fixed.h. A version of the protocol only ever appends fields: a reader takes the fields it
 * knows, ignores what follows, and refuses a message shorter than version 1 made it. */
#ifndef MESSAGE_H
#define MESSAGE_H

#include "fixed.h"
#include "frame.h"
#include "limits.h"

#include <stdbool.h>
#include <stdint.h>

#define PROTOCOL_VERSION 1

enum message_type {
    MESSAGE_POSE = 0x01,      /* server -> robot: where it is */
    MESSAGE_KEEPALIVE = 0x02, /* server -> robot: the link is up, though there is no pose */
    MESSAGE_MISSION = 0x03,   /* server -> robot, in order: begin; parameters */
    MESSAGE_VERTICES = 0x04,  /* server -> robot, in order: part of a formation */
    MESSAGE_KNOT = 0x05,      /* server -> candidate, in order: one knot of the trajectory */
    MESSAGE_ASSIGN = 0x06,    /* server -> robot, in order: hold this vertex */
    MESSAGE_ESTOP = 0x07,     /* server -> robot: stop and stay stopped */
    MESSAGE_BEACON = 0x10,    /* robot -> robots: the paper's packet */
    MESSAGE_STATUS = 0x11,    /* robot -> server: acknowledgement and health */
};

/* The paper's roles (figure 3). */
enum role { ROLE_CANDIDATE = 0, ROLE_LEADER = 1, ROLE_FOLLOWER = 2 };

enum motion_law { LAW_FL = 0, LAW_KANAYAMA = 1, LAW_PID = 2 };
enum allocation { ALLOCATION_CPA = 0, ALLOCATION_CPA_LITERAL = 1, ALLOCATION_ASSIGNED = 2 };

#define POSE_BYTES 13

/* POSE_BYTES. `time` is mission time in ms at the moment the pose was measured; below 0 the
 * mission has not started. */
struct message_pose {
    int32_t time;
    struct pose pose;
};

/* 5 bytes. */
struct message_keepalive {
    int32_t time;
};

/* Messages that must arrive, in order, carry `sequence`; a robot takes only the one it expects
 * and acknowledges by MESSAGE_STATUS. MISSION is always number 0 and starts the count anew.
 * 20 bytes. */
struct message_mission {
    uint8_t sequence;
    uint8_t version;     /* PROTOCOL_VERSION of the server */
    uint8_t mission;     /* 1..255, another one for every mission */
    bool candidate;      /* this robot may lead */
    uint8_t law;         /* enum motion_law */
    uint8_t allocation;  /* enum allocation */
    uint16_t k, k_theta; /* gains, Q8.8 */
    int16_t v_max;       /* narrow, > 0 */
    int16_t omega_max;   /* rate, > 0 */
    int16_t track;       /* distance between the wheels, narrow, > 0 */
    int16_t wheel_max;   /* wheel speed at PWM_STEPS, narrow, > 0 */
    uint8_t latency;     /* from a pose's measurement to the tick that uses it, ms */
};

/* A vertex of the formation (equation 2): distance, narrow wide enough for 2,097 m, and angle. */
struct polar_vertex {
    int32_t distance; /* wide, 24 bits, may be negative */
    angle_t psi;
};

#define VERTICES_PER_MESSAGE 8

/* 9 + 5 * count bytes, at most 49. */
struct message_vertices {
    uint8_t sequence;
    uint8_t formation; /* 1..255, another one for every change of formation */
    uint8_t scale;     /* see formation.h */
    uint16_t total;    /* vertices of the formation */
    uint16_t first;    /* index from 0 of the first one in this message */
    uint8_t count;     /* 1..VERTICES_PER_MESSAGE */
    struct polar_vertex vertex[VERTICES_PER_MESSAGE];
};

/* The reference at one moment (trajectory.h). 18 bytes with type and sequence. */
struct knot {
    int32_t time; /* ms of mission time, a multiple of TICK_MS */
    struct pose pose;
    int16_t v;     /* narrow */
    int16_t omega; /* rate */
};

struct message_knot {
    uint8_t sequence;
    struct knot knot;
};

/* 4 bytes. */
struct message_assign {
    uint8_t sequence;
    uint16_t vertex; /* 1..n, 0 = none */
};

#define BEACON_BYTES 24
#define STATUS_BYTES 21

/* The packet of section 2: BEACON_BYTES, 28 on the link. */
struct message_beacon {
    uint16_t id;
    uint16_t time; /* mission time of the pose, ms modulo 65,536 */
    struct pose pose;
    int16_t v, omega; /* what the robot is commanded to do: narrow, rate */
    uint8_t role;     /* enum role */
    bool candidate;
    bool fault;         /* it cannot do its part; a leader that says so is replaced */
    bool to_all;        /* sent with the candidates' long range */
    uint16_t term;      /* number of the election its leader won */
    uint8_t leader_age; /* ticks from hearing any word of that leader to `time`; 255: or more */
    uint16_t vertex;    /* held vertex 1..n, 0 = none */
    uint8_t formation;
};

/* Why a robot stands or flags a fault: bits of message_status.faults. */
enum fault {
    FAULT_NO_ID = 1,      /* EEPROM holds no id */
    FAULT_POSE_STALE = 2, /* no pose for 300 ms */
    FAULT_LINK_LOST = 4,  /* nothing from the server for 500 ms */
    FAULT_STALL = 8,      /* commanded to move, did not */
    FAULT_ESTOP = 16,     /* emergency stop, latched */
    FAULT_REFUSED = 32,   /* the mission was not one this robot can do */
};

/* What a robot may do. */
enum supervisor_state {
    STATE_BOOT,  /* no id: never moves */
    STATE_IDLE,  /* no mission */
    STATE_READY, /* mission known; waits for its start and a fresh pose */
    STATE_RUN,   /* the only state in which the motors may turn */
    STATE_HOLD,  /* was running; pose stale or link lost */
    STATE_ESTOP, /* emergency stop; only a power cycle leaves it */
};

/* STATUS_BYTES. */
struct message_status {
    uint16_t id;
    uint8_t version;  /* PROTOCOL_VERSION of the robot */
    uint8_t mission;  /* 0 = none */
    uint8_t expected; /* sequence number of the next ordered message */
    uint8_t state;    /* enum supervisor_state */
    uint8_t faults;
    uint8_t reset_cause;   /* MCUSR at boot */
    uint16_t battery;      /* mV */
    uint16_t bad_frames;   /* too long, cut short or failed CRC, since boot; stops at 65,535 */
    uint16_t overruns;     /* bytes lost in the receiver, likewise */
    uint16_t tick_cycles;  /* longest control tick since boot, units of 8 CPU cycles */
    uint16_t stack_free;   /* bytes of RAM never used */
    uint16_t vertices_max; /* the largest formation it can hold */
};

struct message {
    uint8_t type; /* enum message_type, or one that this side does not know */
    union {
        struct message_pose pose;
        struct message_keepalive keepalive;
        struct message_mission mission;
        struct message_vertices vertices;
        struct message_knot knot;
        struct message_assign assign;
        struct message_beacon beacon;
        struct message_status status;
    };
};

/* Writes the payload, FRAME_PAYLOAD_MAX bytes at most, and returns its length. */
uint8_t message_write(uint8_t *payload, const struct message *message);

/* The two that robots send. */
uint8_t message_write_beacon(uint8_t *payload, const struct message_beacon *beacon);
uint8_t message_write_status(uint8_t *payload, const struct message_status *status);

/* Reads a payload. False when it is empty, shorter than its type requires or out of range in a
 * field that has one; an unknown type is read as true with nothing but `type`. */
bool message_read(struct message *message, const uint8_t *payload, uint8_t length);

#endif
