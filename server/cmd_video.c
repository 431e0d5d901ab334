#include "commands.h"
#include "film.h"

#include <argp.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SPEED_MAX 1000.0
#define NAME_MAX_BYTES 300

/* What the command line says. */
struct request {
    const char *run, *out;
    struct film_options film;
    bool from, to; /* were given */
};

enum {
    KEY_OUT = 256,
    KEY_SPEED,
    KEY_FROM,
    KEY_TO,
    KEY_WIDTH,
};

static const struct argp_option option_table[] = {
    {"out", KEY_OUT, "FILE.svg", 0, "Where the film goes, instead of RUN.svg here", 0},
    {"speed", KEY_SPEED, "X", 0,
     "Times real time; 1, 2, 5, 10, ... unless given, so that it lasts 15 s at most", 0},
    {"from", KEY_FROM, "S", 0, "The first second that is shown", 0},
    {"to", KEY_TO, "S", 0, "The last one", 0},
    {"width", KEY_WIDTH, "PIXELS", 0, "Of the picture, 860 unless given", 0},
    {0},
};

static const char description[] =
    "Show a run as an animated picture, for a page or a talk."
    "\v"
    "The film is one SVG file that moves by itself, also inside of an image on a web page, without "
    "a script: robots coloured by role, the formation's vertices, trails, what befalls the team, "
    "and the mean distance error. It is light or dark as its reader likes, and stands still for "
    "those who asked for less motion. Same run, same bytes.\n\n"
    "A run without run.mcap has no vertices.\n\n"
    "Exit status: 0 the film is written, 1 it cannot be, 2 wrong usage or no run in RUN.";

static double parse_number(struct argp_state *state, const char *option, const char *text,
                           double low, double high)
{
    char *end;
    double value = strtod(text, &end);

    if (end == text || *end != '\0' || !(value >= low && value <= high))
        argp_error(state, "%s %s: a number from %g to %g is allowed", option, text, low, high);
    return value;
}

static error_t parse_run(struct argp_state *state, char *path)
{
    struct request *request = state->input;

    if (request->run != NULL)
        argp_error(state, "%s: one run at a time", path);
    request->run = path;
    return 0;
}

static bool ends_in(const char *name, const char *suffix)
{
    size_t length = strlen(name), end = strlen(suffix);

    return length > end && strcmp(name + length - end, suffix) == 0;
}

static const char *parse_out(struct argp_state *state, const char *name)
{
    if (!ends_in(name, ".svg"))
        argp_error(state, "--out %s: a name that ends in .svg is allowed", name);
    return name;
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;

    switch (key) {
    case KEY_OUT: request->out = parse_out(state, value); break;
    case KEY_SPEED:
        request->film.speed = parse_number(state, "--speed", value, 0.01, SPEED_MAX);
        break;
    case KEY_FROM:
        request->film.from = parse_number(state, "--from", value, 0, 1e6);
        request->from = true;
        break;
    case KEY_TO:
        request->film.to = parse_number(state, "--to", value, 0, 1e6);
        request->to = true;
        break;
    case KEY_WIDTH:
        request->film.width = parse_number(state, "--width", value, FILM_WIDTH_MIN, FILM_WIDTH_MAX);
        break;
    case ARGP_KEY_ARG: return parse_run(state, value);
    case ARGP_KEY_NO_ARGS: argp_error(state, "which run?"); break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

/* What is shown, within what there is. */
static bool choose_time(struct request *request, const struct archive *archive)
{
    double begin = history_time(&archive->history, 0), end = archive_end(archive);
    struct film_options *film = &request->film;

    film->from = request->from ? fmax(film->from, begin) : begin;
    film->to = request->to ? fmin(film->to, end) : end;
    if (film->to > film->from)
        return true;
    fprintf(stderr, "muster video: nothing to show from %g s to %g s: %s goes from %g s to %g s\n",
            film->from, film->to, archive->path, begin, end);
    return false;
}

static int write_file(const struct archive *archive, const struct film_options *options,
                      const char *path)
{
    FILE *out = fopen(path, "w");

    if (out == NULL) {
        fprintf(stderr, "muster video: cannot write %s: %s\n", path, strerror(errno));
        return STATUS_FAILED;
    }
    bool written = film_write(archive, options, out);
    if (fclose(out) == 0 && written) {
        printf("The film is %s\n", path);
        return STATUS_DONE;
    }
    fprintf(stderr, "muster video: cannot write %s: %s\n", path, strerror(errno));
    return STATUS_FAILED;
}

static int write_film(struct request *request, const struct archive *archive)
{
    char named[NAME_MAX_BYTES];

    if (!choose_time(request, archive))
        return STATUS_USAGE;
    snprintf(named, sizeof named, "%s.svg", archive->name);
    return write_file(archive, &request->film, request->out != NULL ? request->out : named);
}

int cmd_video(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "RUN", description,
                                     NULL,         NULL,         NULL};
    struct request request = {.film = {.width = FILM_WIDTH}};
    char error[512];

    argp_parse(&argp, argc, argv, 0, NULL, &request);
    struct archive **archives =
        archive_read_all((char *const[]){(char *)request.run}, 1, error, sizeof error);
    if (archives == NULL) {
        fprintf(stderr, "muster video: %s\n", error);
        return STATUS_USAGE;
    }
    int status = write_film(&request, archives[0]);
    archive_free_all(archives, 1);
    return status;
}
