/* fleet.c: whole fleets: what they ask of the robots' processors and of the host. */
#include "fleet.h"
#include "avr_image.h"
#include "benchmarks.h"
#include "limits.h"
#include "results.h"

#include <err.h>
#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define RUNS 3 /* of which the fastest counts */

#define RAM_BYTES 4096
#define USUAL_F_CPU 16000000u

static const struct fleet loads[] = {
    {"load_4_pct", FLEET_FOUR, "duration=30", SIM_AVR, 2},
    {"load_100_pct", FLEET_HUNDRED, "duration=60", SIM_AVR, 2},
};

static const struct fleet speeds[] = {
    {"realtime_4_avr", FLEET_FOUR, "duration=30", SIM_AVR, 1},
    {"realtime_100_avr", FLEET_HUNDRED, "duration=20", SIM_AVR, 2},
    {"realtime_100_native", FLEET_HUNDRED, "duration=60", SIM_NATIVE, 1},
    {"realtime_1000_native", FLEET_THOUSAND, "duration=10", SIM_NATIVE, 2},
};

struct summary fleet_run(const struct fleet *fleet, bool watch_stack, struct view *view)
{
    static const volatile bool stop = false;
    const char *const settings[] = {fleet->setting};
    char error[1024] = "";
    struct summary summary;
    struct sim_options options = {.robots = fleet->robots,
                                  .firmware = BENCH_FIRMWARE,
                                  .out = BENCH_RUNS,
                                  .seed = 1,
                                  .threads = fleet->threads,
                                  .view = view,
                                  .watch_stack = watch_stack,
                                  .quiet = true};
    size_t vertices = fleet->robots == SIM_AVR ? VERTICES_MAX_CHIP : VERTICES_MAX;
    struct scenario *scenario =
        scenario_read(fleet->scenario, settings, 1, vertices, error, sizeof error);

    if (scenario == NULL)
        errx(EXIT_FAILURE, "%s", error);
    if (sim_run(scenario, &options, &stop, &summary, error, sizeof error) != SIM_DONE)
        errx(EXIT_FAILURE, "%s: %s", fleet->scenario, error);
    scenario_free(scenario);
    return summary;
}

/* Another crystal or link makes other loads of the same program. */
static void require_usual_robot(void)
{
    char error[300] = "";
    struct avr_image *image = avr_image_open(BENCH_FIRMWARE, error, sizeof error);

    if (image == NULL)
        errx(EXIT_FAILURE, "%s", error);
    if (image->f_cpu != USUAL_F_CPU || image->baud != NATIVE_BAUD)
        errx(EXIT_FAILURE,
             "the image is for %u Hz and %u baud; type make firmware F_CPU=%u BAUD=%u",
             image->f_cpu, image->baud, USUAL_F_CPU, NATIVE_BAUD);
    avr_image_close(image);
}

/* What the build worked out from the machine code. */
static double stack_bound(void)
{
    FILE *file = fopen(BENCH_STACK, "r");
    double bound;

    if (file == NULL)
        err(EXIT_FAILURE, "%s", BENCH_STACK);
    if (fscanf(file, "stack_bound_bytes %lf", &bound) != 1)
        errx(EXIT_FAILURE, "%s: no bound in it", BENCH_STACK);
    fclose(file);
    return bound;
}

void measure_loads(void)
{
    require_usual_robot();
    double stack = RAM_BYTES - figure_of("ram_static_bytes")->value;

    for (size_t i = 0; i < sizeof loads / sizeof loads[0]; i++) {
        struct summary summary = fleet_run(&loads[i], true, NULL);

        figure_set(loads[i].figure, summary.load_max_pct);
        figure_worst("stack_max_bytes", stack - summary.stack_free_min);
    }
    figure_set("stack_bound_bytes", stack_bound());
    figure_set("ram_and_stack_bytes",
               figure_of("ram_static_bytes")->value + figure_of("stack_max_bytes")->value);
}

void measure_speeds(void)
{
    for (size_t i = 0; i < sizeof speeds / sizeof speeds[0]; i++) {
        double best = 0;

        for (int n = 0; n < RUNS; n++) {
            struct summary summary = fleet_run(&speeds[i], false, NULL);

            best = fmax(best, summary.duration / summary.wall);
        }
        figure_set(speeds[i].figure, best);
    }
}

void measure_robot_memory(void)
{
    enum { ROBOTS = 16 };
    char error[300] = "";
    struct avr_image *image = avr_image_open(BENCH_FIRMWARE, error, sizeof error);
    struct sim_robot *robot[ROBOTS];

    if (image == NULL)
        errx(EXIT_FAILURE, "%s", error);
    struct mallinfo2 before = mallinfo2();
    for (uint16_t i = 0; i < ROBOTS; i++) {
        robot[i] = robot_avr_new((uint16_t)(i + 1), image);
        if (robot[i] == NULL || !robot[i]->kind->power_on(robot[i]))
            errx(EXIT_FAILURE, "no memory for %d robots", ROBOTS);
    }
    struct mallinfo2 after = mallinfo2();
    figure_set(
        "host_bytes_per_avr_robot",
        (double)((after.uordblks + after.hblkhd - before.uordblks - before.hblkhd) / ROBOTS));
    for (int i = 0; i < ROBOTS; i++)
        robot[i]->kind->destroy(robot[i]);
    avr_image_close(image);
}
