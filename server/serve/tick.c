#include "serve_state.h"

#include "limits.h"
#include "snapshot.h"

#include <math.h>
#include <stdlib.h>
#include <systemd/sd-daemon.h>

/* A robot that motion capture has shown within this time gets all its bytes with its poses. */
#define POSE_DRIVEN_US 100000

/* Motion capture that has been silent for so long says nothing of single bodies. */
#define FRAMES_DUE_US 100000

/* Where a robot was this long ago it may still be. */
#define PLACE_KEPT_US 1000000

/* In ticks: how often what is slower than a tick is done. */
#define TEND_TICKS 5
#define SHOW_TICKS 5
#define DRAW_TICKS 10
#define RATE_TICKS 50
#define LINE_TICKS 250

/* How robots count the longest of their control ticks (message.h), and how fast they are clocked.
 */
#define CYCLES_PER_UNIT 8
#define CYCLES_PER_S 16000000

/* Robots that are halted say so at once; on a bad link the word may be lost. */
#define STOP_TICKS 25

/* ---- the run's files ------------------------------------------------------------------- */

/* Where a robot is at the tick: its last pose carried on along its course. */
static struct sample sample_of(const struct serve *s, size_t i)
{
    const struct tracker_view *seen = tracker_look(s->tracker, i);
    const struct server_view *view = server_look(s->core, i);
    double age = (double)(s->tick_us - seen->measured_us) / 1e6;
    double carried = seen->seen && age < SERVER_POSE_OLD_MS / 1000.0 ? age : 0;
    double course = seen->theta + seen->omega * carried / 2;

    return (struct sample){
        .x = seen->x + seen->v * carried * cos(course),
        .y = seen->y + seen->v * carried * sin(course),
        .theta = remainder(seen->theta + seen->omega * carried, 2 * M_PI),
        .v = seen->v,
        .omega = seen->omega,
        .role = view->role,
        .vertex = view->vertex,
        .alive = view->linked && view->state != STATE_SPENT,
    };
}

static const struct scenario_formation *formation_in_force(const struct serve *s)
{
    return drawings_look(s->drawings, server_formation(s->core));
}

/* Part of a control tick's time, at the most since the robot's last reset. */
static float load_of(const struct server_view *view)
{
    return view->tick_cycles == 0
               ? NAN
               : (float)view->tick_cycles * CYCLES_PER_UNIT / (CYCLES_PER_S / TICKS_PER_S);
}

static void take_scene(struct serve *s)
{
    struct snapshot_of of = {
        .scenario = s->scenario,
        .server = s->core,
        .metrics = s->metrics,
        .samples = s->samples,
        .formation = formation_in_force(s),
        .reference = &s->reference,
    };

    snapshot_take(&s->scene, &of);
    for (size_t i = 0; i < s->count; i++) {
        s->scene.robots[i].loss = (float)s->member[i].loss;
        s->scene.robots[i].load = load_of(server_look(s->core, i));
        s->scene.robots[i].stalled = s->member[i].withheld;
    }
}

static void take_samples(struct serve *s)
{
    for (size_t i = 0; i < s->count; i++)
        s->samples[i] = sample_of(s, i);
}

static void record_row(struct serve *s)
{
    int32_t time = server_time(s->core);

    if (time > 0)
        s->reference = trajectory_step(s->scenario->trajectory, &s->reference);
    take_samples(s);
    metrics_tick(s->metrics, time / 1000.0, s->samples, server_leader(s->core),
                 formation_in_force(s), &s->reference, s->event);
    s->event = false;
    if (record_wants_scenes(s->record)) {
        take_scene(s);
        record_scene(s->record, &s->scene);
    }
}

/* Where robots stand while they are gathered, and when they have stopped. */
static void show(struct serve *s)
{
    take_samples(s);
    metrics_place(s->metrics, s->samples, server_leader(s->core), formation_in_force(s),
                  &s->reference);
    take_scene(s);
    if (s->scene.time_ms < AUDIENCE_BEGIN_MS)
        s->scene.time_ms = AUDIENCE_BEGIN_MS;
    record_show(s->record, &s->scene);
}

/* ---- what the core reports and orders -------------------------------------------------- */

