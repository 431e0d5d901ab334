#include "ground.h"

#include "limits.h"

#include <math.h>
#include <stdlib.h>

#define ACTUATION_US (ACTUATION_MS * 1000)

struct mover {
    struct body_kind kind;
    struct body body;
    int64_t at_us;       /* when it was where `body` says */
    int64_t heard_us;    /* when a set-point came last */
    int16_t left, right; /* in force */
    bool waiting;        /* `next` is to take effect at `due_us` */
    struct setpoint next;
    int64_t due_us;
};

struct ground {
    size_t count;
    uint16_t *position_of; /* by id, counted from 1; 0: no such robot */
    struct mover mover[];
};

struct ground *ground_new(const struct scenario *scenario, int64_t now_us)
{
    size_t count = scenario->robot_count;
    struct ground *ground = calloc(1, sizeof *ground + count * sizeof ground->mover[0]);
    uint16_t *position_of = calloc(ROBOT_ID_MAX + 1, sizeof *position_of);

    if (ground == NULL || position_of == NULL) {
        free(ground);
        free(position_of);
        return NULL;
    }
    ground->count = count;
    ground->position_of = position_of;
    for (size_t i = 0; i < count; i++) {
        const struct scenario_robot *from = &scenario->robots[i];

        position_of[from->id] = (uint16_t)(i + 1);
        ground->mover[i] = (struct mover){
            .kind = body_kind_of(scenario, from->id),
            .body = {from->x, from->y, remainder(from->theta, 2 * M_PI), .held = true},
            .at_us = now_us,
        };
    }
    return ground;
}

void ground_free(struct ground *ground)
{
    if (ground != NULL)
        free(ground->position_of);
    free(ground);
}

static void move_until(struct mover *mover, int64_t us)
{
    body_move(&mover->kind, &mover->body, mover->left, mover->right,
              (double)(us - mover->at_us) / 1e6);
    mover->at_us = us;
}

static void power_off(struct mover *mover)
{
    mover->body.held = true;
    mover->body.left = mover->body.right = 0;
    mover->left = mover->right = 0;
}

static void advance(struct mover *mover, int64_t now_us)
{
    int64_t silent_us = mover->heard_us + GROUND_SILENCE_US;

    if (mover->waiting && mover->due_us <= now_us) {
        move_until(mover, mover->due_us);
        mover->left = mover->next.left;
        mover->right = mover->next.right;
        mover->waiting = false;
    }
    if (!mover->body.held && silent_us <= now_us) {
        move_until(mover, silent_us);
        power_off(mover);
    }
    move_until(mover, now_us);
}

void ground_set(struct ground *ground, struct setpoint setpoint, int64_t now_us)
{
    size_t position = setpoint.id > ROBOT_ID_MAX ? 0 : ground->position_of[setpoint.id];

    if (position == 0)
        return;
    struct mover *mover = &ground->mover[position - 1];
    advance(mover, now_us);
    mover->body.held = false;
    mover->heard_us = now_us;
    mover->next = setpoint;
    /* Of two ticks that were caught up with at once the later one counts. */
    if (!mover->waiting)
        mover->due_us = now_us + ACTUATION_US;
    mover->waiting = true;
}

void ground_move(struct ground *ground, int64_t now_us)
{
    for (size_t i = 0; i < ground->count; i++)
        advance(&ground->mover[i], now_us);
}

const struct body *ground_look(const struct ground *ground, size_t i)
{
    return &ground->mover[i].body;
}
