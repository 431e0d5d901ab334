#include "sim_state.h"

#include "directory.h"
#include "figures.h"
#include "limits.h"
#include "progress.h"
#include "snapshot.h"
#include "summary.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A fleet that has not acknowledged its mission by then never will, ticks. */
#define ACKNOWLEDGE_TICKS (60 * TICKS_PER_S)

/* Below it no robot runs, unless its own limits say otherwise. */
#define DRAINED_MV 6000

/* Bytes of a period at 1 Mbaud, the fastest a robot can be built for. */
#define RX_MAX 2000

/* ---- building -------------------------------------------------------------------------- */

static bool fail(char *error, size_t room, const char *words)
{
    snprintf(error, room, "%s", words);
    return false;
}

/* The newest sample of a robot, taken before the tick to come. */
static void see(struct sim *sim, size_t i)
{
    const struct machine *m = &sim->machine[i];
    struct server_pose pose = mocap_pose(&sim->mocap, &sim->sample, m->robot->id, &m->body);

    pose.age_ms -= TICK_MS;
    server_see(sim->server, i, &pose);
}

static void provision(const struct sim *sim, struct sim_robot *robot)
{
    const struct parameter_file *file = sim->options->parameters;
    const struct parameter_entry *entry =
        file != NULL ? parameter_file_find(file, robot->id) : NULL;

    if (entry != NULL)
        robot_provision(robot, &entry->parameters);
}

static bool build_robots(struct sim *sim)
{
    for (size_t i = 0; i < sim->scenario->robot_count; i++) {
        const struct scenario_robot *from = &sim->scenario->robots[i];
        struct machine *m = &sim->machine[i];

        m->robot =
            sim->image != NULL ? robot_avr_new(from->id, sim->image) : robot_native_new(from->id);
        m->down = radio_pipe_new(&sim->radio, from->id, RADIO_DOWN, sim->timing.slots);
        m->up = radio_pipe_new(&sim->radio, from->id, RADIO_UP, ROBOT_TX_MAX);
        if (m->robot == NULL || m->down == NULL || m->up == NULL)
            return false;
        provision(sim, m->robot);
        if (sim->image != NULL && sim->options->watch_stack)
            robot_avr_watch_stack(m->robot);
        m->kind = body_kind_of(sim->scenario, from->id);
        m->body =
            (struct body){.x = from->x, .y = from->y, .theta = remainder(from->theta, 2 * M_PI)};
        see(sim, i);
    }
    return true;
}

/* What computes in the robots, and how fast their links are. */
static bool choose_robots(struct sim *sim, char *error, size_t room)
{
    sim->timing = link_timing_of(NATIVE_BAUD);
    if (sim->options->robots == SIM_NATIVE)
        return true;
    sim->image = avr_image_open(sim->options->firmware, error, room);
    if (sim->image == NULL)
        return false;
    sim->timing = link_timing_of(avr_image_baud(sim->image));
    if (sim->timing.slots > RX_MAX)
        return fail(error, room, "the image's link is faster than 1 Mbaud");
    return true;
}

/* From a pose's measurement to the control tick that uses it, at the least: that is what robots'
 * clocks settle on (firmware/core/clock.h). */
static uint8_t latency_ms(const struct sim *sim)
{
    return (uint8_t)(lround(link_phase_s(&sim->timing) * 1000) + sim->radio.least * TICK_MS);
}

static bool build(struct sim *sim, char *error, size_t room)
{
    const struct scenario *scenario = sim->scenario;
    size_t robots = scenario->robot_count;
    struct body_kind nominal = body_kind_nominal(scenario);

    sim->mocap = mocap_of(scenario, sim->options->seed);
    sim->sample = mocap_newest(&sim->mocap, 0);
    sim->radio = radio_of(scenario, sim->options->seed);
    sim->actuation = link_actuation_s(&sim->timing);
    struct plan_robot robot = {
        .track = nominal.track,
        .wheel_max = nominal.wheel_max,
        .latency_ms = latency_ms(sim),
    };
    sim->plan = plan_new(scenario, &robot, sim->options->seed);
    if (sim->plan == NULL)
        return fail(error, room, "no memory");
    void *memory = malloc(server_footprint(&sim->plan->config));
    sim->machine = calloc(robots, sizeof *sim->machine);
    sim->samples = calloc(robots, sizeof *sim->samples);
    sim->scene.robots = calloc(robots, sizeof *sim->scene.robots);
    sim->metrics = metrics_new(scenario);
    sim->drawings = drawings_new(scenario);
    if (memory == NULL || sim->machine == NULL || sim->samples == NULL ||
        sim->scene.robots == NULL || sim->metrics == NULL || sim->drawings == NULL) {
        free(memory);
        return fail(error, room, "no memory");
    }
    sim->server = server_init(memory, &sim->plan->config);
    sim->steer = (struct steer){scenario, sim->server, sim->drawings};
    sim->reference = trajectory_start(scenario->trajectory);
    sim->until = (int32_t)lround(ceil(scenario->duration * TICKS_PER_S)) * TICK_MS;
    if (!build_robots(sim))
        return fail(error, room, "no memory for the robots");
    sim->crew = crew_new(sim->options->threads);
    if (sim->crew == NULL)
        return fail(error, room, "cannot start the threads");
    if (!directory_prepare(sim->options->out, error, room))
        return false;
    struct recording_about about = {
        .scenario = scenario->name,
        .robots = sim->image != NULL ? "avr" : "native",
        .seed = sim->options->seed,
        .duration = scenario->duration,
    };
    struct audience audience = onlookers_audience(sim->options->view);
    sim->record =
        record_open(sim->options->out, &about, sim->options->trace, &audience, error, room);
    return sim->record != NULL;
}

