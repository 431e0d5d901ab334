/* arguments.h: what several commands read from the command line alike. What is not allowed ends the
 * program with STATUS_USAGE. */
#ifndef ARGUMENTS_H
#define ARGUMENTS_H

#include "sim.h"

#include <argp.h>
#include <stdbool.h>
#include <stdint.h>

#define THREADS_MAX 256

/* A whole number from `low` to `high`; `option` is named where it is none. */
uint64_t argument_number(struct argp_state *state, const char *option, const char *text,
                         uint64_t low, uint64_t high);

/* --speed: times real time, or max, which is 0. */
double argument_speed(struct argp_state *state, const char *text);

/* --view: where; NULL: where it is by default. The options point into `place`. */
void argument_view(struct argp_state *state, char *place, struct view_options *options);

/* --robots: avr or native. */
enum sim_robots argument_robots(struct argp_state *state, const char *text);

/* As many threads as there are processors, unless --threads says otherwise. */
unsigned argument_threads_default(void);

/* False, having said so and how to get one, when robots of this kind need an image and there is
 * none. */
bool argument_firmware_exists(const char *command, enum sim_robots robots, const char *firmware);

#endif
