#include "serve_state.h"

#include "awake.h"
#include "body.h"
#include "directory.h"
#include "figures.h"
#include "limits.h"
#include "summary.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

/* From a pose's measurement to the control tick that uses it, at the least, ms: its bytes on the
 * UART, and with a radio what HC-05 and HC-06 modules are known to take. */
#define CABLE_LATENCY_MS 2
#define RADIO_LATENCY_MS 20

/* An adapter has 800 exchanges a second for its seven robots, both ways (docs/hardware.md). */
#define RADIO_POSES 60

/* ---- building -------------------------------------------------------------------------- */

static bool fail(char *error, size_t room, const char *words)
{
    snprintf(error, room, "%s", words);
    return false;
}

static const struct site_robot *find_robot(const struct site *site, uint16_t id)
{
    for (size_t i = 0; i < site->robot_count; i++)
        if (site->robots[i].id == id)
            return &site->robots[i];
    return NULL;
}

/* Between a robot's poses, at the least. Half of its UART's time is for the mission and for
 * beacons, whatever the baud rate. */
static int64_t spacing_us(const struct site *site, const struct link_settings *link)
{
    int64_t uart_us = 2 * FRAME_BYTES(POSE_BYTES) * INT64_C(10000000) / link->baud;
    int64_t asked_us = link->address.kind == LINK_RFCOMM ? 1000000 / RADIO_POSES : 0;

    if (!isnan(site->poses))
        asked_us = (int64_t)(1e6 / site->poses);
    return asked_us > uart_us ? asked_us : uart_us;
}

static bool match_robots(struct serve *s, char *error, size_t room)
{
    for (size_t i = 0; i < s->count; i++) {
        uint16_t id = s->scenario->robots[i].id;
        const struct site_robot *robot = find_robot(s->site, id);

        if (robot == NULL) {
            snprintf(error, room, "scenario %s has a robot %u, of which site %s says nothing",
                     s->scenario->name, id, s->site->name);
            return false;
        }
        s->link_settings[i] = robot->link;
        s->member[i].spacing_us = spacing_us(s->site, &robot->link);
        s->bodies[i] = (struct tracker_body){robot->name, robot->body, robot->heading};
    }
    return true;
}

static uint8_t latency_ms(const struct serve *s)
{
    unsigned latency = CABLE_LATENCY_MS;

    if (!isnan(s->site->latency))
        return (uint8_t)lround(s->site->latency * 1000);
    for (size_t i = 0; i < s->count; i++)
        if (s->link_settings[i].address.kind == LINK_RFCOMM)
            latency = RADIO_LATENCY_MS;
    return (uint8_t)fmin(UINT8_MAX, latency + round(s->site->tracker.latency * 1000));
}

static double or_else(double value, double otherwise)
{
    return isnan(value) ? otherwise : value;
}

static bool build_core(struct serve *s, char *error, size_t room)
{
    struct body_kind body = body_kind_nominal(s->scenario);
    struct plan_robot robot = {
        .track = or_else(s->site->track, body.track),
        .wheel_max = or_else(s->site->wheel_max, body.wheel_max),
        .latency_ms = latency_ms(s),
    };

    s->plan = plan_new(s->scenario, &robot, s->options->seed);
    if (s->plan == NULL)
        return fail(error, room, "no memory");
    struct server_config *config = &s->plan->config;
    config->waits = true;
    config->range = or_else(s->site->range, config->range);
    config->loss = or_else(s->site->loss, config->loss);
    config->delay = or_else(s->site->delay, config->delay);
    void *memory = malloc(server_footprint(config));
    if (memory == NULL)
        return fail(error, room, "no memory");
    s->core = server_init(memory, config);
    s->drawings = drawings_new(s->scenario);
    s->steer = (struct steer){s->scenario, s->core, s->drawings};
    return s->drawings != NULL || fail(error, room, "no memory");
}

