#include "arguments.h"
#include "commands.h"
#include "fields.h"
#include "fleet.h"
#include "limits.h"
#include "places.h"

#include <argp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct request {
    struct fleet_options options;
    enum sim_robots robots;
    const char *firmware, *loader;
    uint16_t *ids;
};

enum {
    KEY_ID = 256,
    KEY_BLANK,
    KEY_LINK,
    KEY_ROBOTS,
    KEY_FIRMWARE,
    KEY_LOADER,
    KEY_ARENA,
    KEY_QUIET
};

static const struct argp_option option_table[] = {
    {"id", KEY_ID, "N", 0, "The robot's id, 1 to 65534; several robots: 1..100 or 1, 4..7", 0},
    {"blank", KEY_BLANK, NULL, 0, "Robots as they are made, without an id: --id only numbers links",
     0},
    {"link", KEY_LINK, "WHERE", 0,
     "Where its host reaches it: pty:PATH, tcp:HOST:PORT (port 0: any), "
     "rfcomm[:CHANNEL[@ADDRESS]]; %d stands for the id",
     0},
    {"robots", KEY_ROBOTS, "KIND", 0,
     "avr: the firmware on a simulated ATmega128 (default); native: the same brain in this program",
     0},
    {"firmware", KEY_FIRMWARE, "ELF", 0, "The image of avr robots, unless the one with muster", 0},
    {"loader", KEY_LOADER, "ELF", 0,
     "The boot loader of avr robots, unless the one with muster; none: without, so that their "
     "program "
     "stays as it is",
     0},
    {"arena", KEY_ARENA, "HOST:PORT", 0, "Where `muster arena' waits for its set-points", 0},
    {"quiet", KEY_QUIET, NULL, 0, "Tell no comings and goings of hosts; errors stay", 0},
    {0},
};

static const char description[] =
    "Be a virtual robot in real time, behind a link that a host dials."
    "\v"
    "Each robot tells on one line where it is, as the link: of a site file takes it, and runs "
    "until "
    "SIGTERM or SIGINT comes. SIGUSR1 switches it off and on again.\n\n"
    "Exit status: 0 it was ended, 1 it failed, 2 wrong usage, or a link that cannot be had.";

static bool add_id(struct refusal *refusal, const struct node *node, int64_t id, void *into)
{
    struct request *request = into;

    for (size_t i = 0; i < request->options.count; i++)
        if (request->ids[i] == id)
            return refuse(refusal, node->place, "robot %d is named twice", (int)id);
    request->ids[request->options.count++] = (uint16_t)id;
    return true;
}

/* Ids are written as in scenarios. */
static void read_ids(struct argp_state *state, char *text)
{
    struct request *request = state->input;
    char words[256];
    struct refusal refusal = {words, sizeof words};
    const struct node node = {.kind = NODE_SCALAR, .place = {"--id", false, 1, 1}, .text = text};

    request->options.count = 0;
    if (!set_read(&refusal, &node, 1, ROBOT_ID_MAX, add_id, request))
        argp_error(state, "%s", words);
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;

    switch (key) {
    case KEY_ID: read_ids(state, value); break;
    case KEY_BLANK: request->options.blank = true; break;
    case KEY_LINK: request->options.link = value; break;
    case KEY_ROBOTS: request->robots = argument_robots(state, value); break;
    case KEY_FIRMWARE: request->firmware = value; break;
    case KEY_LOADER: request->loader = value; break;
    case KEY_ARENA: request->options.arena = value; break;
    case KEY_QUIET: request->options.quiet = true; break;
    case ARGP_KEY_ARG: argp_error(state, "%s: only options are allowed", value); break;
    case ARGP_KEY_END:
        if (request->options.count == 0 || request->options.link == NULL)
            argp_error(state, "--id and --link are needed");
        break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

/* The one that comes with muster may be missing. */
static const char *choose_loader(const struct request *request, char place[PLACE_MAX])
{
    if (request->loader == NULL)
        return access(place_loader(place), R_OK) == 0 ? place : NULL;
    return strcmp(request->loader, "none") == 0 ? NULL : request->loader;
}

static int work(struct request *request)
{
    char error[512] = "", place[PLACE_MAX];

    if (!argument_firmware_exists("robot", request->robots, request->firmware))
        return STATUS_USAGE;
    if (request->robots == SIM_AVR) {
        request->options.firmware = request->firmware;
        request->options.loader = choose_loader(request, place);
    }
    request->options.ids = request->ids;
    enum fleet_end end = fleet_run(&request->options, error, sizeof error);
    if (end == FLEET_DONE)
        return STATUS_DONE;
    fprintf(stderr, "muster robot: %s\n", error);
    return end == FLEET_FAILED ? STATUS_FAILED : STATUS_USAGE;
}

int cmd_robot(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, NULL, description,
                                     NULL,         NULL,         NULL};
    char firmware[PLACE_MAX];
    struct request request = {
        .robots = SIM_AVR,
        .firmware = place_firmware(firmware),
        .ids = calloc(ROBOT_ID_MAX, sizeof *request.ids),
    };

    if (request.ids == NULL) {
        fprintf(stderr, "muster robot: not enough memory\n");
        return STATUS_FAILED;
    }
    argp_parse(&argp, argc, argv, 0, NULL, &request);
    int status = work(&request);
    free(request.ids);
    return status;
}
