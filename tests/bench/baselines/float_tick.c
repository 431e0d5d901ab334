#include "float_tick.h"

#include <math.h>

static void advance(struct float_state *state)
{
    float dt = state->age / 1000.0f;
    float middle = state->theta + state->omega * dt / 2;

    state->x += state->v * dt * cosf(middle);
    state->y += state->v * dt * sinf(middle);
    state->theta += state->omega * dt;
    state->age = 0;
}

/* The goal of equation 2 and its derivatives, the leader's v and omega held. */
static void set_goal(struct float_tick *tick, const struct float_vertex *vertex)
{
    const struct float_state *leader = &tick->leader;
    struct float_law *law = &tick->law;
    float c = cosf(leader->theta), s = sinf(leader->theta);
    float dx = vertex->x * c - vertex->y * s;
    float dy = vertex->x * s + vertex->y * c;

    law->goal_x = leader->x + dx;
    law->goal_y = leader->y + dy;
    law->vel_x = leader->v * c - leader->omega * dy;
    law->vel_y = leader->v * s + leader->omega * dx;
    law->acc_x = -leader->omega * law->vel_y;
    law->acc_y = leader->omega * law->vel_x;
}

static struct float_wheels wheels(const struct float_tick *tick, struct float_command command)
{
    float half = command.omega * tick->track / 2;
    float left = command.v - half;
    float right = command.v + half;
    float fastest = fmaxf(fmaxf(fabsf(left), fabsf(right)), tick->wheel_max);

    return (struct float_wheels){.left = left / fastest, .right = right / fastest};
}

struct float_wheels float_tick(struct float_tick *tick, bool *taboo)
{
    struct float_wheels none = {0, 0, 0};

    advance(&tick->own);
    advance(&tick->leader);
    tick->contest.x = tick->leader.x;
    tick->contest.y = tick->leader.y;
    tick->contest.theta = tick->leader.theta;
    tick->contest.own_x = tick->law.x = tick->own.x;
    tick->contest.own_y = tick->law.y = tick->own.y;
    tick->law.theta = tick->own.theta;

    uint16_t held = float_allocate(&tick->contest, taboo);
    if (held == 0)
        return none;
    set_goal(tick, &tick->contest.vertex[held - 1]);
    struct float_wheels out = wheels(tick, float_law(&tick->law));
    out.held = held;
    return out;
}
