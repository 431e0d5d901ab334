/* robot_loader.c: a robot whose ATmega128 begins with a boot loader (robot.h). */
#include "avr_core.h"
#include "limits.h"
#include "own_flash.h"
#include "robot.h"

#include <math.h>
#include <stdlib.h>

struct robot_loader {
    struct sim_robot robot;
    const struct avr_image *loader;
    struct own_flash *flash;
    struct avr_core *core;  /* NULL: off */
    uint32_t period;        /* cycles in a period */
    uint32_t actuation;     /* when to look at the motors, cycles */
    uint64_t start;         /* cycle at which this period began */
    struct robot_load load; /* as it was at power-off */
};

static struct robot_loader *loader_of(const struct sim_robot *robot)
{
    return (struct robot_loader *)robot;
}

static bool power_on(struct sim_robot *robot)
{
    struct robot_loader *self = loader_of(robot);

    self->core = avr_core_new_with_flash(self->loader, self->flash);
    if (self->core == NULL)
        return false;
    avr_core_write_eeprom(self->core, 0, robot->eeprom, sizeof robot->eeprom);
    avr_core_set_battery(self->core, robot->battery);
    self->start = self->period;
    avr_core_run(self->core, self->start);
    return true;
}

/* How deep the stack was and how long a tick took is not known: programs come and go. */
static struct robot_load load(const struct sim_robot *robot)
{
    const struct robot_loader *self = loader_of(robot);

    if (self->core == NULL)
        return self->load;
    return (struct robot_load){
        .cycles = avr_core_cycle(self->core),
        .asleep = avr_core_asleep(self->core),
    };
}

static void power_off(struct sim_robot *robot)
{
    struct robot_loader *self = loader_of(robot);

    self->load = load(robot);
    if (self->core == NULL)
        return;
    avr_core_read_eeprom(self->core, 0, robot->eeprom, sizeof robot->eeprom);
    avr_core_free(self->core);
    self->core = NULL;
}

static void run(struct sim_robot *robot, const uint8_t *rx, size_t count, struct robot_period *out)
{
    struct robot_loader *self = loader_of(robot);
    bool alive;

    *out = (struct robot_period){0};
    if (self->core == NULL)
        return;
    avr_core_receive(self->core, self->start, rx, count);
    alive = avr_core_run(self->core, self->start + self->actuation);
    struct avr_motors motors = avr_core_motors(self->core);
    avr_core_set_battery(self->core, robot->battery);
    self->start += self->period;
    alive = alive && avr_core_run(self->core, self->start);
    out->left = motors.left;
    out->right = motors.right;
    out->sent = (uint16_t)avr_core_take_sent(self->core, out->tx, sizeof out->tx);
    out->crashed = !alive;
}

void robot_loader_cut(struct sim_robot *robot, const uint8_t *rx, size_t count, double seconds)
{
    struct robot_loader *self = loader_of(robot);

    if (self->core == NULL)
        return;
    avr_core_receive(self->core, self->start, rx, count);
    avr_core_run(self->core, self->start + (uint64_t)(seconds * self->loader->f_cpu));
    power_off(robot);
}

static void destroy(struct sim_robot *robot)
{
    power_off(robot);
    free(loader_of(robot)->flash);
    free(robot);
}

static const struct robot_kind kind = {power_on, power_off, run, load, destroy};

struct sim_robot *robot_avr_with_loader(uint16_t id, const struct avr_image *program,
                                        const struct avr_image *loader)
{
    struct robot_loader *self = calloc(1, sizeof *self);
    struct own_flash *flash = own_flash_new();
    struct link_timing timing = link_timing_of(loader->baud);

    if (self == NULL || flash == NULL) {
        free(self);
        free(flash);
        return NULL;
    }
    robot_begin(&self->robot, &kind, id);
    own_flash_put_loader(flash, loader);
    if (program != NULL)
        own_flash_put_program(flash, program);
    self->flash = flash;
    self->loader = loader;
    self->period = loader->f_cpu / TICKS_PER_S;
    self->actuation = (uint32_t)lround(link_actuation_s(&timing) * loader->f_cpu);
    return &self->robot;
}

const char *robot_loader_refuses(const struct avr_image *program, const struct avr_image *loader)
{
    const uint8_t *seal = program->flash + SEAL_AT;

    if (program->f_cpu != loader->f_cpu || program->baud != loader->baud)
        return "was built for another clock or baud rate than";
    if ((seal[0] ^ seal[2]) != 0xFF || (seal[1] ^ seal[3]) != 0xFF)
        return "has no seal and would not be started by";
    return NULL;
}

const uint8_t *robot_loader_flash(const struct sim_robot *robot)
{
    return loader_of(robot)->flash->bytes;
}
