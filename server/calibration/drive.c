#include "drive.h"

#include "limits.h"

#include <math.h>

/* No piece of a drive is meant to go farther, m. */
#define REACH 0.28

/* No piece takes longer, s. */
#define PIECE_S 1.0

/* What motors do between two pieces, s, and at both ends. */
#define REST_S 0.15
#define STAND_S 0.4

/* Wheels are driven at these parts of full PWM, or of what makes them as fast as FAST. */
#define LOW 0.25
#define MIDDLE 0.5
#define HIGH 0.85
#define FAST 0.6 /* m/s */

/* Turning no faster than this, rad/s, a heading is never lost in the longest gap between poses. */
#define SPIN_MAX 6.0
#define SPIN_S 0.6
#define SWING_S 0.8

/* The trial's way. */
#define TRIAL_SPEED 0.18 /* m/s */
#define TRIAL_PART 0.5   /* of full PWM is the most a wheel needs */
#define TRIAL_LINE 0.12  /* m */
#define TRIAL_RADIUS 0.08

/* ---- pieces ---------------------------------------------------------------------------- */

static int16_t steps_of(double part)
{
    return (int16_t)lround(fmax(-1, fmin(1, part)) * PWM_STEPS);
}

static void go(struct drive_plan *plan, double seconds, double left, double right)
{
    plan->segment[plan->count++] = (struct drive_segment){
        .seconds = seconds,
        .left = steps_of(left),
        .right = steps_of(right),
    };
}

static void there_and_back(struct drive_plan *plan, double seconds, double left, double right)
{
    go(plan, seconds, left, right);
    go(plan, REST_S, 0, 0);
    go(plan, seconds, -left, -right);
    go(plan, REST_S, 0, 0);
}

/* A part of full PWM, for wheels that may be too fast for it in this room. */
static double part_of(const struct drive_wheels *wheels, double part)
{
    return part * fmin(1, FAST / wheels->wheel_max);
}

static void straight(struct drive_plan *plan, const struct drive_wheels *wheels, double part)
{
    double steps = part_of(wheels, part);
    double seconds = fmin(PIECE_S, REACH / (fabs(steps) * wheels->wheel_max));

    there_and_back(plan, seconds, steps, steps);
}

static void spin(struct drive_plan *plan, const struct drive_wheels *wheels, double part)
{
    double fastest = SPIN_MAX * wheels->track / 2 / wheels->wheel_max;
    double steps = part * fmin(fastest, part_of(wheels, HIGH));

    there_and_back(plan, SPIN_S, -steps, steps);
}

/* ---- plans ----------------------------------------------------------------------------- */

double drive_measured_at(const struct drive_wheels *wheels)
{
    return part_of(wheels, MIDDLE);
}

void drive_plan_measure(struct drive_plan *plan, const struct drive_wheels *wheels)
{
    double swing = part_of(wheels, MIDDLE);

    *plan = (struct drive_plan){.corrected = false};
    go(plan, STAND_S, 0, 0);
    straight(plan, wheels, LOW);
    straight(plan, wheels, MIDDLE);
    straight(plan, wheels, HIGH);
    spin(plan, wheels, 0.5);
    spin(plan, wheels, 1);
    there_and_back(plan, SWING_S, swing, 0);
    there_and_back(plan, SWING_S, 0, swing);
    spin(plan, wheels, -1);
    straight(plan, wheels, -MIDDLE);
    straight(plan, wheels, -HIGH);
    go(plan, STAND_S, 0, 0);
}

void drive_plan_trial(struct drive_plan *plan, const struct drive_wheels *wheels, double track)
{
    double widen = track / 2 / TRIAL_RADIUS;
    double speed = fmin(TRIAL_SPEED, TRIAL_PART * wheels->wheel_max / (1 + widen));
    double part = speed / wheels->wheel_max;

    *plan = (struct drive_plan){.corrected = true};
    go(plan, STAND_S, 0, 0);
    for (int way = 1; way >= -1; way -= 2) {
        go(plan, TRIAL_LINE / speed, way * part, way * part);
        go(plan, M_PI * TRIAL_RADIUS / speed, way * part * (1 - widen), way * part * (1 + widen));
        go(plan, TRIAL_LINE / speed, way * part, way * part);
        go(plan, REST_S, 0, 0);
    }
    go(plan, STAND_S, 0, 0);
}

double drive_seconds(const struct drive_plan *plan)
{
    double seconds = 0;

    for (size_t i = 0; i < plan->count; i++)
        seconds += plan->segment[i].seconds;
    return seconds;
}

const struct drive_segment *drive_at(const struct drive_plan *plan, double t)
{
    for (size_t i = 0; i < plan->count; i++) {
        t -= plan->segment[i].seconds;
        if (t < 0)
            return &plan->segment[i];
    }
    return NULL;
}

/* ---- records --------------------------------------------------------------------------- */

void drive_record_sent(struct drive_record *record, double at, int16_t left, int16_t right)
{
    size_t count = record->change_count;
    const struct drive_change *last = count > 0 ? &record->change[count - 1] : NULL;

    if (last != NULL && last->left == left && last->right == right)
        return;
    if (count < sizeof record->change / sizeof record->change[0])
        record->change[record->change_count++] = (struct drive_change){at, left, right};
}

void drive_record_seen(struct drive_record *record, double at, double x, double y, double theta)
{
    size_t count = record->sight_count;
    const struct drive_sight *last = count > 0 ? &record->sight[count - 1] : NULL;

    if (count == DRIVE_SIGHTS_MAX || (last != NULL && at - last->at < DRIVE_SIGHT_SPACING))
        return;
    if (last != NULL)
        theta = last->theta + remainder(theta - last->theta, 2 * M_PI);
    record->sight[record->sight_count++] = (struct drive_sight){at, x, y, theta};
}
