#include "arguments.h"
#include "commands.h"
#include "interrupt.h"
#include "limits.h"
#include "places.h"
#include "scenario.h"
#include "sim.h"

#include <argp.h>
#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>

/* What the command line says. */
struct request {
    struct sim_options options;
    const char *scenario;
    const char *parameters;
    const char **settings;
    size_t setting_count;
    double speed; /* NAN: not said */
    bool looked_at;
    struct view_options view;
    bool check;
};

enum {
    KEY_ROBOTS = 256,
    KEY_FIRMWARE,
    KEY_PARAMETERS,
    KEY_OUT,
    KEY_SEED,
    KEY_THREADS,
    KEY_SET,
    KEY_NO_TRACE,
    KEY_REAL_TIME,
    KEY_SPEED,
    KEY_VIEW,
    KEY_CHECK,
    KEY_QUIET,
};

static const struct argp_option option_table[] = {
    {"robots", KEY_ROBOTS, "KIND", 0,
     "avr: the firmware on simulated ATmega128 (default); native: the same brain in this program",
     0},
    {"firmware", KEY_FIRMWARE, "ELF", 0, "The image of avr robots, unless the one with muster", 0},
    {"parameters", KEY_PARAMETERS, "FILE", 0,
     "What the robots have stored, as `muster param' and `muster calibrate' write it; robots that "
     "it does not name have the defaults",
     0},
    {"out", KEY_OUT, "DIR", 0,
     "Where the run's files go, runs/NAME-SEED unless given; files of an earlier run are replaced",
     0},
    {"seed", KEY_SEED, "N", 0, "Which run of the scenario's chances this is (default 1)", 0},
    {"threads", KEY_THREADS, "N", 0,
     "Work with N threads instead of one per processor; the results are the same", 0},
    {"set", KEY_SET, "KEY.PATH=VALUE", 0,
     "Put a value into the scenario, such as network.loss=0.2 or robots.0.id=7; repeatable", 0},
    {"no-trace", KEY_NO_TRACE, NULL, 0, "Write neither trace.csv nor run.mcap, and no figures", 0},
    {"real-time", KEY_REAL_TIME, NULL, 0, "No faster than the clock on the wall", 0},
    {"speed", KEY_SPEED, "FACTOR", 0,
     "No faster than so many times real time, 0.01 to 1000, or max (default, but 1 with --view)",
     0},
    {"view", KEY_VIEW, "WHERE", OPTION_ARG_OPTIONAL,
     "Have a page to look at the run and to act on it: at [ADDRESS:]PORT, 127.0.0.1:8765 unless "
     "given",
     0},
    {"check", KEY_CHECK, NULL, 0, "Read and judge the scenario, and run nothing", 0},
    {"quiet", KEY_QUIET, NULL, 0, "No progress; errors stay", 0},
    {0},
};

static const char description[] =
    "Run a scenario in virtual time, with the robots' real firmware."
    "\v"
    "The run's files are trace.csv, events.csv, run.mcap, summary.json and two figures. Same "
    "scenario, seed "
    "and image, same files, unless somebody acts on the run.\n\n"
    "Exit status: 0 the run was completed, 1 it failed or was interrupted (what is in DIR is then "
    "complete up to that moment), 2 wrong usage or a scenario that is refused.";

