#include "arguments.h"
#include "commands.h"
#include "limits.h"
#include "scenario.h"
#include "serve.h"

#include <argp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* What the command line says. */
struct request {
    struct serve_options options;
    const char *site;
    const char *scenario;
    const char **settings;
    size_t setting_count;
    bool judge_only;
    bool looked_at;
    struct view_options view;
};

enum {
    KEY_SCENARIO = 256,
    KEY_OUT,
    KEY_SEED,
    KEY_SECONDS,
    KEY_SET,
    KEY_NO_TRACE,
    KEY_VIEW,
    KEY_CHECK,
    KEY_QUIET,
};

#define SCENARIO_OPTION                                                                            \
    {                                                                                              \
        "scenario", KEY_SCENARIO, "FILE", 0, "The mission, in place of the one the site names", 0  \
    }
#define SET_OPTION                                                                                 \
    {                                                                                              \
        "set", KEY_SET, "KEY.PATH=VALUE", 0,                                                       \
            "Put a value into the site, such as separation=0.2 or robots.0.id=7; repeatable", 0    \
    }
#define QUIET_OPTION                                                                               \
    {                                                                                              \
        "quiet", KEY_QUIET, NULL, 0, "No table and no summary; warnings stay", 0                   \
    }

static const struct argp_option serve_options[] = {
    SCENARIO_OPTION,
    {"out", KEY_OUT, "DIR", 0, "Where the run's files go, runs/SITE-DATE-TIME unless given", 0},
    {"seed", KEY_SEED, "N", 0, "Which beacons an emulated loss takes (default 1)", 0},
    SET_OPTION,
    {"no-trace", KEY_NO_TRACE, NULL, 0, "Write neither trace.csv nor run.mcap, and no figures", 0},
    {"view", KEY_VIEW, "WHERE", OPTION_ARG_OPTIONAL,
     "Have a page to look at the run and to act on it: at [ADDRESS:]PORT, 127.0.0.1:8765 unless "
     "given",
     0},
    {"check", KEY_CHECK, NULL, 0, "Read and judge both files, and start nothing", 0},
    QUIET_OPTION,
    {0},
};

static const struct argp_option check_options[] = {
    SCENARIO_OPTION,
    {"seconds", KEY_SECONDS, "N", 0, "How long to look (default 5)", 0},
    SET_OPTION,
    QUIET_OPTION,
    {0},
};

static const char serve_text[] =
    "Lead real robots through a scenario, with the poses of a motion-capture system."
    "\v"
    "Robots are dialled and told their mission; when all are ready, or after the site's patience, "
    "it "
    "begins. A robot that comes late or comes back joins in.\n\n"
    "Keys: Enter begins without those that are missing, e is the emergency stop (robots stay "
    "stopped "
    "until switched off), b believes bodies that have jumped, q stops the robots and leaves.\n"
    "Signals: SIGTERM and SIGINT as q, SIGUSR1 as e.\n\n"
    "The run's files are those of `muster sim'. Exit status: 0 the mission was completed or ended "
    "by "
    "its operator, 1 it failed or was stopped by the fence or the separation, 2 wrong usage or a "
    "file "
    "that is refused.";

