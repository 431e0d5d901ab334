#include "calibrate_fleet.h"

#include "crew.h"
#include "limits.h"
#include "progress.h"
#include "rehearsal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Virtual time between two looks at how far they are, ticks. */
#define STRETCH 50

/* No calibration takes longer, s. */
#define LIMIT_S 120

/* Bytes of a period at 1 Mbaud, the fastest a robot can be built for. */
#define SLOTS_MAX 2000

/* One robot with an arena for itself. */
struct arena {
    struct rehearsal_member member;
    struct turns turns;
    struct turns_place place;
    int64_t now_us;
    bool crashed;
};

struct fleet {
    const struct scenario *scenario;
    const struct calibrate_fleet_options *options;
    struct calibration_settings settings;
    struct calibration *calibrations;
    struct avr_image *image;
    struct link_timing timing;
    struct mocap mocap;
    struct radio radio;
    struct arena *arena;
    struct crew *crew;
};

static bool fail(char *error, size_t room, const char *words)
{
    snprintf(error, room, "%s", words);
    return false;
}

/* ---- building -------------------------------------------------------------------------- */

static bool build_arena(struct fleet *fleet, size_t i)
{
    const struct scenario_robot *from = &fleet->scenario->robots[i];
    struct arena *arena = &fleet->arena[i];
    struct rehearsal_member *m = &arena->member;

    arena->place.id = from->id;
    arena->turns = (struct turns){.count = 1, .place = &arena->place};
    calibration_begin(&fleet->calibrations[i], from->id, &fleet->settings, &arena->turns, 0);
    *m = (struct rehearsal_member){
        .robot = fleet->image != NULL ? robot_avr_new(from->id, fleet->image)
                                      : robot_native_new(from->id),
        .job = &fleet->calibrations[i].job,
        .kind = body_kind_of(fleet->scenario, from->id),
        .body = {.x = from->x, .y = from->y, .theta = remainder(from->theta, 2 * M_PI)},
        .mocap = &fleet->mocap,
    };
    if (!radio_is_cable(&fleet->radio)) {
        m->radio[RADIO_DOWN] =
            radio_pipe_new(&fleet->radio, from->id, RADIO_DOWN, fleet->timing.slots);
        m->radio[RADIO_UP] = radio_pipe_new(&fleet->radio, from->id, RADIO_UP, ROBOT_TX_MAX);
        if (m->radio[RADIO_DOWN] == NULL || m->radio[RADIO_UP] == NULL)
            return false;
    }
    return m->robot != NULL && m->robot->kind->power_on(m->robot);
}

static bool choose_robots(struct fleet *fleet, char *error, size_t room)
{
    fleet->timing = link_timing_of(NATIVE_BAUD);
    if (fleet->options->robots == SIM_NATIVE)
        return true;
    fleet->image = avr_image_open(fleet->options->firmware, error, room);
    if (fleet->image == NULL)
        return false;
    fleet->timing = link_timing_of(avr_image_baud(fleet->image));
    return fleet->timing.slots <= SLOTS_MAX ||
           fail(error, room, "the image's link is faster than 1 Mbaud");
}

static bool build(struct fleet *fleet, char *error, size_t room)
{
    const struct scenario *scenario = fleet->scenario;
    struct body_kind nominal = body_kind_nominal(scenario);

    fleet->settings = (struct calibration_settings){
        .wheels = {nominal.track, nominal.wheel_max},
        .save = true,
    };
    fleet->mocap = mocap_of(scenario, fleet->options->seed);
    fleet->radio = radio_of(scenario, fleet->options->seed);
    fleet->arena = calloc(scenario->robot_count, sizeof *fleet->arena);
    fleet->crew = crew_new(fleet->options->threads);
    if (fleet->arena == NULL || fleet->crew == NULL)
        return fail(error, room, "no memory for the robots");
    for (size_t i = 0; i < scenario->robot_count; i++)
        if (!build_arena(fleet, i))
            return fail(error, room, "no memory for the robots");
    return true;
}

static void demolish(struct fleet *fleet)
{
    for (size_t i = 0; fleet->arena != NULL && i < fleet->scenario->robot_count; i++) {
        struct rehearsal_member *m = &fleet->arena[i].member;

        if (m->robot != NULL)
            m->robot->kind->destroy(m->robot);
        radio_pipe_free(m->radio[RADIO_DOWN]);
        radio_pipe_free(m->radio[RADIO_UP]);
    }
    crew_free(fleet->crew);
    free(fleet->arena);
    if (fleet->image != NULL)
        avr_image_close(fleet->image);
}

/* ---- running --------------------------------------------------------------------------- */

static void stretch(void *context, size_t i)
{
    struct fleet *fleet = context;
    struct arena *arena = &fleet->arena[i];
    struct job *job = arena->member.job;

    for (int tick = 0; tick < STRETCH && job->state == JOB_WORKING && !arena->crashed; tick++)
        arena->crashed = !rehearsal_tick(&arena->member, 1, &fleet->timing, &arena->now_us, NULL);
}

/* False when there is nothing more to be done. */
static bool judge(const struct fleet *fleet, struct progress *progress, enum sim_end *end,
                  char *error, size_t room)
{
    size_t count = fleet->scenario->robot_count;
    double done = 0;
    size_t ended = 0;

    for (size_t i = 0; i < count; i++) {
        const struct arena *arena = &fleet->arena[i];

        if (arena->crashed) {
            snprintf(error, room, "the processor of robot %u crashed at %.2f s", arena->place.id,
                     (double)arena->now_us / 1e6);
            *end = SIM_FAILED;
            return false;
        }
        if (arena->now_us > LIMIT_S * INT64_C(1000000))
            job_failed(arena->member.job, "was not done within %d s", LIMIT_S);
        ended += arena->member.job->state != JOB_WORKING;
        done += arena->member.job->state != JOB_WORKING ? 1 : arena->member.job->progress;
    }
    progress_show(progress, done / (double)count, "%zu of %zu robots calibrated", ended, count);
    return ended < count;
}

static enum sim_end run(struct fleet *fleet, const volatile bool *stop, char *error, size_t room)
{
    struct progress progress;
    enum sim_end end = SIM_DONE;

    progress_begin(&progress, fleet->options->quiet);
    do {
        crew_run(fleet->crew, fleet->scenario->robot_count, stretch, fleet);
        if (*stop)
            end = SIM_INTERRUPTED;
    } while (end == SIM_DONE && judge(fleet, &progress, &end, error, room));
    progress_end(&progress);
    return end;
}

enum sim_end calibrate_fleet(const struct scenario *scenario,
                             const struct calibrate_fleet_options *options,
                             const volatile bool *stop, struct calibration *calibrations,
                             char *error, size_t room)
{
    struct fleet fleet = {
        .scenario = scenario,
        .options = options,
        .calibrations = calibrations,
    };
    enum sim_end end = SIM_REFUSED;

    if (choose_robots(&fleet, error, room))
        end = build(&fleet, error, room) ? run(&fleet, stop, error, room) : SIM_FAILED;
    demolish(&fleet);
    return end;
}
