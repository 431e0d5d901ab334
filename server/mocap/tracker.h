/* tracker.h: from the bodies that motion capture names to the robots' poses.
 *
 * Pure. Bodies are found by name, and by number where the site gives one; positions and headings
 * are turned to z up; a body that jumps is not believed until it is back or a person says so; poses
 * keep the time at which they were measured, judged by the least delayed frame. */
#ifndef TRACKER_H
#define TRACKER_H

#include "capture.h"

enum tracker_up { UP_Z, UP_Y };

struct tracker_settings {
    enum tracker_up up; /* the system's upward axis */
    double scale;       /* m in one unit that the protocol takes for a metre: 0.001 for a system set
                           to mm; 0 stands for 1 */
    double jump;        /* m; a body farther than that from where it was seen last is not believed;
                           0: always is */
    double latency;     /* s from exposure to sending, where the system does not tell it */
};

/* A robot's body. */
struct tracker_body {
    const char *name;
    int32_t id;     /* CAPTURE_ID_NONE: by name alone */
    double heading; /* rad, added to the yaw */
};

/* What is known of a robot's body. */
struct tracker_view {
    bool seen;    /* ever */
    bool tracked; /* in the newest frame that spoke of it, and believed */
    bool jumped;  /* not believed since a jump of `jump` m */
    double jump;
    double x, y, theta;  /* m, rad, as last believed */
    double v, omega;     /* m/s along the heading, rad/s: between the last poses */
    int64_t measured_us; /* when, by loop_now()'s clock */
    uint64_t frames;     /* in which it was tracked and believed */
    bool fresh;          /* by the newest tracker_take() */
};

struct tracker;

size_t tracker_footprint(size_t count);
struct tracker *tracker_init(void *memory, const struct tracker_settings *settings,
                             const struct tracker_body *bodies, size_t count);

/* A frame that arrived at `arrival_us`. Returns how many robots it has news of. */
size_t tracker_take(struct tracker *tracker, const struct capture_frame *frame, int64_t arrival_us);

const struct tracker_view *tracker_look(const struct tracker *tracker, size_t robot);

/* How fast the system's clock goes by ours, 1 being right; NAN where it tells no time or not for a
 * second yet. */
double tracker_clock_rate(const struct tracker *tracker);

/* Every robot is where it is seen next, however far that is. */
void tracker_believe(struct tracker *tracker);

/* The i-th name of a body that is no robot's, NULL beyond the last; a few dozen are remembered. */
const char *tracker_stranger(const struct tracker *tracker, size_t i);

#endif
