#include "runs.h"

#include "limits.h"
#include "message.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *const scheme_words[SCHEME_COUNT] = {"cpa", "rigid", "optimal"};
const char *const law_words[LAW_COUNT] = {
    [LAW_FL] = "fl", [LAW_KANAYAMA] = "kanayama", [LAW_PID] = "pid"};

/* Figures as bits. */
#define FIGURE(n) (UINT32_C(1) << (n))
#define FIGURES(from, to) (FIGURE((to) + 1) - FIGURE(from))

/* ---- which there are ------------------------------------------------------------------- */

void run_set(struct run *run, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(run->setting[run->settings++], RUN_SETTING_MAX, format, arguments);
    va_end(arguments);
}

static void plan(struct run *run, const char *file, const char *suffix, uint32_t figures)
{
    run->file = file;
    run->figures = figures;
    snprintf(run->name, sizeof run->name, "%.*s%s", (int)strcspn(file, "."), file, suffix);
}

static void plan_laws(struct runs *runs)
{
    static const struct {
        const char *file, *suffix;
    } tasks[TASK_COUNT] = {
        [STRAIGHT] = {"paper-law-straight.yaml", ""},
        [STRAIGHT_TURNED] = {"paper-law-straight.yaml", "-turned"},
        [CURVE] = {"paper-law-curve.yaml", ""},
        [CURVE_TURNED] = {"paper-law-curve.yaml", "-turned"},
    };

    for (int task = 0; task < TASK_COUNT; task++) {
        for (int law = 0; law < LAW_COUNT; law++) {
            struct run *run = &runs->law[task][law];
            char suffix[24];

            snprintf(suffix, sizeof suffix, "%s-%s", tasks[task].suffix, law_words[law]);
            plan(run, tasks[task].file, suffix, FIGURE(1));
            run_set(run, "motion.law=%s", law_words[law]);
            if (tasks[task].suffix[0] != '\0')
                run_set(run, "robots.0.pose.2=pi");
        }
    }
}

/* The same scenario under each allocation; the baselines serve fewer figures. */
static void plan_schemes(struct run *runs, const char *file, uint32_t figures, uint32_t compared)
{
    for (int scheme = 0; scheme < SCHEME_COUNT; scheme++) {
        char suffix[16];

        snprintf(suffix, sizeof suffix, "-%s", scheme_words[scheme]);
        plan(&runs[scheme], file, suffix, scheme == CPA ? figures | compared : compared);
        run_set(&runs[scheme], "allocation=%s", scheme_words[scheme]);
    }
}

static void plan_hundred(struct runs *runs)
{
    static const char *const files[READING_COUNT] = {
        [AS_PRINTED] = "paper-sim-100-as-printed.yaml",
        [V_ALONG] = "paper-sim-100-v-along.yaml",
        [V_MIRRORED] = "paper-sim-100-v-mirrored.yaml",
    };

    for (int reading = 0; reading < READING_COUNT; reading++) {
        for (int reach = 0; reach < REACH_COUNT; reach++) {
            for (int scheme = 0; scheme < SCHEME_COUNT; scheme++) {
                struct run *run = &runs->hundred[reading][reach][scheme];
                int range = reach == RANGE_1 ? 1 : 3;
                char suffix[24];

                snprintf(suffix, sizeof suffix, "-%dm-%s", range, scheme_words[scheme]);
                plan(run, files[reading], suffix, FIGURE(11));
                run_set(run, "network.range=%d", range);
                run_set(run, "allocation=%s", scheme_words[scheme]);
                run->native = scheme != CPA;
            }
        }
    }
}

void runs_plan(struct runs *runs)
{
    memset(runs, 0, sizeof *runs);
    plan_laws(runs);
    plan_schemes(runs->fault, "paper-sim-leader-fault.yaml", FIGURES(5, 7), FIGURE(10));
    plan_schemes(runs->change, "paper-sim-formation-change.yaml", FIGURES(8, 9), FIGURE(10));
    plan_hundred(runs);
    plan(&runs->fault_experiment, "paper-exp-leader-fault.yaml", "", FIGURES(14, 16));
    plan(&runs->change_experiment, "paper-exp-formation-change.yaml", "", FIGURES(17, 19));
}

