#include "body.h"

#include "limits.h"

#include <math.h>

#define IDEAL_TRACK 0.1

/* The paper's robot is 110 x 80 mm; speed and lag are those of the geared motors of its kind. */
#define SMALL_TRACK 0.08
#define SMALL_WHEEL_MAX 0.6
#define SMALL_LAG 0.05

/* While wheels change speed the arc is integrated in steps no longer than this, s. */
#define LAG_STEP 0.001

struct body_kind body_kind_of(const struct scenario *scenario)
{
    if (scenario->body == BODY_SMALL)
        return (struct body_kind){SMALL_TRACK, SMALL_WHEEL_MAX, SMALL_LAG};
    return (struct body_kind){
        .track = IDEAL_TRACK,
        .wheel_max = scenario->v_max + scenario->omega_max * IDEAL_TRACK / 2,
    };
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

static double lagged(double speed, double wanted, double seconds, double lag)
{
    return wanted + (speed - wanted) * exp(-seconds / lag);
}

void body_move(const struct body_kind *kind, struct body *body, int16_t left, int16_t right,
               double seconds)
{
    double want_left = left * kind->wheel_max / PWM_STEPS;
    double want_right = right * kind->wheel_max / PWM_STEPS;

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
