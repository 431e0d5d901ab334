#include "law_inputs.h"

#include "random.h"

#define METRE ((int32_t)NARROW_PER_M)

/* Within +-limit. */
static int32_t draw(uint32_t *state, int32_t limit)
{
    return (int32_t)(random_next(state) % (2 * (uint32_t)limit + 1)) - limit;
}

static uint16_t draw_between(uint32_t *state, uint16_t low, uint16_t high)
{
    return (uint16_t)(low + random_next(state) % (uint16_t)(high - low + 1u));
}

static struct vec16 draw_narrow(uint32_t *state, int16_t limit)
{
    int16_t x = (int16_t)draw(state, limit);

    return (struct vec16){x, (int16_t)draw(state, limit)};
}

static void draw_goal(struct law_input *input, uint32_t *state, int32_t reach)
{
    input->goal.at.x = input->own.at.x + draw(state, reach);
    input->goal.at.y = input->own.at.y + draw(state, reach);
}

static void draw_ordinary(struct law_input *input, uint32_t *state)
{
    input->own.theta = (angle_t)random_next(state);
    input->own.at.x = draw(state, 100 * METRE);
    input->own.at.y = draw(state, 100 * METRE);
    draw_goal(input, state, METRE * 3 / 4);
    input->goal.velocity = draw_narrow(state, NARROW_PER_M);
    input->goal.acceleration = draw_narrow(state, NARROW_PER_M);
    input->mission.k = draw_between(state, GAIN_ONE / 2, 3 * GAIN_ONE / 2);
    input->mission.k_theta = draw_between(state, GAIN_ONE, 6 * GAIN_ONE);
    input->mission.v_max = 6 * METRE;
    input->mission.omega_max = 30 * RATE_ONE;
}

/* u = pd' + k (pd - p) comes to lie within `left` of zero, k being 1. */
static void cancel(struct law_input *input, uint32_t *state, int32_t left)
{
    input->mission.k = GAIN_ONE;
    input->goal.at.x = input->own.at.x - input->goal.velocity.x + draw(state, left);
    input->goal.at.y = input->own.at.y - input->goal.velocity.y + draw(state, left);
}

static void align(struct law_input *input, bool diagonal)
{
    int32_t x = input->goal.at.x - input->own.at.x;

    input->goal.at.y = input->own.at.y + (diagonal ? x : 0);
    input->goal.velocity.y = diagonal ? input->goal.velocity.x : 0;
}

void law_input(struct law_input *input, uint16_t index, uint32_t *state)
{
    draw_ordinary(input, state);
    if (index < LAW_NEAR)
        return;
    switch (index % 8) {
    case 0: draw_goal(input, state, 100 * METRE); break;
    case 1: input->mission.k = (uint16_t)(random_next(state) | 1); break;
    case 2: input->mission.k_theta = (uint16_t)(random_next(state) | 1); break;
    case 3: cancel(input, state, MOTION_HOLD + 1); break;
    case 4: align(input, index & 8); break;
    case 5:
        input->goal.velocity = draw_narrow(state, INT16_MAX);
        input->goal.acceleration = draw_narrow(state, INT16_MAX);
        break;
    case 6: input->mission.v_max = (int16_t)draw_between(state, 1, 200); break;
    default:
        draw_goal(input, state, 100 * METRE);
        input->mission.k = UINT16_MAX;
        input->mission.k_theta = UINT16_MAX;
        input->goal.velocity = draw_narrow(state, INT16_MAX);
    }
}