static bool build_arrays(struct serve *s, char *error, size_t room)
{
    s->link_settings = calloc(s->count, sizeof *s->link_settings);
    s->bodies = calloc(s->count, sizeof *s->bodies);
    s->member = calloc(s->count, sizeof *s->member);
    s->places = calloc(s->count, sizeof *s->places);
    s->samples = calloc(s->count, sizeof *s->samples);
    s->scene.robots = calloc(s->count, sizeof *s->scene.robots);
    s->table_room = 512 * (s->count + 8);
    s->table = malloc(s->table_room);
    s->metrics = metrics_new(s->scenario);
    if (s->link_settings == NULL || s->bodies == NULL || s->member == NULL || s->places == NULL ||
        s->samples == NULL || s->scene.robots == NULL || s->table == NULL || s->metrics == NULL)
        return fail(error, room, "no memory");
    return true;
}

static bool build_tracker(struct serve *s, char *error, size_t room)
{
    void *memory = malloc(tracker_footprint(s->count));

    if (memory == NULL)
        return fail(error, room, "no memory");
    s->tracker = tracker_init(memory, &s->site->tracker, s->bodies, s->count);
    return true;
}

static bool build_files(struct serve *s, char *error, size_t room)
{
    if (s->options->what == SERVE_CHECK)
        return true;
    if (!directory_prepare(s->options->out, error, room))
        return false;
    struct recording_about about = {
        .scenario = s->scenario->name,
        .robots = "real",
        .seed = s->options->seed,
        .duration = s->scenario->duration,
    };
    struct audience audience = onlookers_audience(s->options->view);
    s->record = record_open(s->options->out, &about, s->options->trace, &audience, error, room);
    return s->record != NULL;
}

/* ---- the loop's ends ------------------------------------------------------------------- */

static void say_of_source(void *serve, bool problem, const char *words)
{
    struct serve *s = serve;

    (void)problem;
    console_say(&s->console, "mocap: %s", words);
    if (s->record != NULL)
        record_note(s->record, server_time(s->core), 0, "mocap", words);
}

static void on_timer(struct watch *watch, uint32_t events)
{
    struct serve *s = (struct serve *)((char *)watch - offsetof(struct serve, timer));
    uint64_t due = loop_periods(watch->fd);

    (void)events;
    /* None is left out, for robots' clocks have gone on as well. */
    for (; due > 0 && s->phase != PHASE_OVER; due--)
        tick(s, s->tick_us + TICK_MS * 1000);
    tick_flush(s);
}

void serve_leave(struct serve *s, const char *who)
{
    serve_stop(s, s->options->what == SERVE_CHECK ? SERVE_BAD : SERVE_DONE, "ended by %s", who);
}

static void on_signal(struct watch *watch, uint32_t events)
{
    struct serve *s = (struct serve *)((char *)watch - offsetof(struct serve, signals));
    int signal = loop_signal(watch->fd);

    (void)events;
    if (signal == 0)
        return;
    if (signal == SIGUSR1)
        serve_estop(s);
    else if (s->phase == PHASE_STOP)
        s->phase = PHASE_OVER; /* somebody is in a hurry */
    else
        serve_leave(s, signal == SIGINT ? "Ctrl-C" : "SIGTERM");
}

static void on_key(struct watch *watch, uint32_t events)
{
    struct serve *s = (struct serve *)((char *)watch - offsetof(struct serve, keys));
    const char *refusal;

    (void)events;
    switch (console_key()) {
    case -1: loop_forget(&s->loop, watch); break;
    case 'e': serve_estop(s); break;
    case 'b':
        tracker_believe(s->tracker);
        console_say(&s->console, "bodies that have jumped are believed where they are seen next");
        break;
    case 'q': serve_leave(s, "its operator"); break;
    case '\n':
        if (s->phase != PHASE_GATHER || s->options->what == SERVE_CHECK)
            break;
        refusal = serve_begin(s);
        if (refusal != NULL)
            console_say(&s->console, "the mission cannot begin yet: %s", refusal);
        break;
    default: break;
    }
}

