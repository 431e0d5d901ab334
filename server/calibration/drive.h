/* drive.h: the drives by which wheels are measured, and the record of one.
 *
 * Pure. Times are seconds since the drive began. */
#ifndef DRIVE_H
#define DRIVE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Farther from where it began than this, m, no robot drives whose wheels are at most a quarter
 * faster or slower than they should be. */
#define DRIVE_ROOM 0.5

/* What a robot's wheels should be: those of the site. */
struct drive_wheels {
    double track;     /* m */
    double wheel_max; /* wheel speed at full PWM, m/s */
};

struct drive_segment {
    double seconds;
    int16_t left, right; /* PWM steps */
};

#define DRIVE_SEGMENTS_MAX 64

struct drive_plan {
    size_t count;
    bool corrected; /* through the robot's gains and dead bands */
    struct drive_segment segment[DRIVE_SEGMENTS_MAX];
};

/* Motors as they are, some 18 s: straight there and back at three speeds, spins both ways at two,
 * each wheel alone. Every piece is driven backwards after it, so it ends where it began. */
void drive_plan_measure(struct drive_plan *plan, const struct drive_wheels *wheels);

/* Wheels as they are corrected, some 6 s: a line, a half circle and a line, and all of that
 * backwards. `track` is what the robot's own is taken for. */
void drive_plan_trial(struct drive_plan *plan, const struct drive_wheels *wheels, double track);

/* The speed of the wheels of drive_plan_measure() that need the most of PWM but one, as a part of
 * full PWM: a dead band must be well below for it to be told from a gain. */
double drive_measured_at(const struct drive_wheels *wheels);

double drive_seconds(const struct drive_plan *plan);

/* What the motors are to do at `t`; NULL when it is over. */
const struct drive_segment *drive_at(const struct drive_plan *plan, double t);

/* A change of what the motors are told, when it was sent. */
struct drive_change {
    double at;
    int16_t left, right;
};

/* Where motion capture saw the robot. */
struct drive_sight {
    double at;
    double x, y, theta; /* m, rad; theta goes on beyond a turn */
};

/* Sights nearer to one another are left out. */
#define DRIVE_SIGHT_SPACING 0.018
#define DRIVE_SIGHTS_MAX 1200

struct drive_record {
    size_t change_count, sight_count;
    struct drive_change change[DRIVE_SEGMENTS_MAX + 1];
    struct drive_sight sight[DRIVE_SIGHTS_MAX];
};

/* Notes what has been sent, unless it is what was sent before. */
void drive_record_sent(struct drive_record *record, double at, int16_t left, int16_t right);

/* Notes a pose; `theta` as it comes, in [-pi, pi]. */
void drive_record_seen(struct drive_record *record, double at, double x, double y, double theta);

#endif
