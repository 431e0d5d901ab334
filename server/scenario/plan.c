#include "plan.h"

#include "trajectory.h"
#include "units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far the robots' reference may lie from the scenario's between two knots. */
#define KNOT_ERROR_WIDE 4   /* 1 mm */
#define KNOT_ERROR_ANGLE 20 /* 2 mrad */
#define KNOT_ERROR_V 16     /* 4 mm/s */
#define KNOT_ERROR_OMEGA 4  /* 4 mrad/s */

#define SPAN_MAX (KNOT_SPACING_MAX_MS / TICK_MS)

static struct knot knot_of(const struct reference_state *state, long tick)
{
    return (struct knot){
        .time = (int32_t)(tick * TICK_MS),
        .pose = {{wide_of(state->x), wide_of(state->y)}, angle_of(state->theta)},
        .v = (int16_t)lround(state->v * NARROW_PER_M),
        .omega = (int16_t)lround(state->omega * RATE_ONE),
    };
}

static bool close_to(const struct reference *got, const struct knot *want)
{
    int16_t turn = (int16_t)(angle_t)(got->pose.theta - want->pose.theta);

    return abs(got->pose.at.x - want->pose.at.x) <= KNOT_ERROR_WIDE &&
           abs(got->pose.at.y - want->pose.at.y) <= KNOT_ERROR_WIDE &&
           abs(turn) <= KNOT_ERROR_ANGLE && abs(got->v - want->v) <= KNOT_ERROR_V &&
           abs(got->omega - want->omega) <= KNOT_ERROR_OMEGA;
}

/* Would the robots see the reference as it is, with knots at ticks[0] and ticks[span] alone?
 * Just before the second one they still go by the first. */
static bool spans(const struct knot *ticks, int span)
{
    for (int i = 1; i <= span; i++) {
        struct reference seen = reference_between(&ticks[0], &ticks[span], ticks[i].time);

        if (!close_to(&seen, &ticks[i]))
            return false;
    }
    return true;
}

/* The longest span of those tried; one tick always fits. */
static int longest_span(const struct knot *ticks, int available)
{
    static const int tried[] = {SPAN_MAX, 40, 30, 25, 20, 15, 10, 7, 5, 3, 2};

    for (size_t i = 0; i < sizeof tried / sizeof tried[0]; i++)
        if (tried[i] <= available && spans(ticks, tried[i]))
            return tried[i];
    return 1;
}

/* Sets the knots as far apart as the robots' own arithmetic allows. */
static bool set_knots(struct plan *plan, const struct scenario *scenario)
{
    long last = lround(ceil(scenario->duration * TICKS_PER_S));
    struct reference_state state = trajectory_start(scenario->trajectory);
    struct knot ahead[SPAN_MAX + 1] = {knot_of(&state, 0)};
    int held = 1; /* ahead[0] is the last knot set */
    long tick = 0;
    size_t room = 0;

    for (;;) {
        if (plan->config.knot_count == room) {
            room = room == 0 ? 64 : 2 * room;
            struct knot *grown = realloc(plan->knots, room * sizeof *grown);
            if (grown == NULL)
                return false;
            plan->knots = grown;
        }
        plan->knots[plan->config.knot_count++] = ahead[0];
        while (held <= SPAN_MAX && tick < last) {
            state = trajectory_step(scenario->trajectory, &state);
            ahead[held++] = knot_of(&state, ++tick);
        }
        if (held == 1)
            break;
        int span = longest_span(ahead, held - 1);
        held -= span;
        memmove(ahead, &ahead[span], (size_t)held * sizeof ahead[0]);
    }
    plan->config.knots = plan->knots;
    return true;
}

struct server_formation plan_formation(const struct scenario_formation *formation,
                                       struct polar_vertex *vertices)
{
    int32_t farthest = 0;

    for (size_t i = 0; i < formation->count; i++) {
        vertices[i] = (struct polar_vertex){wide_of(formation->L[i]), angle_of(formation->psi[i])};
        if (abs(vertices[i].distance) > farthest)
            farthest = abs(vertices[i].distance);
    }
    return (struct server_formation){
        .count = (uint16_t)formation->count,
        .scale = formation_scale(farthest),
        .vertex = vertices,
    };
}

