#include "native.h"

/* A board that is in order: full battery, nothing lost. */
static const struct brain_input healthy = {.battery = 7400};

void native_power_on(struct native *robot, uint16_t id)
{
    brain_init(&robot->brain, id);
}

void native_run(struct native *robot, const uint8_t *bytes, size_t before, size_t after,
                struct brain_output *output)
{
    brain_bytes(&robot->brain, bytes, bytes + before);
    brain_step(&robot->brain, &healthy, output);
    brain_bytes(&robot->brain, bytes + before, bytes + before + after);
}
