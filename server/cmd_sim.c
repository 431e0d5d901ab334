#include "arguments.h"
#include "commands.h"
#include "interrupt.h"
#include "limits.h"
#include "places.h"
#include "scenario.h"
#include "sim.h"

#include <argp.h>
#include <stdio.h>
#include <stdlib.h>

/* What the command line says. */
struct request {
    struct sim_options options;
    const char *scenario;
    const char *parameters;
    const char **settings;
    size_t setting_count;
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
    {"no-trace", KEY_NO_TRACE, NULL, 0, "Write neither trace.csv nor figures", 0},
    {"real-time", KEY_REAL_TIME, NULL, 0, "No faster than the clock on the wall", 0},
    {"check", KEY_CHECK, NULL, 0, "Read and judge the scenario, and run nothing", 0},
    {"quiet", KEY_QUIET, NULL, 0, "No progress; errors stay", 0},
    {0},
};

static const char description[] =
    "Run a scenario in virtual time, with the robots' real firmware."
    "\v"
    "The run's files are trace.csv, events.csv, summary.json and two figures. Same scenario, seed "
    "and image, same files.\n\n"
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
    case KEY_REAL_TIME: options->real_time = true; break;
    case KEY_CHECK: request->check = true; break;
    case KEY_QUIET: options->quiet = true; break;
    case ARGP_KEY_ARG: return parse_scenario(state, value);
    case ARGP_KEY_NO_ARGS: argp_error(state, "which scenario?"); break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static int run(const struct scenario *scenario, const struct sim_options *options)
{
    struct summary summary;
    char error[512] = "";

    if (!argument_firmware_exists("sim", options->robots, options->firmware))
        return STATUS_USAGE;
    const volatile bool *stop = interrupt_catch();
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

static int run_with_output(const struct scenario *scenario, struct sim_options *options)
{
    char out[sizeof "runs/-" + SCENARIO_NAME_MAX + 20]; /* 20 digits are the longest seed */

    snprintf(out, sizeof out, "runs/%s-%llu", scenario->name, (unsigned long long)options->seed);
    if (options->out == NULL)
        options->out = out;
    return run(scenario, options);
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
        return run_with_output(scenario, &request->options);
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