static void hear_report(struct serve *s, const struct server_report *report)
{
    s->event |= report->kind == REPORT_EVENT;
    if (s->record != NULL)
        record_event(s->record, server_time(s->core), report);
    if (report->kind == REPORT_STRANGER && report->value == 0)
        console_say(&s->console, "robot %u: has no id; `muster id' gives it one", report->robot);
    else if (report->kind == REPORT_STRANGER)
        console_say(&s->console, "robot %u: who answers there is robot %u; it takes no part",
                    report->robot, report->value);
    else if (report->kind == REPORT_ELECTION)
        console_say(&s->console, "robot %u leads", report->robot);
    else if (report->kind == REPORT_RESTART)
        console_say(&s->console, "robot %u: was reset and is given its mission again",
                    report->robot);
}

static void carry_out(struct serve *s, const struct server_order *order)
{
    if (order->action == EVENT_DRAIN) {
        console_say(&s->console,
                    "robot %u: the scenario drains its battery, which only a simulation can",
                    s->scenario->robots[order->robot].id);
        return;
    }
    s->member[order->robot].withheld = order->action == EVENT_STALL;
    if (order->action == EVENT_KILL)
        server_halt(s->core, order->robot);
    else if (order->action == EVENT_REVIVE && s->phase < PHASE_STOP)
        server_resume(s->core, order->robot);
}

void tick_drain(struct serve *s)
{
    struct server_report report;
    struct server_order order;

    while (server_next_report(s->core, &report))
        hear_report(s, &report);
    while (server_next_order(s->core, &order))
        carry_out(s, &order);
}

/* ---- may they move --------------------------------------------------------------------- */

bool tick_alarm(struct serve *s, char words[ALARM_WORDS_MAX])
{
    for (size_t i = 0; i < s->count; i++) {
        const struct tracker_view *view = tracker_look(s->tracker, i);

        s->places[i] = (struct guard_robot){
            .placed = view->seen && s->tick_us - view->measured_us < PLACE_KEPT_US,
            .x = view->x,
            .y = view->y,
        };
    }
    struct guard_alarm alarm = guard_judge(&s->limits, s->places, s->count);
    unsigned robot = s->scenario->robots[alarm.robot].id;
    if (alarm.finding == GUARD_FENCE)
        snprintf(words, ALARM_WORDS_MAX, "robot %u is %.2f m beyond the fence", robot,
                 alarm.distance);
    else if (alarm.finding == GUARD_SEPARATION)
        snprintf(words, ALARM_WORDS_MAX, "robots %u and %u are %.3f m apart, less than %g m", robot,
                 s->scenario->robots[alarm.other].id, alarm.distance, s->limits.separation);
    return alarm.finding != GUARD_GOOD;
}

/* ---- phases ---------------------------------------------------------------------------- */

static bool all_ready(const struct serve *s)
{
    for (size_t i = 0; i < s->count; i++)
        if (!serve_is_ready(s, i))
            return false;
    return true;
}

static void gather(struct serve *s)
{
    double waited = (double)(s->ticks - s->phase_tick) / TICKS_PER_S;
    char words[ALARM_WORDS_MAX];

    if (s->options->what == SERVE_CHECK) {
        if (waited >= s->options->seconds) {
            console_table(&s->console, "", 0);
            serve_stop(s, verdict_print(s, stdout) ? SERVE_DONE : SERVE_BAD, "the check is over");
        }
        return;
    }
    if (tick_alarm(s, words)) {
        if (!s->alarmed)
            console_say(&s->console, "the start waits: %s", words);
        s->alarmed = true;
        return;
    }
    s->alarmed = false;
    if (all_ready(s) || waited >= s->site->patience)
        serve_begin(s);
}

static void run(struct serve *s)
{
    char words[ALARM_WORDS_MAX];

    if (tick_alarm(s, words))
        serve_stop(s, SERVE_BAD, "%s", words);
    else if (server_time(s->core) >= s->until)
        serve_stop(s, SERVE_DONE, "the mission is over");
}

static void stop(struct serve *s)
{
    bool patient = s->ticks - s->phase_tick < STOP_TICKS;
    size_t moving = 0;

    for (size_t i = 0; i < s->count; i++) {
        bool runs = links_look(s->links, i)->state == LINK_UP &&
                    server_look(s->core, i)->state == STATE_RUN;

        if (runs && !patient)
            console_say(&s->console,
                        "robot %u: has not confirmed that it stands; it stops by itself",
                        s->scenario->robots[i].id);
        moving += runs;
    }
    if (moving == 0 || !patient)
        s->phase = PHASE_OVER;
}