static void demolish(struct sim *sim)
{
    for (size_t i = 0; sim->machine != NULL && i < sim->scenario->robot_count; i++) {
        struct machine *m = &sim->machine[i];

        if (m->robot != NULL)
            m->robot->kind->destroy(m->robot);
        radio_pipe_free(m->down);
        radio_pipe_free(m->up);
    }
    crew_free(sim->crew);
    metrics_free(sim->metrics);
    drawings_free(sim->drawings);
    plan_free(sim->plan);
    if (sim->image != NULL)
        avr_image_close(sim->image);
    free(sim->server);
    free(sim->machine);
    free(sim->samples);
    free(sim->scene.robots);
}

/* ---- power and wheels ------------------------------------------------------------------ */

static bool power_on(struct sim *sim, size_t i)
{
    struct machine *m = &sim->machine[i];

    if (!m->robot->kind->power_on(m->robot))
        return false;
    m->powered = m->booting = true;
    m->left = m->right = 0;
    server_link(sim->server, i, true);
    return true;
}

static void power_off(struct sim *sim, size_t i)
{
    struct machine *m = &sim->machine[i];

    if (!m->powered)
        return;
    m->robot->kind->power_off(m->robot);
    m->powered = false;
    radio_clear(m->down);
    radio_clear(m->up);
    server_link(sim->server, i, false);
}

/* A battery is changed without power. */
static bool revive(struct sim *sim, size_t i)
{
    struct machine *m = &sim->machine[i];

    if (m->robot->battery < BATTERY_FULL_MV)
        power_off(sim, i);
    m->robot->battery = BATTERY_FULL_MV;
    m->stalled = false;
    return m->powered || power_on(sim, i);
}

static bool carry_out(struct sim *sim, const struct server_order *order)
{
    struct machine *m = &sim->machine[order->robot];
    bool good = true;

    if (order->action == EVENT_KILL)
        power_off(sim, order->robot);
    else if (order->action == EVENT_STALL)
        m->stalled = true;
    else if (order->action == EVENT_DRAIN)
        m->robot->battery = DRAINED_MV;
    else
        good = revive(sim, order->robot);
    m->body.held = m->stalled || !m->powered;
    if (m->body.held)
        m->body.left = m->body.right = 0;
    return good;
}

/* ---- one tick -------------------------------------------------------------------------- */

bool sim_drain(struct sim *sim)
{
    struct server_report report;
    struct server_order order;

    while (server_next_report(sim->server, &report)) {
        sim->event |= report.kind == REPORT_EVENT;
        /* Before the count-down every robot is still booting. */
        if (server_time(sim->server) > -TICKS_PER_S * TICK_MS)
            record_event(sim->record, server_time(sim->server), &report);
    }
    while (server_next_order(sim->server, &order))
        if (!carry_out(sim, &order))
            return false;
    return true;
}

static void show_watcher(const struct sim *sim, double t)
{
    struct sim_tick tick = {
        .t = t,
        .formation = server_formation(sim->server),
        .samples = sim->samples,
    };

    if (sim->options->watch != NULL)
        sim->options->watch(sim->options->watcher, &tick);
}

static const struct scenario_formation *formation_in_force(const struct sim *sim)
{
    return drawings_look(sim->drawings, server_formation(sim->server));
}

/* Part of the processor's time since the last look; NAN: it has been off, or is not simulated. */
static float load_since(struct robot_load *before, struct robot_load now)
{
    uint64_t cycles = now.cycles - before->cycles;
    uint64_t asleep = now.asleep - before->asleep;
    bool known = now.cycles > before->cycles;

    *before = now;
    return known ? (float)(cycles - asleep) / (float)cycles : NAN;
}

