/* cameras.h: what motion capture says of the bodies on the ground, and the faults that a person
 * asks of it. Pure. */
#ifndef LIVE_CAMERAS_H
#define LIVE_CAMERAS_H

#include "capture.h"
#include "ground.h"
#include "mocap.h"

struct cameras;

/* Cameras that see the scenario's robots as "RobotN" with the number N, in axes whose z or y points
 * up. NULL when there are more than CAPTURE_BODIES_MAX of them, or no memory. */
struct cameras *cameras_new(const struct scenario *scenario, bool y_up, int64_t now_us);
void cameras_free(struct cameras *cameras);

/* Looks at the bodies as they are; `periods` have passed since the last time. */
void cameras_look(struct cameras *cameras, const struct ground *ground, uint64_t periods,
                  int64_t now_us);

/* What was seen last. The names and numbers are there from the beginning. */
const struct capture_frame *cameras_frame(const struct cameras *cameras);

/* Whether frames are held back. */
bool cameras_frozen(const struct cameras *cameras);

/* s since the cameras were started. */
double cameras_time(const struct cameras *cameras, int64_t now_us);

/* Carries out one line: `lose ID` and `find ID`, `jump ID METRES` (its place is told wrongly by
 * that, along x), `freeze` and `thaw` (no frames in between), `restart` (frames and time begin
 * again). False, and what is allowed in `words`, when it is none of them. */
bool cameras_command(struct cameras *cameras, const char *line, int64_t now_us, char *words,
                     size_t room);

#endif
