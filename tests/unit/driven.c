#include "driven.h"

#include "body.h"
#include "limits.h"
#include "random.h"

#include <math.h>

#define DELAY 0.025
#define SIGHT_MS 20

static double unit(uint32_t *state)
{
    return random_next(state) / 4294967296.0;
}

/* Mean 0, standard deviation 1. */
static double bell(uint32_t *state)
{
    double sum = 0;

    for (int i = 0; i < 12; i++)
        sum += unit(state);
    return sum - 6;
}

static void move(const struct driven *robot, const struct drive_segment *told, struct body *body)
{
    struct body_kind kind = {
        .track = robot->track,
        .wheel_max = robot->wheel_max,
        .lag = robot->lag,
        .left = {robot->gain[WHEEL_LEFT], robot->dead[WHEEL_LEFT] * PWM_STEPS},
        .right = {robot->gain[WHEEL_RIGHT], robot->dead[WHEEL_RIGHT] * PWM_STEPS},
    };

    if (robot->swapped)
        body_move(&kind, body, told->right, told->left, 0.001);
    else
        body_move(&kind, body, told->left, told->right, 0.001);
}

static void look(const struct driven *robot, const struct body *body, double t, uint32_t *state,
                 struct drive_record *record)
{
    double place = robot->noisy ? 0.0003 : 0;
    double turn = robot->noisy ? 0.2 * M_PI / 180 : 0;
    double c = cos(body->theta);
    double s = sin(body->theta);

    drive_record_seen(record, t,
                      body->x + robot->ahead * c - robot->aside * s + place * bell(state),
                      body->y + robot->ahead * s + robot->aside * c + place * bell(state),
                      remainder(body->theta + robot->heading + turn * bell(state), 2 * M_PI));
}

void driven_record(const struct driven *robot, const struct drive_plan *plan, uint32_t seed,
                   struct drive_record *record)
{
    struct body body = {.x = 1, .y = -2, .theta = 2};
    struct drive_segment told = {.left = 0};
    double whole = drive_seconds(plan);
    double effect = 0;
    uint32_t state = seed;

    *record = (struct drive_record){.change_count = 0};
    for (int ms = 0; ms < whole * 1000; ms++) {
        double t = ms / 1000.0;
        const struct drive_segment *sent = drive_at(plan, t);
        size_t before = record->change_count;

        if (ms % SIGHT_MS == 0)
            look(robot, &body, t, &state, record);
        drive_record_sent(record, t, sent->left, sent->right);
        if (record->change_count > before)
            effect = fmax(effect, t + DELAY + unit(&state) * robot->latest);
        if (t >= effect)
            told = *sent;
        move(robot, &told, &body);
    }
}
