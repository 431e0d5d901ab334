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
    MESSAGE_ASK = 0x08,       /* server -> robot: read or change a parameter */
    MESSAGE_DRIVE = 0x09,     /* server -> robot: turn the wheels like this, for a moment */
    MESSAGE_LOADER = 0x0A,    /* server -> robot: leave for the boot loader */
    MESSAGE_BEACON = 0x10,    /* robot -> robots: the paper's packet */
    MESSAGE_STATUS = 0x11,    /* robot -> server: acknowledgement and health */
    MESSAGE_ANSWER = 0x12,    /* robot -> server: to MESSAGE_ASK */
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

/* What MESSAGE_ASK wants. */
enum parameter_action {
    PARAMETER_GET,
    PARAMETER_SET,   /* in RAM, in force at once */
    PARAMETER_SAVE,  /* all of them, to the EEPROM; answered when they are there, within 2 s */
    PARAMETER_RESET, /* all but the id to their defaults, in RAM */
};

/* 8 bytes. Asked again with the same tag it is answered again; a robot has room for one. */
struct message_ask {
    uint8_t tag;    /* comes back in the answer */
    uint8_t action; /* enum parameter_action */
    uint8_t index;  /* parameter_table.h; of no meaning to SAVE and RESET */
    uint32_t value; /* of SET */
};

enum parameter_result {
    PARAMETER_DONE,
    PARAMETER_UNKNOWN,   /* no such index or action: this robot's table is shorter */
    PARAMETER_READ_ONLY, /* a reading */
    PARAMETER_RANGE,     /* the table allows other values */
    PARAMETER_BUSY,      /* a mission is under way: the id stays; or a save is */
    PARAMETER_BROKEN,    /* the EEPROM does not hold what was written to it */
};

/* 10 bytes. */
struct message_answer {
    uint16_t id; /* of the robot */
    uint8_t tag;
    uint8_t result; /* enum parameter_result */
    uint8_t index;
    uint32_t value; /* of that parameter now, whatever the result */
};

/* 6 bytes. The wheels turn so until a fresher one comes, 200 ms at the most, and only where no
 * mission is under way. */
struct message_drive {
    int16_t left, right; /* +-PWM_STEPS */
    bool corrected;      /* through the robot's gains and dead bands; else as they are */
};

#define BEACON_BYTES 24
#define STATUS_BYTES 21
#define ANSWER_BYTES 10

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
    FAULT_BATTERY = 64,   /* below battery_critical for 1 s, latched: it hands over and stops */
    WARN_BATTERY = 128,   /* below battery_warning: no fault, it goes on */
};

/* What a robot may do. */
enum supervisor_state {
    STATE_BOOT,  /* no id: never moves */
    STATE_IDLE,  /* no mission */
    STATE_READY, /* mission known; waits for its start and a fresh pose */
    STATE_RUN,   /* on its mission: beside STATE_TRIAL where the motors may turn */
    STATE_HOLD,  /* was running; pose stale or link lost */
    STATE_ESTOP, /* emergency stop; only a power cycle leaves it */
    STATE_TRIAL, /* no mission under way; turns its wheels as MESSAGE_DRIVE says, while it does */
    STATE_SPENT, /* battery critical: has handed over and stands; only a power cycle leaves it */
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
        struct message_ask ask;
        struct message_drive drive;
        struct message_beacon beacon;
        struct message_status status;
        struct message_answer answer;
    };
};

/* Writes the payload, FRAME_PAYLOAD_MAX bytes at most, and returns its length. */
uint8_t message_write(uint8_t *payload, const struct message *message);

/* Those that robots send. */
uint8_t message_write_beacon(uint8_t *payload, const struct message_beacon *beacon);
uint8_t message_write_status(uint8_t *payload, const struct message_status *status);
uint8_t message_write_answer(uint8_t *payload, const struct message_answer *answer);

/* Reads a payload. False when it is empty, shorter than its type requires or out of range in a
 * field that has one; an unknown type is read as true with nothing but `type`. */
bool message_read(struct message *message, const uint8_t *payload, uint8_t length);

#endif
