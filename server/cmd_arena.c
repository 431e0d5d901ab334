#include "arena.h"
#include "arguments.h"
#include "commands.h"
#include "limits.h"
#include "natnet_server.h"

#include <argp.h>
#include <stdio.h>
#include <string.h>

struct request {
    struct arena_options options;
    const char *scenario;
    bool unicast;
};

enum {
    KEY_RATE = 256,
    KEY_INTERFACE,
    KEY_PORT,
    KEY_DATA_PORT,
    KEY_GROUP,
    KEY_UNICAST,
    KEY_VERSION,
    KEY_ROBOTS_PORT,
    KEY_UP,
    KEY_QUIET,
};

#define RATE_MAX 1000

static const struct argp_option option_table[] = {
    {"rate", KEY_RATE, "HZ", 0, "Frames a second (default 120)", 0},
    {"interface", KEY_INTERFACE, "ADDRESS", 0, "Address of ours to be at (default 127.0.0.1)", 0},
    {"port", KEY_PORT, "N", 0, "Port that clients ask (default 1510; 0: any)", 0},
    {"data-port", KEY_DATA_PORT, "N", 0, "Port that frames are sent to (default 1511; 0: any)", 0},
    {"group", KEY_GROUP, "ADDRESS", 0, "Multicast group of the frames (default 239.255.42.99)", 0},
    {"unicast", KEY_UNICAST, NULL, 0, "Send frames to each client that asks, and to no group", 0},
    {"version", KEY_VERSION, "X.Y", 0, "Version of NatNet, 2.5 to 4.2 (default 3.0)", 0},
    {"robots-port", KEY_ROBOTS_PORT, "N", 0,
     "Port that robots send their set-points to (default 47600; 0: any)", 0},
    {"up", KEY_UP, "AXIS", 0, "Upward axis of what is told, y (default) or z", 0},
    {"quiet", KEY_QUIET, NULL, 0, "Tell nothing of clients; errors stay", 0},
    {0},
};

static const char description[] =
    "Be the arena of virtual robots in real time, and its motion capture: a NatNet server."
    "\v"
    "The robots, `muster robot --arena', start where the scenario has them. One line on stdout "
    "tells "
    "the addresses when all is ready; SIGTERM or SIGINT ends it.\n\n"
    "Lines on stdin are faults: `lose 3' and `find 3' the body of robot 3, `jump 3 0.8' tells it "
    "0.8 m off until `jump 3 0', `freeze' and `thaw' all frames, `restart' the frames' numbers.\n\n"
    "Exit status: 0 it was ended, 1 it failed, 2 wrong usage, or a port that cannot be had.";

static void read_version(struct argp_state *state, const char *text, uint8_t version[2])
{
    char rest;

    if (sscanf(text, "%3hhu.%3hhu%c", &version[0], &version[1], &rest) != 2 ||
        !natnet_server_speaks(version))
        argp_error(state, "--version %s: 2.5 to 4.2 is allowed", text);
}

static bool read_up(struct argp_state *state, const char *text)
{
    if (strcmp(text, "y") != 0 && strcmp(text, "z") != 0)
        argp_error(state, "--up %s: y or z is allowed", text);
    return text[0] == 'y';
}

static uint16_t read_port(struct argp_state *state, const char *option, const char *text)
{
    return (uint16_t)argument_number(state, option, text, 0, UINT16_MAX);
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;
    struct arena_options *options = &request->options;

    switch (key) {
    case KEY_RATE:
        options->rate = (unsigned)argument_number(state, "--rate", value, 1, RATE_MAX);
        break;
    case KEY_INTERFACE: options->interface = value; break;
    case KEY_PORT: options->port = read_port(state, "--port", value); break;
    case KEY_DATA_PORT: options->data_port = read_port(state, "--data-port", value); break;
    case KEY_GROUP: options->group = value; break;
    case KEY_UNICAST: request->unicast = true; break;
    case KEY_VERSION: read_version(state, value, options->version); break;
    case KEY_ROBOTS_PORT: options->robots_port = read_port(state, "--robots-port", value); break;
    case KEY_UP: options->y_up = read_up(state, value); break;
    case KEY_QUIET: options->quiet = true; break;
    case ARGP_KEY_ARG:
        if (request->scenario != NULL)
            argp_error(state, "%s: one scenario at a time", value);
        request->scenario = value;
        break;
    case ARGP_KEY_NO_ARGS: argp_error(state, "which scenario?"); break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static int work(struct request *request)
{
    char error[1024] = "";
    struct scenario *scenario =
        scenario_read(request->scenario, NULL, 0, VERTICES_MAX, error, sizeof error);

    if (scenario == NULL) {
        fprintf(stderr, "%s\n", error);
        return STATUS_USAGE;
    }
    request->options.scenario = scenario;
    if (request->unicast)
        request->options.group = NULL;
    enum arena_end end = arena_run(&request->options, error, sizeof error);
    scenario_free(scenario);
    if (end == ARENA_DONE)
        return STATUS_DONE;
    fprintf(stderr, "muster arena: %s\n", error);
    return end == ARENA_FAILED ? STATUS_FAILED : STATUS_USAGE;
}

int cmd_arena(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "SCENARIO.yaml", description, NULL,
                                     NULL,         NULL};
    struct request request = {
        .options =
            {
                .rate = 120,
                .interface = "127.0.0.1",
                .port = 1510,
                .data_port = 1511,
                .robots_port = 47600,
                .group = "239.255.42.99",
                .version = {3, 0},
                .y_up = true,
            },
    };

    argp_parse(&argp, argc, argv, 0, NULL, &request);
    return work(&request);
}
