#include "body.h"

#include "chance.h"
#include "limits.h"

#include <math.h>

#define IDEAL_TRACK 0.1

/* The paper's robot is 110 x 80 mm; speed and lag are those of the geared motors of its kind. */
#define SMALL_TRACK 0.08
#define SMALL_WHEEL_MAX 0.6
#define SMALL_LAG 0.05

/* While wheels change speed the arc is integrated in steps no longer than this, s. */
#define LAG_STEP 0.001

/* Any will do: robots differ by their ids. */
#define SEED 1

enum part {
    PART_LEFT_GAIN,
    PART_RIGHT_GAIN,
    PART_LEFT_DEAD,
    PART_RIGHT_DEAD,
    PART_TRACK,
    PART_LAG
};

struct body_kind body_kind_nominal(const struct scenario *scenario)
{
    struct body_kind kind = {
        .track = IDEAL_TRACK,
        .wheel_max = scenario->v_max + scenario->omega_max * IDEAL_TRACK / 2,
        .left.gain = 1,
        .right.gain = 1,
    };

    if (scenario->body == BODY_SMALL) {
        kind.track = SMALL_TRACK;
        kind.wheel_max = SMALL_WHEEL_MAX;
        kind.lag = SMALL_LAG;
    }
    return kind;
}

/* 0 to below 1. */
static double draw(uint16_t id, enum part part)
{
    return chance_unit(chance_draw(SEED, CHANCE_BODY, (uint64_t)id << 8 | part));
}

/* 1 - most to 1 + most. */
static double factor(uint16_t id, enum part part, double most)
{
    return 1 + most * (2 * draw(id, part) - 1);
}

struct body_kind body_kind_of(const struct scenario *scenario, uint16_t id)
{
    struct body_kind kind = body_kind_nominal(scenario);
    double scatter = scenario->scatter;
    double dead_max = scatter / 2 * PWM_STEPS;

    kind.left = (struct wheel_kind){
        .gain = factor(id, PART_LEFT_GAIN, scatter),
        .dead_band = draw(id, PART_LEFT_DEAD) * dead_max,
    };
    kind.right = (struct wheel_kind){
        .gain = factor(id, PART_RIGHT_GAIN, scatter),
        .dead_band = draw(id, PART_RIGHT_DEAD) * dead_max,
    };
    kind.track *= factor(id, PART_TRACK, scatter / 5);
    kind.lag *= factor(id, PART_LAG, scatter);
    return kind;
}

double body_v(const struct body *body)
{
    return (body->left + body->right) / 2;
}

double body_omega(const struct body_kind *kind, const struct body *body)
{
    return (body->right - body->left) / kind->track;
}

/* Equation 1 at constant v and omega, exactly: along the chord of the arc. */
static void follow_arc(const struct body_kind *kind, struct body *body, double seconds)
{
    if (seconds == 0)
        return;
    double half = body_omega(kind, body) * seconds / 2;
    double chord = body_v(body) * seconds * (fabs(half) < 1e-6 ? 1 : sin(half) / half);

    body->x += chord * cos(body->theta + half);
    body->y += chord * sin(body->theta + half);
    body->theta = remainder(body->theta + 2 * half, 2 * M_PI);
}

double body_wheel_speed(const struct body_kind *kind, const struct wheel_kind *wheel, int16_t steps)
{
    double turning = copysign(fmax(0, fabs((double)steps) - wheel->dead_band), steps);

    return turning * (wheel->gain * kind->wheel_max) / (PWM_STEPS - wheel->dead_band);
}

static double lagged(double speed, double wanted, double seconds, double lag)
{
    return wanted + (speed - wanted) * exp(-seconds / lag);
}

void body_move(const struct body_kind *kind, struct body *body, int16_t left, int16_t right,
               double seconds)
{
    double want_left = body_wheel_speed(kind, &kind->left, left);
    double want_right = body_wheel_speed(kind, &kind->right, right);

    if (body->held) {
        body->left = body->right = 0;
        return;
    }
    if (kind->lag == 0) {
        body->left = want_left;
        body->right = want_right;
        follow_arc(kind, body, seconds);
        return;
    }
    int steps = (int)ceil(seconds / LAG_STEP);
    double step = seconds / steps;
    for (int i = 0; i < steps; i++) {
        body->left = lagged(body->left, want_left, step, kind->lag);
        body->right = lagged(body->right, want_right, step, kind->lag);
        follow_arc(kind, body, step);
    }
}