void run_forget(struct run *run)
{
    scenario_free(run->scenario);
    history_free(&run->history);
    run->scenario = NULL;
    run->done = false;
}

void runs_free(struct runs *runs)
{
    for (size_t i = 0; i < RUN_COUNT; i++)
        run_forget(&runs->all[i]);
}

/* ---- running one ----------------------------------------------------------------------- */

enum sim_robots run_robots(const struct run *run, const struct paper_options *options)
{
    return run->native ? SIM_NATIVE : options->robots;
}

bool run_prepare(struct run *run, const struct paper_options *options, char *error, size_t room)
{
    const char *settings[RUN_SETTINGS];
    size_t vertices = run_robots(run, options) == SIM_AVR ? VERTICES_MAX_CHIP : VERTICES_MAX;
    char path[512];

    for (size_t i = 0; i < run->settings; i++)
        settings[i] = run->setting[i];
    snprintf(path, sizeof path, "%s/%s", options->scenarios, run->file);
    run->scenario = scenario_read(path, settings, run->settings, vertices, error, room);
    return run->scenario != NULL;
}

struct witness {
    struct run *run;
    struct reference_state reference;
    const struct run_watch *watch;
};

static bool begin_history(struct history *history, const struct scenario *scenario)
{
    if (!history_begin(history, scenario->robot_count,
                       (size_t)ceil(scenario->duration * TICKS_PER_S) + 1))
        return false;
    for (size_t i = 0; i < scenario->robot_count; i++)
        history->id[i] = scenario->robots[i].id;
    for (size_t i = 0; i < scenario->formation_count; i++) {
        const struct scenario_formation *formation = &scenario->formations[i];
        struct shape *shape = history_add_shape(history, formation->name, formation->count);

        if (shape == NULL)
            return false;
        for (size_t j = 0; j < formation->count; j++)
            shape->vertices[j] = (struct scene_point){formation->L[j] * cos(formation->psi[j]),
                                                      formation->L[j] * sin(formation->psi[j])};
    }
    return true;
}

static void keep(struct history *history, const struct sim_tick *tick,
                 const struct reference_state *reference)
{
    struct glimpse *glimpses = history_add(history);

    if (glimpses == NULL)
        return;
    history->moments[history->ticks - 1] = (struct moment){
        .time_ms = (int32_t)lround(tick->t * 1000),
        .formation = (uint8_t)tick->formation,
        .reference = {reference->x, reference->y, reference->theta},
    };
    for (size_t i = 0; i < history->robots; i++) {
        const struct sample *s = &tick->samples[i];

        glimpses[i] = (struct glimpse){
            .x = (float)s->x,
            .y = (float)s->y,
            .theta = (float)s->theta,
            .omega = (float)s->omega,
            .error = (float)s->distance_error,
            .vertex = s->vertex,
            .role = s->role,
            .alive = s->alive,
        };
    }
}

static void see(void *context, const struct sim_tick *tick)
{
    struct witness *witness = context;
    struct trajectory *trajectory = witness->run->scenario->trajectory;

    keep(&witness->run->history, tick, &witness->reference);
    witness->reference = trajectory_step(trajectory, &witness->reference);
    if (witness->watch != NULL)
        witness->watch->tick(witness->watch->watcher, tick->t);
}

enum sim_end run_carry_out(struct run *run, const struct paper_options *options,
                           const struct run_watch *watch, const volatile bool *stop, char *error,
                           size_t room)
{
    char out[512];
    struct witness witness = {run, trajectory_start(run->scenario->trajectory), watch};
    struct sim_options sim = {
        .robots = run_robots(run, options),
        .firmware = options->firmware,
        .out = out,
        .seed = 1,
        .threads = options->threads,
        .quiet = true,
        .watch = see,
        .watcher = &witness,
    };

    snprintf(out, sizeof out, "%s/runs/%s", options->out, run->name);
    if (!begin_history(&run->history, run->scenario)) {
        snprintf(error, room, "no memory");
        return SIM_FAILED;
    }
    enum sim_end end = sim_run(run->scenario, &sim, stop, &run->summary, error, room);
    run->done = end == SIM_DONE;
    return end;
}
