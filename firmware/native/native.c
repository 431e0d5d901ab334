#include "native.h"

void native_power_on(struct native *robot)
{
    brain_init(&robot->brain, robot->eeprom);
}

void native_run(struct native *robot, const uint8_t *bytes, size_t before, size_t after,
                struct brain_output *output)
{
    const struct brain_input input = {
        .battery = robot->battery,
        .stored = robot->stored,
    };

    brain_bytes(&robot->brain, bytes, bytes + before);
    brain_step(&robot->brain, &input, output);
    if (output->store.wanted)
        robot->stored = robot->eeprom[output->store.at] = output->store.byte;
    brain_bytes(&robot->brain, bytes + before, bytes + before + after);
}