/* ---- what is slower -------------------------------------------------------------------- */

static void take_rate(struct serve *s, size_t i)
{
    struct member_link *m = &s->member[i];
    const struct link_view *link = links_look(s->links, i);
    const struct server_view *view = server_look(s->core, i);
    uint64_t bytes = link->sent + link->received;

    m->rate = (double)(bytes - m->bytes) * TICKS_PER_S / RATE_TICKS;
    m->loss = link_loss_look(&m->seen, view);
    m->bytes = bytes;
    bool low = view->faults & (WARN_BATTERY | FAULT_BATTERY) ||
               (view->battery > 0 && view->battery < s->site->battery * 1000);
    if (low && !m->warned)
        console_say(&s->console, "robot %u: battery at %.2f V", s->scenario->robots[i].id,
                    view->battery / 1000.0);
    m->warned = low;
}

/* Says when a body is lost or not believed, and when it is back. */
static void watch_body(struct serve *s, size_t i)
{
    const struct tracker_view *seen = tracker_look(s->tracker, i);
    const char *body = s->bodies[i].name != NULL ? s->bodies[i].name : "its body";
    bool astray = s->tick_us - seen->measured_us > SERVER_POSE_OLD_MS * 1000;
    unsigned id = s->scenario->robots[i].id;
    char words[160];

    if (!seen->seen || astray == s->member[i].astray)
        return;
    s->member[i].astray = astray;
    if (!astray)
        snprintf(words, sizeof words, "%s is seen again", body);
    else if (seen->jumped)
        snprintf(words, sizeof words, "%s jumped by %.2f m and is not believed: back, or key b",
                 body, seen->jump);
    else
        snprintf(words, sizeof words, "motion capture has lost %s", body);
    console_say(&s->console, "robot %u: %s", id, words);
    record_note(s->record, server_time(s->core), (uint16_t)id, "body", words);
}

static void watch_bodies(struct serve *s)
{
    if (s->record == NULL || s->tick_us - s->frame_us > FRAMES_DUE_US)
        return;
    for (size_t i = 0; i < s->count; i++)
        watch_body(s, i);
}

static void tend(struct serve *s)
{
    if (s->ticks % TEND_TICKS == 0) {
        links_tick(s->links, loop_now());
        source_tick(s->source, loop_now());
        watch_bodies(s);
    }
    if (s->ticks % RATE_TICKS == 0) {
        for (size_t i = 0; i < s->count; i++)
            take_rate(s, i);
        if (s->record != NULL)
            record_flush(s->record);
        sd_notifyf(0, "WATCHDOG=1\nSTATUS=t = %.0f s, %s", server_time(s->core) / 1000.0,
                   source_words(s->source));
    }
    if (s->console.live ? s->ticks % DRAW_TICKS == 0 : s->ticks % LINE_TICKS == 0)
        s->console.live ? table_draw(s) : table_line(s);
}

/* Rows are of the tick, so they are made before the next one. */
void tick_chores(struct serve *s)
{
    if (!s->chores)
        return;
    s->chores = false;
    if (s->record != NULL && s->phase == PHASE_RUN && server_time(s->core) >= 0)
        record_row(s);
    else if (s->options->view != NULL && s->ticks % SHOW_TICKS == 0)
        show(s);
    tend(s);
}

void tick(struct serve *s, int64_t due_us)
{
    tick_chores(s);
    s->tick_us = due_us;
    s->ticks++;
    server_tick(s->core);
    tick_drain(s);
    s->chores = true;
    switch (s->phase) {
    case PHASE_GATHER: gather(s); break;
    case PHASE_RUN: run(s); break;
    case PHASE_STOP: stop(s); break;
    case PHASE_OVER: break;
    }
}

void tick_flush(struct serve *s)
{
    int64_t now_us = loop_now();
    bool posed = false;

    for (size_t i = 0; i < s->count; i++) {
        if (now_us - s->member[i].posed_us > POSE_DRIVEN_US)
            pass_flush(s, i, now_us);
        else
            posed = true;
    }
    if (!posed)
        tick_chores(s);
}