static void look_at_machines(struct sim *sim)
{
    for (size_t i = 0; i < sim->scenario->robot_count; i++) {
        struct machine *m = &sim->machine[i];

        sim->scene.robots[i].loss = (float)link_loss_look(&m->loss, server_look(sim->server, i));
        sim->scene.robots[i].load = load_since(&m->load, m->robot->kind->load(m->robot));
    }
}

static void take_scene(struct sim *sim)
{
    struct snapshot_of of = {
        .scenario = sim->scenario,
        .server = sim->server,
        .metrics = sim->metrics,
        .samples = sim->samples,
        .formation = formation_in_force(sim),
        .reference = &sim->reference,
    };

    snapshot_take(&sim->scene, &of);
    for (size_t i = 0; i < sim->scenario->robot_count; i++)
        sim->scene.robots[i].stalled = sim->machine[i].stalled;
}

static void take_samples(struct sim *sim)
{
    for (size_t i = 0; i < sim->scenario->robot_count; i++) {
        const struct machine *m = &sim->machine[i];
        const struct server_view *view = server_look(sim->server, i);

        sim->samples[i] = (struct sample){
            .x = m->body.x,
            .y = m->body.y,
            .theta = m->body.theta,
            .v = body_v(&m->body),
            .omega = body_omega(&m->kind, &m->body),
            .role = view->role,
            .vertex = view->vertex,
            .alive = m->powered && view->state != STATE_SPENT,
        };
    }
}

static void record_row(struct sim *sim)
{
    int32_t time = server_time(sim->server);

    if (time > 0)
        sim->reference = trajectory_step(sim->scenario->trajectory, &sim->reference);
    take_samples(sim);
    metrics_tick(sim->metrics, time / 1000.0, sim->samples, server_leader(sim->server),
                 formation_in_force(sim), &sim->reference, sim->event);
    sim->event = false;
    if (record_wants_scenes(sim->record)) {
        if (time % 1000 == 0)
            look_at_machines(sim);
        take_scene(sim);
        record_scene(sim->record, &sim->scene);
    }
    show_watcher(sim, time / 1000.0);
}

void sim_show(struct sim *sim)
{
    take_samples(sim);
    metrics_place(sim->metrics, sim->samples, server_leader(sim->server), formation_in_force(sim),
                  &sim->reference);
    take_scene(sim);
    record_show(sim->record, &sim->scene);
}

/* Bytes that enter a link in this period, in place of which come those that leave it. */
static size_t carry(const struct sim *sim, struct radio_pipe *pipe, uint8_t *bytes, size_t count,
                    size_t room)
{
    if (radio_is_cable(&sim->radio))
        return count;
    radio_put(pipe, sim->tick, bytes, count);
    return radio_take(pipe, sim->tick, bytes, room);
}

static void compute(struct sim *sim, size_t i)
{
    struct machine *m = &sim->machine[i];
    size_t slots = sim->timing.slots;
    uint8_t rx[RX_MAX];
    size_t count = carry(sim, m->down, rx, server_take(sim->server, i, rx, slots), slots);

    m->robot->kind->run(m->robot, rx, count, &m->period);
    m->period.sent = (uint16_t)carry(sim, m->up, m->period.tx, m->period.sent, sizeof m->period.tx);
}

/* A period's motion, and what motion capture makes of it. The newest sample at its end is younger
 * than its set-points, which change half-way through. */
static void move(struct sim *sim, size_t i)
{
    struct machine *m = &sim->machine[i];
    double age = sim->sample.age;

    body_move(&m->kind, &m->body, m->left, m->right, sim->actuation);
    m->left = m->period.left;
    m->right = m->period.right;
    body_move(&m->kind, &m->body, m->left, m->right, TICK_MS / 1000.0 - sim->actuation - age);
    see(sim, i);
    body_move(&m->kind, &m->body, m->left, m->right, age);
}

/* One robot's period: independent of every other's, so any thread may do it. */
static void run_machine(void *context, size_t i)
{
    struct sim *sim = context;
    struct machine *m = &sim->machine[i];

    if (m->powered && !m->booting) {
        compute(sim, i);
        move(sim, i);
        return;
    }
    m->booting = false;
    m->period.sent = 0;
    see(sim, i);
}

static bool run_period(struct sim *sim, char *error, size_t room)
{
    size_t robots = sim->scenario->robot_count;

    sim->sample = mocap_newest(&sim->mocap, sim->tick + 1);
    crew_run(sim->crew, robots, run_machine, sim);
    for (size_t i = 0; i < robots; i++) {
        const struct machine *m = &sim->machine[i];

        if (!m->powered)
            continue;
        if (m->period.crashed) {
            snprintf(error, room, "the processor of robot %u crashed at t = %.2f s", m->robot->id,
                     server_time(sim->server) / 1000.0);
            return false;
        }
        server_receive(sim->server, i, m->period.tx, m->period.sent);
    }
    return true;
}

