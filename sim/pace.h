/* pace.h: when the next tick of a simulation is due by the clock on the wall. Pure. */
#ifndef PACE_H
#define PACE_H

#include <stdbool.h>
#include <stdint.h>

struct pace {
    double speed; /* times real time; 0: as fast as it goes */
    bool paused;
    bool step;      /* one tick is due all the same */
    int64_t due_ns; /* the next tick */
};

#define PACE_NEVER INT64_MAX

/* The first tick is due now. */
void pace_begin(struct pace *pace, double speed, int64_t now_ns);

/* From now on. What was late is not made up for. */
void pace_set_speed(struct pace *pace, double speed, int64_t now_ns);
void pace_pause(struct pace *pace, bool paused, int64_t now_ns);

/* One tick, though it is paused. */
void pace_step(struct pace *pace);

/* How long it is until the next tick is due; 0: it is, PACE_NEVER: paused. */
int64_t pace_wait_ns(const struct pace *pace, int64_t now_ns);

/* It is done. A simulation that is late makes up for 100 ms at the most. */
void pace_tick(struct pace *pace, int64_t now_ns);

#endif