static bool set_formations(struct plan *plan, const struct scenario *scenario)
{
    size_t total = 0;

    for (size_t i = 0; i < scenario->formation_count; i++)
        total += scenario->formations[i].count;
    plan->formations = calloc(scenario->formation_count, sizeof *plan->formations);
    plan->vertices = calloc(total, sizeof *plan->vertices);
    if (plan->formations == NULL || plan->vertices == NULL)
        return false;

    struct polar_vertex *next = plan->vertices;
    for (size_t i = 0; i < scenario->formation_count; i++) {
        plan->formations[i] = plan_formation(&scenario->formations[i], next);
        next += scenario->formations[i].count;
    }
    plan->config.formation_count = scenario->formation_count;
    plan->config.formations = plan->formations;
    return true;
}

static bool set_robots(struct plan *plan, const struct scenario *scenario)
{
    plan->robots = calloc(scenario->robot_count, sizeof *plan->robots);
    if (plan->robots == NULL)
        return false;
    for (size_t i = 0; i < scenario->robot_count; i++)
        plan->robots[i] =
            (struct server_robot){scenario->robots[i].id, scenario->robots[i].candidate};
    plan->config.robot_count = scenario->robot_count;
    plan->config.robots = plan->robots;
    return true;
}

static enum server_allocation allocation_of(const struct scenario *scenario)
{
    switch (scenario->allocation) {
    case ASSIGN_CPA_LITERAL: return SERVER_CPA_LITERAL;
    case ASSIGN_RIGID: return SERVER_RIGID;
    case ASSIGN_OPTIMAL: return SERVER_OPTIMAL;
    case ASSIGN_CPA: break;
    }
    return SERVER_CPA;
}

/* A limit below the wire's unit is one unit: robots refuse 0. */
static int16_t limit_of(double value, double unit)
{
    return (int16_t)fmax(1, round(value * unit));
}

static struct message_mission mission_of(const struct scenario *scenario,
                                         const struct plan_robot *robot)
{
    return (struct message_mission){
        .version = PROTOCOL_VERSION,
        .mission = 1,
        .law = (uint8_t)scenario->law,
        .k = (uint16_t)lround(scenario->k * GAIN_ONE),
        .k_theta = (uint16_t)lround(scenario->k_theta * GAIN_ONE),
        .v_max = limit_of(scenario->v_max, NARROW_PER_M),
        .omega_max = limit_of(scenario->omega_max, RATE_ONE),
        .track = (int16_t)lround(robot->track * NARROW_PER_M),
        .wheel_max = (int16_t)lround(robot->wheel_max * NARROW_PER_M),
        .latency = robot->latency_ms,
    };
}

struct plan *plan_new(const struct scenario *scenario, const struct plan_robot *robot,
                      uint64_t seed)
{
    struct plan *plan = calloc(1, sizeof *plan);

    if (plan == NULL)
        return NULL;
    size_t drawn =
        scenario->robot_count < DRAWING_VERTICES_MAX ? scenario->robot_count : DRAWING_VERTICES_MAX;
    plan->config = (struct server_config){
        .formation = (uint16_t)scenario->formation,
        .drawn_vertices = (uint16_t)drawn,
        .event_count = scenario->event_count,
        .events = scenario->events,
        .mission = mission_of(scenario, robot),
        .allocation = allocation_of(scenario),
        .range = scenario->range,
        .loss = scenario->loss,
        .delay = scenario->delay,
        .seed = seed,
    };
    if (set_robots(plan, scenario) && set_formations(plan, scenario) && set_knots(plan, scenario))
        return plan;
    plan_free(plan);
    return NULL;
}

void plan_free(struct plan *plan)
{
    if (plan == NULL)
        return;
    free(plan->robots);
    free(plan->formations);
    free(plan->vertices);
    free(plan->knots);
    free(plan);
}
