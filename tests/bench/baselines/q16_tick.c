#include "q16_tick.h"

static void advance(struct q16_state *state)
{
    q16 dt = (q16)((uint32_t)state->age * Q16_ONE / 1000);
    q16 chord = q16_mul(state->v, dt);
    q16 turn = q16_mul(state->omega, dt);
    q16 s, c;

    q16_sincos(q16_wrap(state->theta + turn / 2), &s, &c);
    state->x += q16_mul(chord, c);
    state->y += q16_mul(chord, s);
    state->theta = q16_wrap(state->theta + turn);
    state->age = 0;
}

/* The goal of equation 2 and its derivatives, the leader's v and omega held. */
static void set_goal(struct q16_tick *tick, const struct q16_vertex *vertex)
{
    const struct q16_state *leader = &tick->leader;
    struct q16_law *law = &tick->law;
    q16 s, c;

    q16_sincos(leader->theta, &s, &c);
    q16 dx = q16_mul(vertex->x, c) - q16_mul(vertex->y, s);
    q16 dy = q16_mul(vertex->x, s) + q16_mul(vertex->y, c);

    law->goal_x = leader->x + dx;
    law->goal_y = leader->y + dy;
    law->vel_x = q16_mul(leader->v, c) - q16_mul(leader->omega, dy);
    law->vel_y = q16_mul(leader->v, s) + q16_mul(leader->omega, dx);
    law->acc_x = -q16_mul(leader->omega, law->vel_y);
    law->acc_y = q16_mul(leader->omega, law->vel_x);
}

static q16 larger(q16 a, q16 b)
{
    return a > b ? a : b;
}

static q16 magnitude(q16 value)
{
    return value < 0 ? -value : value;
}

static struct q16_wheels wheels(const struct q16_tick *tick, struct q16_command command)
{
    q16 half = q16_mul(command.omega, tick->track) / 2;
    q16 left = command.v - half;
    q16 right = command.v + half;
    q16 fastest = larger(larger(magnitude(left), magnitude(right)), tick->wheel_max);

    return (struct q16_wheels){.left = q16_div(left, fastest), .right = q16_div(right, fastest)};
}

struct q16_wheels q16_tick(struct q16_tick *tick, bool *taboo)
{
    struct q16_wheels none = {0, 0, 0};

    advance(&tick->own);
    advance(&tick->leader);
    tick->contest.x = tick->leader.x;
    tick->contest.y = tick->leader.y;
    tick->contest.theta = tick->leader.theta;
    tick->contest.own_x = tick->law.x = tick->own.x;
    tick->contest.own_y = tick->law.y = tick->own.y;
    tick->law.theta = tick->own.theta;

    uint16_t held = q16_allocate(&tick->contest, taboo);
    if (held == 0)
        return none;
    set_goal(tick, &tick->contest.vertex[held - 1]);
    struct q16_wheels out = wheels(tick, q16_law(&tick->law));
    out.held = held;
    return out;
}
