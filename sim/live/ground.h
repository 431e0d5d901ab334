/* ground.h: bodies that move by the set-points that robots send, whenever these come.
 *
 * Pure: time is an argument, us of any clock that goes on evenly, and never goes back. Motion is
 * exact between changes of set-points, however seldom it is looked at. */
#ifndef LIVE_GROUND_H
#define LIVE_GROUND_H

#include "body.h"
#include "setpoints.h"

/* A robot from which nothing has come for so long has no power. */
#define GROUND_SILENCE_US 100000

struct ground;

/* The scenario's robots where they start, without power. NULL when there is no memory. */
struct ground *ground_new(const struct scenario *scenario, int64_t now_us);
void ground_free(struct ground *ground);

/* What a robot's tick decided: takes effect ACTUATION_MS from now. A robot that is not there is
 * ignored. */
void ground_set(struct ground *ground, struct setpoint setpoint, int64_t now_us);

/* Moves all to this moment. */
void ground_move(struct ground *ground, int64_t now_us);

/* The body of the scenario's i-th robot when it was moved last. */
const struct body *ground_look(const struct ground *ground, size_t i);

#endif