static bool watch_own(struct serve *s, char *error, size_t room)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGUSR1, 0};

    s->timer = (struct watch){.fd = loop_timer(TICK_MS * 1000), .ready = on_timer};
    s->tick_us = s->began_us = loop_now();
    s->signals = (struct watch){.fd = loop_signals(signals), .ready = on_signal};
    s->keys = (struct watch){.fd = STDIN_FILENO, .ready = on_key};
    bool good = s->timer.fd >= 0 && s->signals.fd >= 0 &&
                loop_watch(&s->loop, &s->timer, EPOLLIN) &&
                loop_watch(&s->loop, &s->signals, EPOLLIN);
    if (good && s->console.keyed)
        good = loop_watch(&s->loop, &s->keys, EPOLLIN);
    if (good && s->options->view != NULL)
        good = acts_watch(s);
    if (!good)
        snprintf(error, room, "cannot watch timer, signals and keys: %s", strerror(errno));
    return good;
}

static bool open_world(struct serve *s, char *error, size_t room)
{
    static const struct source_owner to_source = {NULL, pass_frame, say_of_source};
    static const struct link_owner to_links = {NULL, pass_up, pass_down, pass_received};

    s->source_owner = to_source;
    s->link_owner = to_links;
    s->source_owner.context = s->link_owner.context = s;
    s->links = links_open(&s->loop, s->link_settings, s->count, &s->link_owner, error, room);
    if (s->links == NULL)
        return false;
    s->source = source_open(&s->loop, &s->site->mocap, &s->source_owner, error, room);
    return s->source != NULL;
}

static bool build(struct serve *s, char *error, size_t room)
{
    if (!build_arrays(s, error, room) || !match_robots(s, error, room))
        return false;
    s->end = SERVE_FAILED; /* from here on it is not the input's fault */
    if (!build_core(s, error, room) || !build_tracker(s, error, room) ||
        !build_files(s, error, room))
        return false;
    s->limits = (struct guard_limits){.fenced = s->site->fenced, .separation = s->site->separation};
    memcpy(s->limits.fence, s->site->fence, sizeof s->limits.fence);
    s->reference = trajectory_start(s->scenario->trajectory);
    s->until = (int32_t)lround(ceil(s->scenario->duration * TICKS_PER_S)) * TICK_MS;
    s->awake = awake_hold();
    return watch_own(s, error, room) && open_world(s, error, room);
}

static void demolish(struct serve *s)
{
    if (s->source != NULL)
        source_close(s->source);
    if (s->links != NULL)
        links_close(s->links);
    if (s->timer.fd > 0)
        close(s->timer.fd);
    if (s->signals.fd > 0)
        close(s->signals.fd);
    if (s->awake >= 0)
        close(s->awake);
    metrics_free(s->metrics);
    drawings_free(s->drawings);
    plan_free(s->plan);
    free(s->core);
    free(s->tracker);
    free(s->link_settings);
    free(s->bodies);
    free(s->member);
    free(s->places);
    free(s->samples);
    free(s->scene.robots);
    free(s->table);
}

/* ---- beginning and end ----------------------------------------------------------------- */

bool serve_is_ready(const struct serve *s, size_t robot)
{
    const struct server_view *view = server_look(s->core, robot);
    const struct tracker_view *seen = tracker_look(s->tracker, robot);

    return view->linked && view->acknowledged && seen->tracked &&
           s->tick_us - seen->measured_us <= SERVER_POSE_OLD_MS * 1000;
}

static bool has_candidate(const struct serve *s)
{
    for (size_t i = 0; i < s->count; i++)
        if (s->scenario->robots[i].candidate && serve_is_ready(s, i))
            return true;
    return false;
}

const char *serve_begin(struct serve *s)
{
    char words[200];

    if (s->phase != PHASE_GATHER)
        return "it has begun";
    if (s->estopped)
        return "emergency stop";
    if (s->alarmed)
        return "robots stand where they may not";
    if (!has_candidate(s))
        return "no candidate is ready";
    table_missing(s, words, sizeof words);
    if (words[0] != '\0')
        console_say(&s->console, "the mission begins without %s", words);
    for (size_t i = 0; tracker_stranger(s->tracker, i) != NULL; i++)
        console_say(&s->console, "mocap: %s is tracked and no robot's",
                    tracker_stranger(s->tracker, i));
    server_begin(s->core);
    s->phase = PHASE_RUN;
    s->phase_tick = s->ticks;
    acts_tell(s);
    return NULL;
}

