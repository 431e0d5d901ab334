/* robot_avr.c: a robot whose brain runs in a simulated ATmega128 (robot.h). */
#include "avr_core.h"
#include "limits.h"
#include "robot.h"

#include <math.h>
#include <stdlib.h>

/* Set-points are looked at this long after they take effect: an interrupt may be late. */
#define GUARD_S 1e-4

/* A program that has not started its control tick by then never will. */
#define BOOT_LIMIT_S 1

struct robot_avr {
    struct sim_robot robot;
    const struct avr_image *image;
    struct avr_core *core;  /* NULL: off */
    uint32_t period;        /* cycles in a period */
    uint32_t phase;         /* of the control tick, cycles */
    uint32_t actuation;     /* when to look at the motors, cycles */
    int64_t start;          /* cycle at which this period began */
    struct robot_load load; /* as it was at power-off */
    bool watch_stack;
};

static struct robot_avr *avr_of(const struct sim_robot *robot)
{
    return (struct robot_avr *)robot;
}

/* Runs a fresh core until its control tick's timer counts. */
static void boot(struct avr_core *core, uint32_t f_cpu)
{
    const uint32_t step = 1000;
    uint64_t limit = (uint64_t)f_cpu * BOOT_LIMIT_S;

    for (uint64_t until = step; avr_core_timer_start(core) == 0 && until < limit; until += step)
        if (!avr_core_run(core, until))
            return;
}

static bool power_on(struct sim_robot *robot)
{
    struct robot_avr *self = avr_of(robot);

    self->core = avr_core_new(self->image);
    if (self->core == NULL)
        return false;
    if (self->watch_stack)
        avr_core_watch_stack(self->core);
    avr_core_write_eeprom(self->core, 0, robot->eeprom, sizeof robot->eeprom);
    avr_core_set_battery(self->core, robot->battery);
    boot(self->core, self->image->f_cpu);
    /* The timer started `phase` after the beginning of the period that passes in booting. */
    self->start = (int64_t)avr_core_timer_start(self->core) - self->phase + self->period;
    avr_core_run(self->core, (uint64_t)self->start);
    return true;
}

static struct robot_load load(const struct sim_robot *robot)
{
    const struct robot_avr *self = avr_of(robot);
    const struct avr_image *image = self->image;

    if (self->core == NULL)
        return self->load;
    const uint8_t *data = avr_core_data(self->core);
    const uint8_t *tick_cycles = data + image->tick_cycles_max;
    return (struct robot_load){
        .cycles = avr_core_cycle(self->core),
        .asleep = avr_core_asleep(self->core),
        .stack_free = avr_core_stack_free(self->core),
        .tick_cycles =
            image->tick_cycles_max == 0 ? 0 : 8u * (tick_cycles[0] | tick_cycles[1] << 8),
    };
}

static void power_off(struct sim_robot *robot)
{
    struct robot_avr *self = avr_of(robot);

    self->load = load(robot);
    if (self->core == NULL)
        return;
    avr_core_read_eeprom(self->core, 0, robot->eeprom, sizeof robot->eeprom);
    avr_core_free(self->core);
    self->core = NULL;
}

static void run(struct sim_robot *robot, const uint8_t *rx, size_t count, struct robot_period *out)
{
    struct robot_avr *self = avr_of(robot);
    bool alive;

    *out = (struct robot_period){0};
    if (self->core == NULL)
        return;
    avr_core_receive(self->core, (uint64_t)self->start, rx, count);
    alive = avr_core_run(self->core, (uint64_t)self->start + self->actuation);
    struct avr_motors motors = avr_core_motors(self->core);
    /* The converter holds what it saw at the tick: this is for the next one. */
    avr_core_set_battery(self->core, robot->battery);
    self->start += self->period;
    alive = alive && avr_core_run(self->core, (uint64_t)self->start);
    out->left = motors.left;
    out->right = motors.right;
    out->sent = (uint16_t)avr_core_take_sent(self->core, out->tx, sizeof out->tx);
    out->crashed = !alive || avr_core_stack_overflown(self->core);
}

static void destroy(struct sim_robot *robot)
{
    power_off(robot);
    free(robot);
}

static const struct robot_kind kind = {power_on, power_off, run, load, destroy};

struct sim_robot *robot_avr_new(uint16_t id, struct avr_image *image)
{
    struct robot_avr *self = calloc(1, sizeof *self);
    struct link_timing timing = link_timing_of(image->baud);

    if (self == NULL)
        return NULL;
    robot_begin(&self->robot, &kind, id);
    self->image = image;
    self->period = image->f_cpu / TICKS_PER_S;
    self->phase = (uint32_t)lround(link_phase_s(&timing) * image->f_cpu);
    self->actuation = (uint32_t)lround((link_actuation_s(&timing) + GUARD_S) * image->f_cpu);
    return &self->robot;
}

void robot_avr_watch_stack(struct sim_robot *robot)
{
    avr_of(robot)->watch_stack = true;
}
