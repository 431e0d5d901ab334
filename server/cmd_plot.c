#include "commands.h"
#include "comparison.h"

#include <argp.h>
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
    {"out", KEY_OUT, "FILE", 0,
     "Where the figure goes: a name that ends in .svg, .png or .pdf, or a folder, in which it "
     "becomes plot.svg and plot.png; the current one unless given",
     0},
    {"quiet", KEY_QUIET, NULL, 0, "Print nothing; errors stay", 0},
    {0},
};

static const char description[] =
    "Compare runs in one figure: their mean distance errors over time."
    "\v"
    "A RUN is the folder that `muster sim' or `muster serve' left, or a recording of it. Up to 8 "
    "runs have a line style each; more are thin lines with their median. With one run, what befell "
    "the team is marked. Peak, end and integral of each are printed as a table.\n\n"
    "  muster plot runs/paper-sim-leader-fault-1\n"
    "  muster plot --out loss.pdf runs/lossy-*\n\n"
    "Exit status: 0 the figure is drawn, 1 it cannot be, 2 wrong usage or no run in RUN.";

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

/* One picture. */
static int draw(struct archive *const *archives, size_t count, const char *dir, const char *name)
{
    char error[512];

    if (comparison_draw(archives, count, dir, name, error, sizeof error))
        return STATUS_DONE;
    fprintf(stderr, "muster plot: %s/%s: %s\n", dir, name, error);
    return STATUS_FAILED;
}

static int draw_both(struct archive *const *archives, size_t count, const char *dir)
{
    int status = draw(archives, count, dir, "plot.svg");

    return status == STATUS_DONE ? draw(archives, count, dir, "plot.png") : status;
}

static int draw_file(struct archive *const *archives, size_t count, const char *out)
{
    char *dir = strdup(out);

    if (dir == NULL) {
        fprintf(stderr, "muster plot: no memory\n");
        return STATUS_FAILED;
    }
    char *slash = strrchr(dir, '/');
    if (slash != NULL)
        slash[slash == dir ? 1 : 0] = '\0';
    int status = draw(archives, count, slash == NULL ? "." : dir,
                      slash == NULL ? out : out + (slash - dir) + 1);
    free(dir);
    return status;
}

static int plot(const struct request *request)
{
    char error[512];
    struct archive **archives =
        archive_read_all(request->runs, request->count, error, sizeof error);

    if (archives == NULL) {
        fprintf(stderr, "muster plot: %s\n", error);
        return STATUS_USAGE;
    }
    bool folder = archive_is_folder(request->out);
    int status = folder ? draw_both(archives, request->count, request->out)
                        : draw_file(archives, request->count, request->out);
    if (status == STATUS_DONE && !request->quiet) {
        comparison_print(archives, request->count, stdout);
        printf("The figure is %s%s\n", request->out, folder ? "/plot.svg and plot.png" : "");
    }
    archive_free_all(archives, request->count);
    return status;
}

int cmd_plot(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "RUN...", description,
                                     NULL,         NULL,         NULL};
    struct request request = {.out = "."};

    argp_parse(&argp, argc, argv, 0, NULL, &request);
    if (!archive_is_folder(request.out) && !comparison_knows(request.out)) {
        fprintf(stderr,
                "muster plot: --out %s: a name that ends in .svg, .png or .pdf, or a folder that "
                "there is, is allowed\n",
                request.out);
        return STATUS_USAGE;
    }
    return plot(&request);
}
