/* radio.h: the radio link between the host and a robot: bytes in order, late by whole ticks. */
#ifndef RADIO_H
#define RADIO_H

#include "scenario.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The longest delay that can be asked for, ticks. */
#define RADIO_TICKS_MAX 4

/* Bytes put in at tick n come out at one of the ticks n + least to n + least + jitter, all as
 * likely. least + jitter <= RADIO_TICKS_MAX. */
struct radio {
    unsigned least, jitter; /* ticks */
    uint64_t seed;
};

/* An ideal robot's link is a cable; a small one's is that of an HC-06. */
struct radio radio_of(const struct scenario *scenario, uint64_t seed);

/* Nothing that it carries is ever late. */
bool radio_is_cable(const struct radio *radio);

enum radio_way { RADIO_DOWN, RADIO_UP };

/* One way of one robot's link, empty. NULL when there is no memory. In no tick are more than
 * `burst` bytes put in or fewer than that asked for. */
struct radio_pipe *radio_pipe_new(const struct radio *radio, uint16_t robot, enum radio_way way,
                                  size_t burst);
void radio_pipe_free(struct radio_pipe *pipe);

/* Sends bytes at `tick`, at most once a tick. */
void radio_put(struct radio_pipe *pipe, uint64_t tick, const uint8_t *bytes, size_t count);

/* Takes what has arrived by `tick`, up to `room` bytes; the rest comes next time. To be called
 * at every tick, after radio_put(). */
size_t radio_take(struct radio_pipe *pipe, uint64_t tick, uint8_t *bytes, size_t room);

/* Forgets what is on its way: the link was lost. */
void radio_clear(struct radio_pipe *pipe);

#endif