void serve_stop(struct serve *s, enum serve_end end, const char *format, ...)
{
    va_list arguments;

    if (s->phase >= PHASE_STOP)
        return;
    tick_chores(s);
    va_start(arguments, format);
    vsnprintf(s->reason, sizeof s->reason, format, arguments);
    va_end(arguments);
    if (s->options->what == SERVE_RUN)
        console_say(&s->console, "stop: %s", s->reason);
    if (s->record != NULL)
        record_note(s->record, server_time(s->core), 0, "stop", s->reason);
    s->ended_ms = server_time(s->core);
    s->metrics_end = metrics_result(s->metrics);
    s->end = end;
    s->phase = PHASE_STOP;
    s->phase_tick = s->ticks;
    server_halt(s->core, SERVER_NOBODY);
    for (size_t i = 0; i < s->count; i++)
        pass_flush(s, i, loop_now());
    acts_tell(s);
}

void serve_estop(struct serve *s)
{
    if (s->estopped)
        return;
    s->estopped = true;
    server_estop(s->core);
    for (size_t i = 0; i < s->count; i++)
        pass_flush(s, i, loop_now());
    console_say(&s->console,
                "emergency stop: robots stay stopped until they are switched off; q leaves");
    acts_tell(s);
    if (s->record != NULL)
        record_note(s->record, server_time(s->core), 0, "estop", "");
}

/* By way of memory: a reader that is stuck must not keep the server from leaving. */
static void print_summary(struct serve *s, const struct summary *summary)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    if (out == NULL)
        return;
    summary_print(summary, s->options->out, out);
    if (fclose(out) == 0)
        console_print(&s->console, text, length);
    free(text);
}

static void write_files(struct serve *s)
{
    struct live_summary live = {
        .delay_p50_us = histogram_at(&s->delay, 0.5),
        .delay_p99_us = histogram_at(&s->delay, 0.99),
        .delay_max_us = s->delay.most,
        .frames = source_counts(s->source).frames,
        .skipped = source_counts(s->source).skipped,
        .links_lost = s->links_lost,
        .end = s->reason,
    };
    struct summary summary = {
        .scenario = s->scenario,
        .seed = s->options->seed,
        .duration = fmax(0, s->ended_ms / 1000.0),
        .wall = (double)(loop_now() - s->began_us) / 1e6,
        .metrics = s->metrics_end,
        .link = server_count(s->core),
        .live = &live,
    };
    char error[512];

    bool recorded = record_close(s->record, error, sizeof error);
    if (!summary_write(&summary, s->options->out, error, sizeof error) || !recorded) {
        console_say(&s->console, "%s", error);
        s->end = SERVE_FAILED;
        return;
    }
    if (s->options->trace && summary.duration > 0)
        figures_write(s->options->out);
    if (!s->options->quiet)
        print_summary(s, &summary);
}

static void finish(struct serve *s)
{
    console_table(&s->console, "", 0);
    acts_tell(s);
    if (s->record != NULL)
        write_files(s);
    s->record = NULL;
}

static bool loop(struct serve *s, char *error, size_t room)
{
    sd_notify(0, "READY=1");
    while (s->phase != PHASE_OVER) {
        if (!loop_wait(&s->loop)) {
            snprintf(error, room, "cannot wait for what happens: %s", strerror(errno));
            return false;
        }
    }
    sd_notify(0, "STOPPING=1");
    return true;
}

enum serve_end serve_run(const struct site *site, const struct scenario *scenario,
                         const struct serve_options *options, char *error, size_t room)
{
    struct serve s = {
        .site = site,
        .scenario = scenario,
        .options = options,
        .count = scenario->robot_count,
        .end = SERVE_REFUSED,
        .awake = -1,
    };

    if (!loop_open(&s.loop)) {
        snprintf(error, room, "cannot wait for anything: %s", strerror(errno));
        return SERVE_FAILED;
    }
    console_open(&s.console, options->quiet);
    if (build(&s, error, room)) {
        if (loop(&s, error, room))
            finish(&s);
        else
            s.end = SERVE_FAILED;
    }
    if (s.record != NULL)
        record_close(s.record, (char[1]){0}, 1);
    demolish(&s);
    console_close(&s.console);
    loop_close(&s.loop);
    return s.end;
}
