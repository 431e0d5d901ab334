#include "arguments.h"
#include "commands.h"
#include "interrupt.h"
#include "paper.h"
#include "places.h"

#include <argp.h>
#include <stdio.h>

enum {
    KEY_OUT = 256,
    KEY_ONLY,
    KEY_ROBOTS,
    KEY_FIRMWARE,
    KEY_SCENARIOS,
    KEY_THREADS,
    KEY_QUIET,
};

static const struct argp_option option_table[] = {
    {"out", KEY_OUT, "DIR", 0, "Where the report goes, build/paper unless given", 0},
    {"only", KEY_ONLY, "FIGURE", 0, "Make one figure: 1, 5 to 11 or 14 to 19", 0},
    {"robots", KEY_ROBOTS, "KIND", 0,
     "avr: the firmware on simulated ATmega128 (default); native: the same brain in this program",
     0},
    {"firmware", KEY_FIRMWARE, "ELF", 0, "The image of avr robots, unless the one with muster", 0},
    {"scenarios", KEY_SCENARIOS, "DIR", 0, "Where the scenarios are, unless those with muster", 0},
    {"threads", KEY_THREADS, "N", 0,
     "Work with N threads instead of one per processor; the results are the same", 0},
    {"quiet", KEY_QUIET, NULL, 0, "No progress; errors stay", 0},
    {0},
};

static const char description[] =
    "Make the figures of the paper again, and judge its claims by them."
    "\v"
    "What comes out is report.html for readers, summary.json for programs, paper.md for the "
    "documentation, and the runs' own files in runs/.\n\n"
    "Exit status: 0 the report is written, whatever it says; 1 a run failed or was interrupted; 2 "
    "wrong usage.";

static int parse_figure(struct argp_state *state, const char *text)
{
    int figure = (int)argument_number(state, "--only", text, 1, 19);

    if (!paper_has_figure(figure))
        argp_error(state, "--only %s: there are figures 1, 5 to 11 and 14 to 19", text);
    return figure;
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct paper_options *options = state->input;

    switch (key) {
    case KEY_OUT: options->out = value; break;
    case KEY_ONLY: options->only = parse_figure(state, value); break;
    case KEY_ROBOTS: options->robots = argument_robots(state, value); break;
    case KEY_FIRMWARE: options->firmware = value; break;
    case KEY_SCENARIOS: options->scenarios = value; break;
    case KEY_THREADS:
        options->threads = (unsigned)argument_number(state, "--threads", value, 1, THREADS_MAX);
        break;
    case KEY_QUIET: options->quiet = true; break;
    case ARGP_KEY_ARG: argp_error(state, "%s: only options are allowed", value); break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static int write_paper(const struct paper_options *options)
{
    char error[1024] = "interrupted; there is no report";
    enum sim_end end = paper_write(options, interrupt_catch(), error, sizeof error);

    if (end == SIM_DONE) {
        if (!options->quiet)
            printf("The report is %s/report.html\n", options->out);
        return STATUS_DONE;
    }
    fprintf(stderr, "muster paper: %s\n", error);
    return end == SIM_REFUSED ? STATUS_USAGE : STATUS_FAILED;
}

int cmd_paper(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, NULL, description,
                                     NULL,         NULL,         NULL};
    char firmware[PLACE_MAX], scenarios[PLACE_MAX];
    struct paper_options options = {
        .robots = SIM_AVR,
        .firmware = place_firmware(firmware),
        .scenarios = place_scenarios(scenarios),
        .out = "build/paper",
        .threads = argument_threads_default(),
    };

    argp_parse(&argp, argc, argv, 0, NULL, &options);
    if (!argument_firmware_exists("paper", options.robots, options.firmware))
        return STATUS_USAGE;
    return write_paper(&options);
}
