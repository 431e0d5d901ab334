#include "native.h"

/* A board that is in order: full battery, nothing lost. */
static const struct brain_input healthy = {.battery = 7400};

void native_power_on(struct native *robot, uint16_t id)
{
    brain_init(&robot->brain, id);
}

static void receive(struct native *robot, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        brain_byte(&robot->brain, bytes[i]);
}

void native_run(struct native *robot, const uint8_t *bytes, size_t before, size_t after,
                struct brain_output *output)
{
    receive(robot, bytes, before);
    brain_step(&robot->brain, &healthy, output);
    receive(robot, bytes + before, after);
}