/* ---- the run --------------------------------------------------------------------------- */

static bool acknowledged_in_time(struct sim *sim, char *error, size_t room)
{
    size_t late = sim->tick < ACKNOWLEDGE_TICKS ? SERVER_NOBODY : server_waits_for(sim->server);

    if (late == SERVER_NOBODY || server_time(sim->server) >= 0)
        return true;
    snprintf(error, room, "robot %u did not acknowledge its mission within %d s",
             sim->scenario->robots[late].id, ACKNOWLEDGE_TICKS / TICKS_PER_S);
    return false;
}

static void show_progress(const struct sim *sim, struct progress *progress)
{
    double done = fmax(0, server_time(sim->server) / 1000.0);
    double whole = sim->scenario->duration;

    progress_show(progress, whole > 0 ? done / whole : 1, "t = %.1f of %g s, %.1f times real time",
                  done, whole, done / progress_elapsed(progress));
}

static enum sim_end loop(struct sim *sim, const volatile bool *stop, char *error, size_t room)
{
    struct progress progress;
    enum sim_end end = SIM_DONE;

    progress_begin(&progress, sim->options->quiet);
    for (size_t i = 0; i < sim->scenario->robot_count; i++)
        if (!power_on(sim, i)) {
            fail(error, room, "no memory for the robots");
            return SIM_FAILED;
        }
    steering_begin(sim);
    for (;; sim->tick++) {
        server_tick(sim->server);
        bool good = sim_drain(sim);
        int32_t time = server_time(sim->server);
        if (good && time >= 0)
            record_row(sim);
        show_progress(sim, &progress);
        if (good && time >= sim->until)
            break;
        if (!good || !steering_wait(sim, stop)) {
            fail(error, room, "no memory for the robots");
            end = SIM_FAILED;
            break;
        }
        if (*stop || sim->ended) {
            end = SIM_INTERRUPTED;
            break;
        }
        if (!run_period(sim, error, room) || !acknowledged_in_time(sim, error, room)) {
            end = SIM_FAILED;
            break;
        }
    }
    progress_end(&progress);
    return end;
}

static struct summary summarise(const struct sim *sim, int64_t began)
{
    int32_t time = server_time(sim->server);
    struct summary summary = {
        .scenario = sim->scenario,
        .seed = sim->options->seed,
        .avr = sim->image != NULL,
        .duration = time > 0 ? time / 1000.0 : 0,
        .wall = (double)(wall_ns() - began) / 1e9,
        .metrics = metrics_result(sim->metrics),
        .link = server_count(sim->server),
        .stack_free_min = UINT16_MAX,
    };

    for (size_t i = 0; i < sim->scenario->robot_count; i++) {
        const struct sim_robot *robot = sim->machine[i].robot;
        struct robot_load load = robot->kind->load(robot);

        if (load.cycles > 0)
            summary.load_max_pct =
                fmax(summary.load_max_pct,
                     100.0 * (double)(load.cycles - load.asleep) / (double)load.cycles);
        if (load.tick_cycles > summary.tick_cycles_max)
            summary.tick_cycles_max = load.tick_cycles;
        if (load.stack_free < summary.stack_free_min)
            summary.stack_free_min = load.stack_free;
    }
    return summary;
}

static bool write_files(struct sim *sim, const struct summary *summary, char *error, size_t room)
{
    bool recorded = record_close(sim->record, error, room);

    return summary_write(summary, sim->options->out, error, room) && recorded;
}

enum sim_end sim_run(const struct scenario *scenario, const struct sim_options *options,
                     const volatile bool *stop, struct summary *summary, char *error, size_t room)
{
    struct sim sim = {.scenario = scenario, .options = options};
    enum sim_end end = SIM_FAILED;

    if (!choose_robots(&sim, error, room))
        return SIM_REFUSED;
    if (build(&sim, error, room)) {
        int64_t began = wall_ns();

        end = loop(&sim, stop, error, room);
        steering_tell(&sim, end == SIM_FAILED ? "failed" : "over", true);
        *summary = summarise(&sim, began);
        /* What stopped the run is worth more words than what then went wrong. */
        if (end == SIM_FAILED)
            write_files(&sim, summary, (char[1]){0}, 1);
        else if (!write_files(&sim, summary, error, room))
            end = SIM_FAILED;
        if (end != SIM_FAILED && options->trace)
            figures_write(options->out);
    }
    demolish(&sim);
    return end;
}
