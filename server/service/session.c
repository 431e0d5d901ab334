#include "session.h"

#include "limits.h"
#include "loop.h"
#include "roster.h"
#include "sights.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <unistd.h>

#define DRAW_TICKS 5

/* Between two ticks. When this process was held up for longer, what robots have said meanwhile is
 * still unread: they were not silent. */
#define LISTENED_MAX_US 200000

/* For so long a robot that is absent holds up its Bluetooth adapter (adapters.h). */
#define PAGE_S 5.0

/* For so long jobs may go on after an interruption. */
#define STOP_US 2000000

struct member {
    int64_t silent_us;          /* since something was heard, as far as we listened */
    char words[LINK_WORDS_MAX]; /* why its link went down last; "" */
    bool told;                  /* that its job has ended */
};

struct session {
    struct watch timer, signals, keys;
    struct loop loop;
    const struct session_options *options;
    const size_t *robots; /* by the site's order */
    struct job *const *jobs;
    size_t count;
    struct member *member;
    struct sights_owner from_sights;
    struct sights *sights; /* NULL: no poses are wanted */
    struct link_settings *settings;
    struct link_owner owner;
    struct links *links;
    struct roster_line *lines;
    struct roster roster;
    sigset_t mask; /* the signals that were held back before */
    int64_t tick_us;
    uint64_t ticks;
    bool interrupted;
    int64_t stopped_us; /* when; then jobs put right what must not stay */
};

#define OWNER(watch, part) ((struct session *)((char *)(watch)-offsetof(struct session, part)))

/* ---- jobs and their links -------------------------------------------------------------- */

static void tell_end(struct session *s, size_t i)
{
    const struct job *job = s->jobs[i];
    const char *address = links_look(s->links, i)->address;
    bool failed = job->state == JOB_FAILED;

    s->member[i].told = true;
    if (!failed && (s->options->quiet || job->words[0] == '\0'))
        return;
    if (job->robot == 0)
        roster_say(&s->roster, "%s: %s", address, job->words);
    else if (failed)
        roster_say(&s->roster, "robot %u (%s): %s", job->robot, address, job->words);
    else
        roster_say(&s->roster, "robot %u: %s", job->robot, job->words);
}

/* What has happened may have made something due, or have been the end. */
static void act(struct session *s, size_t i)
{
    struct job *job = s->jobs[i];
    int64_t now_us = loop_now();
    uint8_t bytes[LINK_SEND_MAX];

    if (job->state == JOB_WORKING) {
        size_t room = links_room(s->links, i, now_us);
        links_send(s->links, i, bytes, job->kind->send(job, now_us, bytes, room));
    }
    if (job->state != JOB_WORKING && !s->member[i].told)
        tell_end(s, i);
}

static void on_up(void *context, size_t i)
{
    struct session *s = context;
    struct job *job = s->jobs[i];

    if (job->state != JOB_WORKING)
        return;
    job->kind->linked(job, loop_now());
    act(s, i);
}

static void on_down(void *context, size_t i, const char *words)
{
    struct session *s = context;
    struct job *job = s->jobs[i];

    snprintf(s->member[i].words, sizeof s->member[i].words, "%s", words);
    if (job->state != JOB_WORKING)
        return;
    job->kind->lost(job, words, loop_now());
    act(s, i);
}

static void on_received(void *context, size_t i, const uint8_t *bytes, size_t count)
{
    struct session *s = context;
    struct job *job = s->jobs[i];

    s->member[i].silent_us = 0;
    if (job->state != JOB_WORKING)
        return;
    job->kind->received(job, bytes, count, loop_now());
    act(s, i);
}

static void on_seen(void *context, size_t robot, const struct job_pose *pose)
{
    struct session *s = context;
    const struct session_watcher *watcher = &s->options->watcher;

    if (watcher->seen != NULL)
        watcher->seen(watcher->context, robot, pose);
    for (size_t i = 0; i < s->count; i++) {
        struct job *job = s->jobs[i];

        if (s->robots[i] != robot || job->state != JOB_WORKING || job->kind->seen == NULL)
            continue;
        job->kind->seen(job, pose);
        act(s, i);
    }
}

