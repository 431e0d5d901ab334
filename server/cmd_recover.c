#include "commands.h"
#include "recovery.h"

#include <argp.h>
#include <stdio.h>

/* What the command line says. */
struct request {
    const char *run, *out;
};

enum {
    KEY_OUT = 256,
};

static const struct argp_option option_table[] = {
    {"out", KEY_OUT, "FILE", 0, "Write FILE, and leave the recording as it is", 0},
    {0},
};

static const char description[] =
    "Make the recording of a run whole that was cut short, by kill -9 or by power."
    "\v"
    "RUN is a run's folder, or an MCAP file. All that had been handed over stays: what was "
    "recorded "
    "up to half a second of mission time before the end, or a second of the clock on the wall. "
    "Index "
    "and footer are written anew, so that other tools open the file. A recording that is whole is "
    "left alone.\n\n"
    "Exit status: 0 the recording is whole, 1 it could not be written, 2 wrong usage, or what is "
    "no recording, or one that is being written.";

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;

    switch (key) {
    case KEY_OUT: request->out = value; break;
    case ARGP_KEY_ARG:
        if (request->run != NULL)
            argp_error(state, "%s: one run at a time", value);
        request->run = value;
        break;
    case ARGP_KEY_NO_ARGS: argp_error(state, "which run?"); break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static void tell(const struct request *request, const struct recovery *recovery)
{
    printf("%s: %s, %.2f s, %llu messages", request->out != NULL ? request->out : request->run,
           recovery->whole ? "was whole" : "made whole", recovery->seconds,
           (unsigned long long)recovery->messages);
    if (recovery->damaged > 0)
        printf("; %zu damaged chunk%s left out", recovery->damaged,
               recovery->damaged == 1 ? "" : "s");
    putchar('\n');
}

int cmd_recover(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "RUN", description,
                                     NULL,         NULL,         NULL};
    struct request request = {0};
    struct recovery recovery;
    char error[512];

    argp_parse(&argp, argc, argv, 0, NULL, &request);
    enum recovery_end end = recovery_run(request.run, request.out, &recovery, error, sizeof error);
    if (end == RECOVERY_DONE) {
        tell(&request, &recovery);
        return STATUS_DONE;
    }
    fprintf(stderr, "muster recover: %s\n", error);
    return end == RECOVERY_REFUSED ? STATUS_USAGE : STATUS_FAILED;
}
