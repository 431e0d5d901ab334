/* robot.h: one simulated robot, whatever computes inside it.
 *
 * The server's tick is the only clock. A period begins at a server tick and lasts TICK_MS:
 *
 *   0            the server has acted; the bytes it sends in this period are known
 *   (j + 1) * B  byte j of them has arrived, B being the time of ten bits
 *   phase        the robot's control tick; it uses the frames whose last byte came before
 *   phase + 5 ms its set-points reach the motors (ACTUATION_MS)
 *   20 ms        what it sent in this period is taken to the server
 *
 * `phase` lies half-way between two bytes, near 5 ms, so that no interrupt's latency can decide
 * on which side of a tick a byte falls. */
#ifndef SIM_ROBOT_H
#define SIM_ROBOT_H

#include "parameters.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define ROBOT_TX_MAX 256

/* How a robot's link is paced, from its baud rate. */
struct link_timing {
    uint32_t baud;
    uint16_t slots;        /* bytes that fit into a period */
    uint16_t before_phase; /* bytes that arrive before the control tick */
};

/* phase = (before_phase + 1/2) * B. */
struct link_timing link_timing_of(uint32_t baud);

/* The control tick's phase and the moment of actuation, s after the start of the period. */
double link_phase_s(const struct link_timing *timing);
double link_actuation_s(const struct link_timing *timing);

/* What a robot did in one period. */
struct robot_period {
    int16_t left, right; /* PWM steps from `phase` + ACTUATION_MS on, +-PWM_STEPS */
    uint16_t sent;       /* bytes in `tx` */
    uint8_t tx[ROBOT_TX_MAX];
    bool crashed; /* the processor stopped: illegal instruction, stack, ... */
};

/* What is known of the processor; all 0 for native robots. */
struct robot_load {
    uint64_t cycles, asleep; /* since power-on */
    uint16_t stack_free;     /* least so far, bytes */
    uint32_t tick_cycles;    /* longest control tick, as the firmware counts it */
};

struct sim_robot;

struct robot_kind {
    /* Power on at the start of a period, which passes in booting: the first tick comes in the
     * next one. False when there is no memory. */
    bool (*power_on)(struct sim_robot *robot);
    void (*power_off)(struct sim_robot *robot);
    /* One period with the bytes that arrive in it, at most timing.slots. May be called for
     * different robots from different threads. */
    void (*run)(struct sim_robot *robot, const uint8_t *rx, size_t count, struct robot_period *out);
    struct robot_load (*load)(const struct sim_robot *robot);
    void (*destroy)(struct sim_robot *robot);
};

struct sim_robot {
    const struct robot_kind *kind;
    uint16_t id;      /* as it was made with */
    uint16_t battery; /* mV, BATTERY_FULL_MV unless set; from the period after on it is measured */
    uint8_t eeprom[PARAMETERS_BYTES]; /* what outlives power: loaded at power-on, and as it was left
                                         after power-off */
};

#define BATTERY_FULL_MV 7400

/* The EEPROM of a new robot: all defaults and `id`; blank for id 0. */
void robot_begin(struct sim_robot *robot, const struct robot_kind *kind, uint16_t id);

/* Gives it other parameters, id and all, from its next power-on on. Before power-on. */
void robot_provision(struct sim_robot *robot, const struct parameters *parameters);

/* What a robot's converter makes of a voltage, mV: 10 bits of its full scale. */
uint16_t robot_battery_measured(uint16_t millivolts);

/* The link rate of native robots, which is the default of the image. */
#define NATIVE_BAUD 115200u

/* A robot whose brain is compiled into this program, with default parameters; id 0: with a blank
 * EEPROM. NULL when there is no memory. */
struct sim_robot *robot_native_new(uint16_t id);

/* The image that ATmega128 robots run, read once and shared. */
struct avr_image;

/* Reads an ELF file. NULL and words in `error` when it is none, none for AVR, or not Muster's
 * (it must define the symbols muster_f_cpu, muster_baud and muster_protocol). */
struct avr_image *avr_image_open(const char *path, char *error, size_t room);
uint32_t avr_image_baud(const struct avr_image *image);
void avr_image_close(struct avr_image *image);

/* One whose brain runs in a simulated ATmega128. The image must outlive it. */
struct sim_robot *robot_avr_new(uint16_t id, struct avr_image *image);

/* One that begins with a boot loader, which can replace its program: its flash outlives power as
 * well. `program` is what it has at first; NULL: nothing. The loader must outlive it. Its control
 * tick stands anywhere in a period, and moves when it is reset. */
struct sim_robot *robot_avr_with_loader(uint16_t id, const struct avr_image *program,
                                        const struct avr_image *loader);

/* NULL where the two fit together, else what lies between the program's name and the loader's in
 * words about it. */
const char *robot_loader_refuses(const struct avr_image *program, const struct avr_image *loader);

/* Power fails in the midst of a period, `seconds` after it began: what it has sent in it is lost, and
 * a page that is being stored holds rubbish. Of robots made by robot_avr_with_loader() alone. */
void robot_loader_cut(struct sim_robot *robot, const uint8_t *rx, size_t count, double seconds);

/* What its flash holds, by common/flash_map.h; of robots made by robot_avr_with_loader() alone. */
const uint8_t *robot_loader_flash(const struct sim_robot *robot);

/* From its next power-on the stack is judged by what SP has been, not by what was written to it:
 * exact, and a twentieth slower. */
void robot_avr_watch_stack(struct sim_robot *robot);

#endif