static error_t parse_scenario(struct argp_state *state, const char *path)
{
    struct request *request = state->input;

    if (request->scenario != NULL)
        argp_error(state, "%s: one scenario at a time", path);
    request->scenario = path;
    return 0;
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;
    struct sim_options *options = &request->options;

    switch (key) {
    case KEY_ROBOTS: options->robots = argument_robots(state, value); break;
    case KEY_FIRMWARE: options->firmware = value; break;
    case KEY_PARAMETERS: request->parameters = value; break;
    case KEY_OUT: options->out = value; break;
    case KEY_SEED: options->seed = argument_number(state, "--seed", value, 0, UINT64_MAX); break;
    case KEY_THREADS:
        options->threads = (unsigned)argument_number(state, "--threads", value, 1, THREADS_MAX);
        break;
    case KEY_SET: request->settings[request->setting_count++] = value; break;
    case KEY_NO_TRACE: options->trace = false; break;
    case KEY_REAL_TIME: request->speed = 1; break;
    case KEY_SPEED: request->speed = argument_speed(state, value); break;
    case KEY_VIEW:
        request->looked_at = true;
        argument_view(state, value, &request->view);
        break;
    case KEY_CHECK: request->check = true; break;
    case KEY_QUIET: options->quiet = true; break;
    case ARGP_KEY_ARG: return parse_scenario(state, value);
    case ARGP_KEY_NO_ARGS: argp_error(state, "which scenario?"); break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

/* A look at who is still there, and at the signals, ms; and so many until somebody who loads the
 * page anew is back. */
#define STAY_MS 100
#define STAY_ALONE 50

/* Refuses what is asked for now. */
static void answer(struct view *view)
{
    struct act act;

    while (view_next_act(view, &act))
        view_answer(view, &act, "the run is over");
}

/* The page stays for those who look at what has been. */
static void stay(struct view *view, const volatile bool *stop)
{
    struct pollfd acts = {.fd = view_descriptor(view), .events = POLLIN};

    if (*stop || !view_looked_at(view))
        return;
    fputs("muster sim: the run is over; the page stays until you close it or press Ctrl-C\n",
          stderr);
    for (int alone = 0; !*stop && alone < STAY_ALONE; alone++) {
        poll(&acts, 1, STAY_MS);
        answer(view);
        if (view_viewers(view) > 0)
            alone = 0;
    }
}

static int run(const struct scenario *scenario, const struct sim_options *options,
               const volatile bool *stop)
{
    struct summary summary;
    char error[512] = "";

    switch (sim_run(scenario, options, stop, &summary, error, sizeof error)) {
    case SIM_DONE:
        if (!options->quiet)
            summary_print(&summary, options->out, stdout);
        return STATUS_DONE;
    case SIM_INTERRUPTED:
        fprintf(stderr, "muster sim: interrupted; %s is complete up to here\n", options->out);
        return STATUS_FAILED;
    case SIM_REFUSED: fprintf(stderr, "muster sim: %s\n", error); return STATUS_USAGE;
    case SIM_FAILED: break;
    }
    fprintf(stderr, "muster sim: %s\n", error);
    return STATUS_FAILED;
}

/* Someone who looks on is to see it as it would be. */
static double speed_of(const struct request *request)
{
    if (!isnan(request->speed))
        return request->speed;
    return request->looked_at ? 1 : 0;
}

static int run_looked_at(const struct scenario *scenario, struct request *request)
{
    struct sim_options *options = &request->options;
    struct view_about about = {"sim", scenario->name, scenario->duration, SIM_ACTS};
    char error[256];

    if (!argument_firmware_exists("sim", options->robots, options->firmware))
        return STATUS_USAGE;
    const volatile bool *stop = interrupt_catch();
    options->speed = speed_of(request);
    if (!request->looked_at)
        return run(scenario, options, stop);
    options->view = view_open(&request->view, &about, error, sizeof error);
    if (options->view == NULL) {
        fprintf(stderr, "muster sim: %s\n", error);
        return STATUS_FAILED;
    }
    fprintf(stderr, "view: %s\n", view_url(options->view));
    int status = run(scenario, options, stop);
    fflush(stdout);
    stay(options->view, stop);
    view_close(options->view);
    return status;
}

static int run_with_output(const struct scenario *scenario, struct request *request)
{
    struct sim_options *options = &request->options;
    char out[sizeof "runs/-" + SCENARIO_NAME_MAX + 20]; /* 20 digits are the longest seed */

    snprintf(out, sizeof out, "runs/%s-%llu", scenario->name, (unsigned long long)options->seed);
    if (options->out == NULL)
        options->out = out;
    return run_looked_at(scenario, request);
}

/* Of the command line's file, or NULL. False, and the line is printed, when it is refused. */
static bool read_parameters(const char *path, struct parameter_file **file)
{
    char error[1024];

    *file = NULL;
    if (path == NULL)
        return true;
    *file = parameter_file_read(path, error, sizeof error);
    if (*file == NULL)
        fprintf(stderr, "%s\n", error);
    return *file != NULL;
}

static int run_or_check(struct request *request, const struct scenario *scenario)
{
    if (!request->check)
        return run_with_output(scenario, request);
    if (!request->options.quiet)
        printf("%s: %s, %zu robots, %g s: good\n", request->scenario, scenario->name,
               scenario->robot_count, scenario->duration);
    return STATUS_DONE;
}

static int work(struct request *request)
{
    char error[1024];
    struct parameter_file *parameters;
    struct scenario *scenario = scenario_read(
        request->scenario, request->settings, request->setting_count,
        request->options.robots == SIM_AVR ? VERTICES_MAX_CHIP : VERTICES_MAX, error, sizeof error);

    if (scenario == NULL) {
        fprintf(stderr, "%s\n", error);
        return STATUS_USAGE;
    }
    int status = STATUS_USAGE;
    if (read_parameters(request->parameters, &parameters)) {
        request->options.parameters = parameters;
        status = run_or_check(request, scenario);
        parameter_file_free(parameters);
    }
    scenario_free(scenario);
    return status;
}

int cmd_sim(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "SCENARIO.yaml", description, NULL,
                                     NULL,         NULL};
    char firmware[PLACE_MAX];
    struct request request = {
        .options =
            {
                .robots = SIM_AVR,
                .firmware = place_firmware(firmware),
                .seed = 1,
                .threads = argument_threads_default(),
                .trace = true,
            },
        .settings = calloc((size_t)argc, sizeof *request.settings),
        .speed = NAN,
    };

    if (request.settings == NULL) {
        fprintf(stderr, "muster sim: not enough memory\n");
        return STATUS_FAILED;
    }
    argp_parse(&argp, argc, argv, 0, NULL, &request);
    int status = work(&request);
    free(request.settings);
    return status;
}
