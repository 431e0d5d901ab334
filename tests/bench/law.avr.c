/* The motion law in fixed point over every input, then over the ordinary ones in floating point
 * and in Q16.16. */
#include "float_law.h"
#include "law_inputs.h"
#include "mark.h"
#include "q16_law.h"
#include "si.h"

static struct law_input input;
static struct motion_command command;
static struct float_law float_input;
static struct float_command float_command;
static struct q16_law q16_input;
static struct q16_command q16_command;

static void fixed_law(void)
{
    command = motion_fl(&input.mission, &input.goal, &input.own);
}

static void run_float_law(void)
{
    float_command = float_law(&float_input);
}

static void run_q16_law(void)
{
    q16_command = q16_law(&q16_input);
}

static void to_float(void)
{
    float_input = (struct float_law){
        .x = float_metres(input.own.at.x),
        .y = float_metres(input.own.at.y),
        .theta = float_radians(input.own.theta),
        .goal_x = float_metres(input.goal.at.x),
        .goal_y = float_metres(input.goal.at.y),
        .vel_x = float_metres(input.goal.velocity.x),
        .vel_y = float_metres(input.goal.velocity.y),
        .acc_x = float_metres(input.goal.acceleration.x),
        .acc_y = float_metres(input.goal.acceleration.y),
        .k = float_gain(input.mission.k),
        .k_theta = float_gain(input.mission.k_theta),
        .v_max = float_metres(input.mission.v_max),
        .omega_max = float_rate(input.mission.omega_max),
    };
}

static void to_q16(void)
{
    q16_input = (struct q16_law){
        .x = q16_metres(input.own.at.x),
        .y = q16_metres(input.own.at.y),
        .theta = q16_radians(input.own.theta),
        .goal_x = q16_metres(input.goal.at.x),
        .goal_y = q16_metres(input.goal.at.y),
        .vel_x = q16_metres(input.goal.velocity.x),
        .vel_y = q16_metres(input.goal.velocity.y),
        .acc_x = q16_metres(input.goal.acceleration.x),
        .acc_y = q16_metres(input.goal.acceleration.y),
        .k = q16_gain(input.mission.k),
        .k_theta = q16_gain(input.mission.k_theta),
        .v_max = q16_metres(input.mission.v_max),
        .omega_max = q16_rate(input.mission.omega_max),
    };
}

static void measure_fixed(void)
{
    uint32_t state = LAW_SEED;

    for (uint16_t i = 0; i < LAW_INPUTS; i++) {
        law_input(&input, i, &state);
        measure(fixed_law);
        tell(&command, sizeof command);
    }
}

static void measure_baselines(void)
{
    uint32_t state = LAW_SEED;

    for (uint16_t i = 0; i < LAW_NEAR; i++) {
        law_input(&input, i, &state);
        to_float();
        measure(run_float_law);
        tell(&float_command, sizeof float_command);
        to_q16();
        measure(run_q16_law);
        tell(&q16_command, sizeof q16_command);
    }
}

int main(void)
{
    calibrate();
    measure_fixed();
    measure_baselines();
    mark(MARK_DONE);
    for (;;)
        ;
}