static void on_words(void *context, const char *words)
{
    struct session *s = context;

    if (!s->options->quiet)
        roster_say(&s->roster, "mocap: %s", words);
}

/* ---- time ------------------------------------------------------------------------------ */

/* An adapter dials one robot at a time: the others have to wait. */
static double patience_of(const struct session *s, size_t i)
{
    size_t others = s->count - 1;

    if (s->settings[i].address.kind != LINK_RFCOMM)
        return s->options->patience;
    if (others > LINK_ADAPTER_ROBOTS - 1)
        others = LINK_ADAPTER_ROBOTS - 1;
    return s->options->patience + PAGE_S * (double)others;
}

static void lose_patience(struct session *s, size_t i)
{
    const struct link_view *view = links_look(s->links, i);
    const char *words = view->words[0] != '\0' ? view->words : s->member[i].words;

    if (words[0] != '\0')
        job_failed(s->jobs[i], "%s", words);
    else
        job_failed(s->jobs[i], "nothing heard for %g s: is the robot on, and at this baud rate?",
                   patience_of(s, i));
}

static void draw(struct session *s)
{
    size_t count = 0;

    for (size_t i = 0; i < s->count; i++) {
        const struct job *job = s->jobs[i];
        const struct link_view *view = links_look(s->links, i);
        struct roster_line *line = &s->lines[count];

        if (job->state != JOB_WORKING)
            continue;
        count++;
        if (job->robot != 0)
            snprintf(line->name, sizeof line->name, "robot %u", job->robot);
        else
            snprintf(line->name, sizeof line->name, "%.23s", view->address);
        line->progress = job->progress;
        line->words = view->state == LINK_UP ? job->words : view->words;
    }
    roster_draw(&s->roster, s->lines, count);
}

static void tick(struct session *s, int64_t now_us)
{
    int64_t listened_us = now_us - s->tick_us;

    if (listened_us > LISTENED_MAX_US)
        listened_us = LISTENED_MAX_US;
    s->tick_us = now_us;
    links_tick(s->links, now_us);
    if (s->sights != NULL)
        sights_tick(s->sights, now_us);
    for (size_t i = 0; i < s->count; i++) {
        s->member[i].silent_us += listened_us;
        if (s->jobs[i]->state == JOB_WORKING &&
            (double)s->member[i].silent_us > patience_of(s, i) * 1e6)
            lose_patience(s, i);
        act(s, i);
    }
    if (s->ticks++ % DRAW_TICKS == 0)
        draw(s);
}

static void on_timer(struct watch *watch, uint32_t events)
{
    (void)events;
    loop_periods(watch->fd);
    tick(OWNER(watch, timer), loop_now());
}

static void on_signal(struct watch *watch, uint32_t events)
{
    struct session *s = OWNER(watch, signals);
    const struct session_watcher *watcher = &s->options->watcher;
    int64_t now_us = loop_now();

    (void)events;
    if (loop_signal(watch->fd) == 0 || s->interrupted)
        return;
    s->interrupted = true;
    s->stopped_us = now_us;
    if (watcher->stop != NULL)
        watcher->stop(watcher->context, "interrupted", now_us);
}

static void on_typed(struct watch *watch, uint32_t events)
{
    struct session *s = OWNER(watch, keys);
    const struct session_watcher *watcher = &s->options->watcher;

    (void)events;
    if (!watcher->typed(watcher->context, loop_now()))
        loop_forget(&s->loop, watch);
    for (size_t i = 0; i < s->count; i++)
        act(s, i);
}

static bool at_work(const struct session *s)
{
    for (size_t i = 0; i < s->count; i++)
        if (s->jobs[i]->state == JOB_WORKING)
            return true;
    return false;
}

static bool may_go_on(const struct session *s)
{
    return !s->interrupted ||
           (s->options->watcher.stop != NULL && loop_now() - s->stopped_us < STOP_US);
}

