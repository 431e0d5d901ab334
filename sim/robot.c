#include "robot.h"

#include "../firmware/atmega128/pins.h"
#include "limits.h"

#include <string.h>

#define BITS_PER_BYTE 10 /* start, eight, stop */

/* Where in its period a robot's control tick is wanted, ms. */
#define PHASE_MS 5

struct link_timing link_timing_of(uint32_t baud)
{
    return (struct link_timing){
        .baud = baud,
        .slots = (uint16_t)(baud * TICK_MS / (BITS_PER_BYTE * 1000)),
        .before_phase = (uint16_t)(baud * PHASE_MS / (BITS_PER_BYTE * 1000)),
    };
}

double link_phase_s(const struct link_timing *timing)
{
    return (timing->before_phase + 0.5) * BITS_PER_BYTE / timing->baud;
}

double link_actuation_s(const struct link_timing *timing)
{
    return link_phase_s(timing) + ACTUATION_MS / 1000.0;
}

void robot_begin(struct sim_robot *robot, const struct robot_kind *kind, uint16_t id)
{
    struct parameters parameters;

    robot->kind = kind;
    robot->id = id;
    robot->battery = BATTERY_FULL_MV;
    memset(robot->eeprom, 0xFF, sizeof robot->eeprom);
    if (id == 0)
        return;
    parameters_default(&parameters);
    parameters.value[PARAMETER_ID] = id;
    robot_provision(robot, &parameters);
}

void robot_provision(struct sim_robot *robot, const struct parameters *parameters)
{
    parameters_write(robot->eeprom, parameters);
}

/* simavr's converter, whose 1,023 stands for the whole reference, and what firmware/atmega128
 * makes of it, for which that is 1,024. */
uint16_t robot_battery_measured(uint16_t millivolts)
{
    uint32_t code = millivolts / BATTERY_DIVIDER * 1023u / ADC_REFERENCE_MV;

    if (code > 1023)
        code = 1023;
    return (uint16_t)(code * ADC_REFERENCE_MV * BATTERY_DIVIDER / 1024);
}
