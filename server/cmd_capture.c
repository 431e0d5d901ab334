#include "arguments.h"
#include "census.h"
#include "commands.h"
#include "loop.h"
#include "poses.h"
#include "site.h"
#include "source.h"

#include <argp.h>
#include <errno.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <unistd.h>

#define TICK_US 100000 /* as often as a source wants to be looked after */
#define TICKS_PER_STATUS 10
#define SECONDS_MAX 31536000

/* What the command line says. */
struct request {
    const char *site;
    const char *out;
    const char **settings;
    size_t setting_count;
    uint64_t seconds; /* 0: until a signal */
    bool quiet;
};

/* A recording under way. */
struct recording {
    struct watch timer, signals;
    struct loop loop;
    const struct request *request;
    FILE *out;
    struct source *source;
    struct poses_clock clock;
    struct census census;
    int64_t begun_us;
    uint64_t ticks;
    bool status; /* the last line on stderr is the status, to be written over */
    bool over;
};

#define OWNER(watch, member)                                                                       \
    ((struct recording *)((char *)(watch)-offsetof(struct recording, member)))

enum {
    KEY_OUT = 256,
    KEY_SECONDS,
    KEY_SET,
    KEY_QUIET,
};

static const struct argp_option option_table[] = {
    {"out", KEY_OUT, "FILE", 0, "Where the frames go, instead of stdout", 0},
    {"seconds", KEY_SECONDS, "N", 0, "How long to record; 0 (default): until SIGINT or SIGTERM", 0},
    {"set", KEY_SET, "KEY.PATH=VALUE", 0,
     "Put a value into the site, such as mocap.server=10.0.0.5; repeatable", 0},
    {"quiet", KEY_QUIET, NULL, 0, "Tell nothing; errors stay", 0},
    {0},
};