static bool run(struct session *s)
{
    s->tick_us = loop_now();
    while (at_work(s) && may_go_on(s))
        if (!loop_wait(&s->loop))
            return false;
    for (size_t i = 0; i < s->count; i++)
        if (s->jobs[i]->state == JOB_WORKING)
            job_failed(s->jobs[i], "interrupted");
    return true;
}

/* ---- beginning and end ----------------------------------------------------------------- */

static bool watch_time_and_signals(struct session *s)
{
    static const int numbers[] = {SIGINT, SIGTERM, 0};

    s->signals.ready = on_signal;
    s->signals.fd = loop_signals(numbers);
    s->timer.ready = on_timer;
    s->timer.fd = loop_timer(TICK_MS * 1000);
    return s->signals.fd >= 0 && loop_watch(&s->loop, &s->signals, EPOLLIN) && s->timer.fd >= 0 &&
           loop_watch(&s->loop, &s->timer, EPOLLIN);
}

static bool watch_keys(struct session *s)
{
    s->keys = (struct watch){.fd = STDIN_FILENO, .ready = on_typed};
    return s->options->watcher.typed == NULL || loop_watch(&s->loop, &s->keys, EPOLLIN);
}

static bool look(struct session *s, const struct site *site, char *error, size_t room)
{
    if (!s->options->poses)
        return true;
    s->from_sights = (struct sights_owner){s, on_seen, on_words};
    s->sights = sights_open(&s->loop, site, &s->from_sights, error, room);
    return s->sights != NULL;
}

static bool dial(struct session *s, const struct site *site, char *error, size_t room)
{
    for (size_t i = 0; i < s->count; i++)
        s->settings[i] = site->robots[s->robots[i]].link;
    s->owner = (struct link_owner){s, on_up, on_down, on_received};
    s->links = links_open(&s->loop, s->settings, s->count, &s->owner, error, room);
    return s->links != NULL;
}

static bool fail_by(char *error, size_t room, const char *what)
{
    snprintf(error, room, "%s: %s", what, strerror(errno));
    return false;
}

static bool work(struct session *s, const struct site *site, char *error, size_t room)
{
    s->member = calloc(s->count, sizeof *s->member);
    s->settings = calloc(s->count, sizeof *s->settings);
    s->lines = calloc(s->count, sizeof *s->lines);
    if (s->member == NULL || s->settings == NULL || s->lines == NULL)
        return fail_by(error, room, "no memory for the robots");
    if (!loop_open(&s->loop) || !watch_time_and_signals(s) || !watch_keys(s))
        return fail_by(error, room, "cannot wait for anything");
    if (!look(s, site, error, room) || !dial(s, site, error, room))
        return false;
    bool good = run(s) || fail_by(error, room, "waiting failed");
    links_close(s->links);
    roster_end(&s->roster);
    return good;
}

static void close_fd(int fd)
{
    if (fd >= 0)
        close(fd);
}

static enum session_end end_of(const struct session *s)
{
    if (s->interrupted)
        return SESSION_INTERRUPTED;
    for (size_t i = 0; i < s->count; i++)
        if (s->jobs[i]->state == JOB_FAILED)
            return SESSION_INCOMPLETE;
    return SESSION_DONE;
}

enum session_end session_run(const struct site *site, const size_t *robots, struct job *const *jobs,
                             size_t count, const struct session_options *options, char *error,
                             size_t room)
{
    struct session s = {
        .timer.fd = -1,
        .signals.fd = -1,
        .loop = LOOP_CLOSED,
        .options = options,
        .robots = robots,
        .jobs = jobs,
        .count = count,
    };

    sigprocmask(SIG_SETMASK, NULL, &s.mask);
    roster_begin(&s.roster, options->quiet);
    bool good = work(&s, site, error, room);
    sights_close(s.sights);
    close_fd(s.timer.fd);
    close_fd(s.signals.fd);
    loop_close(&s.loop);
    sigprocmask(SIG_SETMASK, &s.mask, NULL);
    free(s.member);
    free(s.settings);
    free(s.lines);
    return good ? end_of(&s) : SESSION_FAILED;
}
