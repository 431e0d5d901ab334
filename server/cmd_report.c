#include "account.h"
#include "commands.h"

#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the command line says. */
struct request {
    const char *out;
    char *const *runs; /* of `count` */
    size_t count;
    bool quiet;
};

enum {
    KEY_OUT = 256,
    KEY_QUIET,
};

static const struct argp_option option_table[] = {
    {"out", KEY_OUT, "FILE.html", 0,
     "Where the page goes; of one run RUN/report.html unless given, of several report.html here",
     0},
    {"quiet", KEY_QUIET, NULL, 0, "Do not say where it is; errors stay", 0},
    {0},
};

static const char description[] =
    "Tell of runs on one page: numbers, figures, events."
    "\v"
    "A RUN is the folder that `muster sim' or `muster serve' left, or a recording of it. Several "
    "are set side by side as well. The page is one HTML file that refers to nothing outside and "
    "runs no script; it is light or dark as its reader likes, and can be printed.\n\n"
    "Exit status: 0 the page is written, 1 it cannot be, 2 wrong usage or no run in RUN.";

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;

    switch (key) {
    case KEY_OUT: request->out = value; break;
    case KEY_QUIET: request->quiet = true; break;
    case ARGP_KEY_ARGS:
        request->runs = state->argv + state->next;
        request->count = (size_t)(state->argc - state->next);
        break;
    case ARGP_KEY_NO_ARGS: argp_error(state, "which run?"); break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static int write_page(struct archive *const *archives, const struct request *request,
                      const char *path)
{
    FILE *out = fopen(path, "w");

    if (out != NULL) {
        account_write(archives, request->count, out);
        bool written = ferror(out) == 0;
        if (fclose(out) == 0 && written) {
            if (!request->quiet)
                printf("The report is %s\n", path);
            return STATUS_DONE;
        }
    }
    fprintf(stderr, "muster report: cannot write %s: %s\n", path, strerror(errno));
    return STATUS_FAILED;
}

/* To be freed; NULL when there is no memory. */
static char *choose_path(const struct request *request)
{
    static const char name[] = "report.html";
    size_t room = strlen(request->runs[0]) + sizeof name + 1;

    if (request->out != NULL)
        return strdup(request->out);
    if (request->count > 1 || !archive_is_folder(request->runs[0]))
        return strdup(name);
    char *path = malloc(room);
    if (path != NULL)
        snprintf(path, room, "%s/%s", request->runs[0], name);
    return path;
}

static int report(const struct request *request)
{
    char error[512];
    struct archive **archives =
        archive_read_all(request->runs, request->count, error, sizeof error);

    if (archives == NULL) {
        fprintf(stderr, "muster report: %s\n", error);
        return STATUS_USAGE;
    }
    char *path = choose_path(request);
    int status = path == NULL ? STATUS_FAILED : write_page(archives, request, path);
    free(path);
    archive_free_all(archives, request->count);
    return status;
}

int cmd_report(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "RUN...", description,
                                     NULL,         NULL,         NULL};
    struct request request = {.out = NULL};

    argp_parse(&argp, argc, argv, 0, NULL, &request);
    return report(&request);
}