static const char check_text[] =
    "Look whether an arena is ready: links, robots, batteries, bodies, clocks. Nothing moves."
    "\v"
    "Robots are dialled and told their mission, and never told to begin it.\n\n"
    "Exit status: 0 all is good, 1 something is not, 2 wrong usage or a file that is refused.";

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;
    struct serve_options *options = &request->options;

    switch (key) {
    case KEY_SCENARIO: request->scenario = value; break;
    case KEY_OUT: options->out = value; break;
    case KEY_SEED: options->seed = argument_number(state, "--seed", value, 0, UINT64_MAX); break;
    case KEY_SECONDS:
        options->seconds = (double)argument_number(state, "--seconds", value, 1, 3600);
        break;
    case KEY_SET: request->settings[request->setting_count++] = value; break;
    case KEY_NO_TRACE: options->trace = false; break;
    case KEY_VIEW:
        request->looked_at = true;
        argument_view(state, value, &request->view);
        break;
    case KEY_CHECK: request->judge_only = true; break;
    case KEY_QUIET: options->quiet = true; break;
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

/* Real runs differ: none takes another one's place. */
static void default_out(const struct site *site, char *out, size_t room)
{
    char when[32];
    time_t now = time(NULL);

    strftime(when, sizeof when, "%Y%m%d-%H%M%S", localtime(&now));
    snprintf(out, room, "runs/%s-%s", site->name, when);
}

static bool open_view(const struct scenario *scenario, struct request *request)
{
    struct view_about about = {"serve", scenario->name, scenario->duration, SERVE_ACTS};
    char error[256];

    if (!request->looked_at)
        return true;
    request->options.view = view_open(&request->view, &about, error, sizeof error);
    if (request->options.view == NULL) {
        fprintf(stderr, "muster serve: %s\n", error);
        return false;
    }
    fprintf(stderr, "view: %s\n", view_url(request->options.view));
    return true;
}

static int run(const struct site *site, const struct scenario *scenario, struct request *request,
               const char *command)
{
    char out[SCENARIO_NAME_MAX + 64];
    char error[512] = "";

    if (request->judge_only) {
        if (!request->options.quiet)
            printf("%s: %s, %zu robots; %s, %zu robots, %g s: good\n", request->site, site->name,
                   site->robot_count, scenario->name, scenario->robot_count, scenario->duration);
        return STATUS_DONE;
    }
    default_out(site, out, sizeof out);
    if (request->options.out == NULL)
        request->options.out = out;
    if (!open_view(scenario, request))
        return STATUS_FAILED;
    enum serve_end end = serve_run(site, scenario, &request->options, error, sizeof error);
    view_close(request->options.view);
    if (error[0] != '\0')
        fprintf(stderr, "muster %s: %s\n", command, error);
    return end == SERVE_DONE ? STATUS_DONE : end == SERVE_REFUSED ? STATUS_USAGE : STATUS_FAILED;
}

static int work(struct request *request, const char *command)
{
    char error[1024];
    struct site *site =
        site_read(request->site, request->settings, request->setting_count, error, sizeof error);

    if (site == NULL) {
        fprintf(stderr, "%s\n", error);
        return STATUS_USAGE;
    }
    int status = STATUS_USAGE;
    const char *path = request->scenario != NULL ? request->scenario : site->scenario;
    struct scenario *scenario = NULL;
    if (path == NULL)
        fprintf(stderr, "muster %s: %s names no scenario: give it one, or --scenario FILE\n",
                command, request->site);
    else if ((scenario = scenario_read(path, NULL, 0, VERTICES_MAX, error, sizeof error)) == NULL)
        fprintf(stderr, "%s\n", error);
    else
        status = run(site, scenario, request, command);
    scenario_free(scenario);
    site_free(site);
    return status;
}

static int command(int argc, char **argv, const struct argp *argp, enum serve_what what,
                   const char *name)
{
    struct request request = {
        .options = {.what = what, .seed = 1, .seconds = 5, .trace = true},
        .settings = calloc((size_t)argc, sizeof *request.settings),
    };

    if (request.settings == NULL) {
        fprintf(stderr, "muster %s: not enough memory\n", name);
        return STATUS_FAILED;
    }
    argp_parse(argp, argc, argv, 0, NULL, &request);
    int status = work(&request, name);
    free(request.settings);
    return status;
}

int cmd_serve(int argc, char **argv)
{
    static const struct argp argp = {serve_options, parse_option, "SITE.yaml", serve_text,
                                     NULL,          NULL,         NULL};

    return command(argc, argv, &argp, SERVE_RUN, "serve");
}

int cmd_check(int argc, char **argv)
{
    static const struct argp argp = {check_options, parse_option, "SITE.yaml", check_text,
                                     NULL,          NULL,         NULL};

    return command(argc, argv, &argp, SERVE_CHECK, "check");
}
