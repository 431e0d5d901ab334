/* brain.h: everything a robot decides, without a register in it.
 *
 * A board feeds every byte that its link receives to brain_bytes(), and 50 times a second
 * (TICK_MS) calls brain_step(), which says what the motors shall do and what to send. The brain
 * knows no clock but the calls of brain_step(), allocates nothing and waits for nothing.
 *
 * Rule of the tick: brain_step() must have seen exactly the bytes that arrived before the tick
 * fired. A board that decodes late marks where its receive ring stood at the tick and stops
 * there; this makes a run depend on when bytes arrive and never on how fast they are decoded. */
#ifndef BRAIN_H
#define BRAIN_H

#include "allocation.h"
#include "charge.h"
#include "clock.h"
#include "election.h"
#include "formation.h"
#include "keeper.h"
#include "message.h"
#include "mission.h"
#include "motion.h"
#include "neighbours.h"
#include "supervisor.h"
#include "wheels.h"

/* What the board knows of itself. */
struct brain_input {
    uint16_t battery;     /* mV; 0: not measured yet */
    uint16_t overruns;    /* bytes lost in the receiver since boot */
    uint16_t tick_cycles; /* longest control tick since boot, units of 8 cycles */
    uint16_t stack_free;  /* bytes never used */
    uint8_t reset_cause;  /* MCUSR at boot */
    uint8_t stored;       /* what the EEPROM holds at the place of the output before */
    uint16_t resets;      /* since power-on */
    uint32_t image;       /* CRC-32 of the program (flash_map.h); 0xFFFFFFFF: it is not sealed */
};

/* A beacon, and a status or an answer. */
#define BRAIN_FRAMES_MAX (FRAME_BYTES(BEACON_BYTES) + FRAME_BYTES(STATUS_BYTES))

struct brain_output {
    int16_t left, right; /* wheel set-points in PWM steps, +-PWM_STEPS; 0 = motors off. They
                            take effect ACTUATION_MS after the tick */
    bool leave;          /* for the boot loader, where there is one */
    struct store store;  /* done long before the next tick, and without being waited for */
    uint8_t length;      /* bytes to send, in this order */
    uint8_t frames[BRAIN_FRAMES_MAX];
};

struct brain {
    uint16_t id; /* 0 = none */
    uint8_t tick;
    struct keeper keeper;
    struct frame_decoder decoder;
    struct clock clock;
    struct mission mission;
    struct neighbours neighbours;
    struct election election;
    struct allocation_state allocation;
    struct stall stall;
    struct charge charge;
    uint8_t state; /* enum supervisor_state */
    bool estopped;
    bool leaves; /* for the boot loader, in this tick */
    bool status_due;
    uint8_t status_wait; /* ticks until the next status even so */
    uint8_t slot;        /* which of ten ticks this is, by mission time and id: when to send */
    uint8_t faults;
    uint16_t bad_frames;

    /* The last pose from the server, when it came, and what was commanded since. */
    bool posed;
    int32_t pose_time;
    struct pose pose;
    uint8_t pose_age; /* ticks since it came, and since anything came; stop at 255 */
    uint8_t link_age;
    struct motion_command command;
    struct motion_command moving; /* what the wheels have made of it by now */
    struct motion_memory motion;
    struct wheels wheels;

    struct message_drive drive;
    uint8_t drive_age; /* as pose_age */

    uint8_t approach; /* ticks of its way to the reference, to replace a leader that leads on; 0:
                         none */
    uint16_t about;   /* id of the robot last followed; a candidate coasts about it in C */

    /* Where to be in the frame of the leader: outlives the vertex while a formation arrives. */
    bool has_goal;
    uint8_t goal_scale;
    struct vec16 goal;
};

/* A robot that has just been switched on, with what its EEPROM holds (parameters.h). Where that
 * gives no id, it has none and will never move. */
void brain_init(struct brain *brain, const uint8_t eeprom[PARAMETERS_BYTES]);

/* Takes bytes from the link, `from` up to `end`. */
void brain_bytes(struct brain *brain, const uint8_t *from, const uint8_t *end);

/* The control tick. */
void brain_step(struct brain *brain, const struct brain_input *input, struct brain_output *output);

#endif
