/* limits.h: the sizes and times on which robots and host agree. */
#ifndef LIMITS_H
#define LIMITS_H

/* Robot ids are 1..ROBOT_ID_MAX; 0 says "nobody". */
#define ROBOT_ID_MAX 65534u

/* Vertices a robot can hold. The ATmega128 has RAM for VERTICES_MAX_CHIP; a host build holds more,
 * which changes what is refused and nothing else. */
#define VERTICES_MAX_CHIP 128
#ifndef VERTICES_MAX
#define VERTICES_MAX VERTICES_MAX_CHIP
#endif

/* Neighbours a robot remembers; the farthest that is no candidate makes room for a nearer one. */
#ifndef NEIGHBOURS_MAX
#define NEIGHBOURS_MAX 32
#endif

/* Trajectory knots a candidate holds at once: a window that the server keeps filled. */
#define KNOTS_MAX 32

/* The longest time between two knots, ms. Keeps every product of trajectory.c within 32 bits. */
#define KNOT_SPACING_MAX_MS 1000

/* The control tick of robots and server: 50 Hz. */
#define TICK_MS 20
#define TICKS_PER_S (1000 / TICK_MS)

/* Mission time, ms, that robots hear while they are told what to do, and those that are to stand:
 * far enough below 0 that none reaches it by going on by itself, or by what it adds for latency. */
#define PREPARE_MS (-60000)

/* From a robot's tick to the moment its new set-points drive the motors, ms. */
#define ACTUATION_MS 5

/* Full scale of a wheel's set-point in PWM steps: 14 bits, 976 Hz at 16 MHz. */
#define PWM_STEPS 16383

/* Positions on the wire are 24 bits of 1/4 mm: +-2,097 m. */
#define POSITION_MAX_M 2097.0

#endif
