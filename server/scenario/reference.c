#include "reference.h"

#include "expression.h"
#include "limits.h"

#include <math.h>
#include <stdlib.h>

#define STEP_MS 5

_Static_assert(TICK_MS % STEP_MS == 0, "a control tick is a whole number of steps");

struct trajectory {
    double x, y, theta;
    struct expression *v, *omega;
};

struct trajectory *trajectory_new(const double start[3], struct expression *v,
                                  struct expression *omega)
{
    struct trajectory *trajectory = malloc(sizeof *trajectory);

    if (trajectory != NULL)
        *trajectory = (struct trajectory){start[0], start[1], start[2], v, omega};
    return trajectory;
}

void trajectory_free(struct trajectory *trajectory)
{
    if (trajectory == NULL)
        return;
    expression_free(trajectory->v);
    expression_free(trajectory->omega);
    free(trajectory);
}

static void set_speeds(const struct trajectory *trajectory, struct reference_state *state)
{
    state->v = expression_value(trajectory->v, &state->t);
    state->omega = expression_value(trajectory->omega, &state->t);
}

struct reference_state trajectory_start(struct trajectory *trajectory)
{
    struct reference_state state = {0, trajectory->x, trajectory->y, trajectory->theta, 0, 0};

    set_speeds(trajectory, &state);
    return state;
}

/* Equation 1 from `from` to the time `t`. The speeds depend on time alone, so the second and the
 * third of the four slopes share them. */
static struct reference_state advance(const struct trajectory *trajectory,
                                      const struct reference_state *from, double t)
{
    double h = t - from->t;
    struct reference_state middle = {.t = from->t + h / 2};
    struct reference_state to = {.t = t};

    set_speeds(trajectory, &middle);
    set_speeds(trajectory, &to);

    double theta2 = from->theta + h / 2 * from->omega;
    double theta3 = from->theta + h / 2 * middle.omega;
    double theta4 = from->theta + h * middle.omega;

    to.x = from->x + h / 6 *
                         (from->v * cos(from->theta) + 2 * middle.v * cos(theta2) +
                          2 * middle.v * cos(theta3) + to.v * cos(theta4));
    to.y = from->y + h / 6 *
                         (from->v * sin(from->theta) + 2 * middle.v * sin(theta2) +
                          2 * middle.v * sin(theta3) + to.v * sin(theta4));
    to.theta = from->theta + h / 6 * (from->omega + 4 * middle.omega + to.omega);
    return to;
}

struct reference_state trajectory_step(struct trajectory *trajectory,
                                       const struct reference_state *from)
{
    /* Counted, not summed up: a day of rounding would move the last tick. */
    double tick = round(from->t * TICKS_PER_S);
    struct reference_state state = *from;

    for (int ms = STEP_MS; ms <= TICK_MS; ms += STEP_MS)
        state = advance(trajectory, &state, (tick * TICK_MS + ms) / 1000);
    return state;
}