static const char description[] =
    "Record what a site's motion capture says, and show which bodies it has."
    "\v"
    "Every frame is written, with all of its bodies, also those that are no robots, as CSV: "
    "t,body,id,x,y,z,qx,qy,qz,qw,tracked, in s since the first frame, m and unit quaternions in "
    "the "
    "system's own axes. How the connection stands, the rate and the longest gaps are told on "
    "stderr.\n\n"
    "  muster capture --seconds 2 --out /dev/null lab.yaml    what is there?\n"
    "  muster capture --out walk.csv lab.yaml                 until Ctrl-C\n\n"
    "A site whose mocap has `protocol: poses' and `file: walk.csv' plays it again.\n\n"
    "Exit status: 0 frames were recorded, 1 none came or they could not be written, 2 wrong usage "
    "or "
    "a site that is refused.";

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;

    switch (key) {
    case KEY_OUT: request->out = value; break;
    case KEY_SECONDS:
        request->seconds = argument_number(state, "--seconds", value, 0, SECONDS_MAX);
        break;
    case KEY_SET: request->settings[request->setting_count++] = value; break;
    case KEY_QUIET: request->quiet = true; break;
    case ARGP_KEY_ARG:
        if (request->site != NULL)
            argp_error(state, "%s: one site at a time", value);
        request->site = value;
        break;
    case ARGP_KEY_NO_ARGS: argp_error(state, "which site?"); break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static void clear_status(struct recording *recording)
{
    if (recording->status)
        fputs("\r\033[K", stderr);
    recording->status = false;
}

static void show_status(struct recording *recording)
{
    const struct census *census = &recording->census;

    if (recording->request->quiet || !isatty(STDERR_FILENO))
        return;
    clear_status(recording);
    fprintf(stderr, "%llu frames, %.1f Hz, longest gap %.1f ms, %zu of %zu bodies tracked",
            (unsigned long long)census->frames, census_rate(census), (double)census->gap_us / 1e3,
            census_tracked(census), census->count);
    recording->status = true;
}

static void on_frame(void *context, const struct capture_frame *frame, int64_t arrival_us)
{
    struct recording *recording = context;

    census_take(&recording->census, frame, arrival_us);
    poses_write_frame(recording->out, poses_clock_next(&recording->clock, frame, arrival_us),
                      frame);
}

static void on_words(void *context, bool problem, const char *words)
{
    struct recording *recording = context;

    if (recording->request->quiet && !problem)
        return;
    clear_status(recording);
    fprintf(stderr, "%s\n", words);
}

static void on_signal(struct watch *watch, uint32_t events)
{
    (void)events;
    OWNER(watch, signals)->over = true;
}

static void on_timer(struct watch *watch, uint32_t events)
{
    struct recording *recording = OWNER(watch, timer);
    int64_t now_us = loop_now();
    int64_t whole_us = (int64_t)recording->request->seconds * 1000000;

    (void)events;
    loop_periods(watch->fd);
    source_tick(recording->source, now_us);
    if (++recording->ticks % TICKS_PER_STATUS == 0) {
        fflush(recording->out);
        show_status(recording);
    }
    if ((whole_us > 0 && now_us - recording->begun_us >= whole_us) || ferror(recording->out))
        recording->over = true;
}

static bool watch_time_and_signals(struct recording *recording)
{
    static const int numbers[] = {SIGINT, SIGTERM, 0};

    recording->signals.fd = loop_signals(numbers);
    recording->signals.ready = on_signal;
    recording->timer.fd = loop_timer(TICK_US);
    recording->timer.ready = on_timer;
    return recording->signals.fd >= 0 &&
           loop_watch(&recording->loop, &recording->signals, EPOLLIN) && recording->timer.fd >= 0 &&
           loop_watch(&recording->loop, &recording->timer, EPOLLIN);
}

static void summarize(struct recording *recording)
{
    const struct census *census = &recording->census;
    struct source_count count = source_counts(recording->source);

    clear_status(recording);
    if (recording->request->quiet)
        return;
    fprintf(stderr, "%llu frames, %.1f Hz, longest gap %.1f ms; %llu skipped, %llu broken\n",
            (unsigned long long)census->frames, census_rate(census), (double)census->gap_us / 1e3,
            (unsigned long long)count.skipped, (unsigned long long)count.broken);
    census_print(census, stderr);
}

/* The words of the error that ended it, or NULL. */
static const char *record(struct recording *recording)
{
    recording->begun_us = loop_now();
    poses_write_header(recording->out);
    while (!recording->over)
        if (!loop_wait(&recording->loop))
            return strerror(errno);
    summarize(recording);
    errno = 0;
    if (fflush(recording->out) != 0 || ferror(recording->out))
        return errno != 0 ? strerror(errno) : "not everything could be written";
    return recording->census.frames > 0 ? NULL : "no frame has come";
}

static int fail(const struct recording *recording, const char *words)
{
    fprintf(stderr, "muster capture: %s: %s\n", recording->request->site, words);
    return STATUS_FAILED;
}

static int run(const struct site *site, struct recording *recording)
{
    const struct source_owner owner = {recording, on_frame, on_words};
    struct source_settings settings = site->mocap;
    char error[512] = "";

    settings.every = true;
    if (!loop_open(&recording->loop))
        return fail(recording, strerror(errno));
    recording->source = source_open(&recording->loop, &settings, &owner, error, sizeof error);
    const char *wrong = recording->source == NULL            ? error
                        : !watch_time_and_signals(recording) ? strerror(errno)
                                                             : record(recording);
    source_close(recording->source);
    if (recording->timer.fd >= 0)
        close(recording->timer.fd);
    if (recording->signals.fd >= 0)
        close(recording->signals.fd);
    loop_close(&recording->loop);
    return wrong != NULL ? fail(recording, wrong) : STATUS_DONE;
}

static int run_into_file(const struct site *site, const struct request *request)
{
    struct recording *recording = calloc(1, sizeof *recording);

    if (recording == NULL) {
        fprintf(stderr, "muster capture: not enough memory\n");
        return STATUS_FAILED;
    }
    recording->request = request;
    recording->timer.fd = recording->signals.fd = -1;
    recording->out = request->out != NULL ? fopen(request->out, "we") : stdout;
    int status;
    if (recording->out == NULL) {
        fprintf(stderr, "muster capture: cannot write %s: %s\n", request->out, strerror(errno));
        status = STATUS_FAILED;
    } else {
        status = run(site, recording);
        if (recording->out != stdout)
            fclose(recording->out);
    }
    free(recording);
    return status;
}

static int work(const struct request *request)
{
    char error[1024];
    struct site *site =
        site_read(request->site, request->settings, request->setting_count, error, sizeof error);

    if (site == NULL) {
        fprintf(stderr, "%s\n", error);
        return STATUS_USAGE;
    }
    int status = run_into_file(site, request);
    site_free(site);
    return status;
}

int cmd_capture(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "SITE.yaml", description,
                                     NULL,         NULL,         NULL};
    struct request request = {.settings = calloc((size_t)argc, sizeof *request.settings)};

    if (request.settings == NULL) {
        fprintf(stderr, "muster capture: not enough memory\n");
        return STATUS_FAILED;
    }
    argp_parse(&argp, argc, argv, 0, NULL, &request);
    int status = work(&request);
    free(request.settings);
    return status;
}
