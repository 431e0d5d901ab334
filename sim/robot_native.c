#include "robot.h"

#include "native.h"

#include <stdlib.h>
#include <string.h>

struct native_robot {
    struct sim_robot robot;
    struct link_timing timing;
    struct native native;
};

static struct native_robot *self(struct sim_robot *robot)
{
    return (struct native_robot *)robot;
}

static bool power_on(struct sim_robot *robot)
{
    struct native *native = &self(robot)->native;

    native->eeprom = robot->eeprom;
    native->battery = robot_battery_measured(robot->battery);
    native_power_on(native);
    return true;
}

static void power_off(struct sim_robot *robot)
{
    (void)robot;
}

static void run(struct sim_robot *robot, const uint8_t *rx, size_t count, struct robot_period *out)
{
    struct native_robot *me = self(robot);
    size_t before = count < me->timing.before_phase ? count : me->timing.before_phase;
    struct brain_output output;

    native_run(&me->native, rx, before, count - before, &output);
    me->native.battery = robot_battery_measured(robot->battery);
    out->left = output.left;
    out->right = output.right;
    out->sent = output.length;
    memcpy(out->tx, output.frames, output.length);
    out->crashed = false;
}

static struct robot_load load(const struct sim_robot *robot)
{
    (void)robot;
    return (struct robot_load){0};
}

static void destroy(struct sim_robot *robot)
{
    free(robot);
}

static const struct robot_kind native_kind = {power_on, power_off, run, load, destroy};

struct sim_robot *robot_native_new(uint16_t id)
{
    struct native_robot *me = calloc(1, sizeof *me);

    if (me == NULL)
        return NULL;
    robot_begin(&me->robot, &native_kind, id);
    me->timing = link_timing_of(NATIVE_BAUD);
    return &me->robot;
}
