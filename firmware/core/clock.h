/* clock.h: a robot's idea of mission time.
 *
 * Nothing can be heard before it was measured, so every time stamp heard is a lower bound for
 * now. The clock goes on by one tick a tick and jumps forward to any stamp beyond it; a slow leak
 * lets it follow a crystal that runs fast. What results is the stamp of the least delayed
 * message, whatever the jitter of the others. */
#ifndef CLOCK_H
#define CLOCK_H

#include <stdbool.h>
#include <stdint.h>

struct clock {
    bool set;
    bool heard;   /* `stamp` is new since the last tick */
    uint8_t leak; /* ticks since the last lost millisecond */
    int32_t now;  /* mission time at the last tick, ms */
    int32_t stamp;
};

/* A message from the server says that it is `time` (ms) now. */
void clock_heard(struct clock *clock, int32_t time);

/* Another candidate sent the state it had at `time` (ms modulo 65,536): candidates keep one
 * another's clocks, and so their references, together. Ignored while the clock is not set. */
void clock_heard_beacon(struct clock *clock, uint16_t time);

/* One tick later. True when the time was set anew (first message, other server, countdown):
 * times kept from before mean nothing then. */
bool clock_tick(struct clock *clock);

/* Age in ms of a state stamped `time` (ms modulo 65,536), 0 when it lies ahead. */
uint16_t clock_age(const struct clock *clock, uint16_t time);

#endif
