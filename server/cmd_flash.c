#include "avr_image.h"
#include "commands.h"
#include "places.h"
#include "selection.h"
#include "update.h"

#include <stdio.h>
#include <stdlib.h>

/* What the command line says. */
struct request {
    struct selection selection;
    const char *firmware;
    struct update_options options;
};

enum { KEY_FIRMWARE = 256, KEY_AGAIN, KEY_FORCE };

static const struct argp_option option_table[] = {
    {"firmware", KEY_FIRMWARE, "ELF", 0, "The program, in place of the one that came with muster",
     0},
    {"again", KEY_AGAIN, NULL, 0, "Also to robots that have it already", 0},
    {"force", KEY_FORCE, NULL, 0, "Also to a robot that says it has another id than the site's", 0},
    SELECTION_OPTIONS,
    {0},
};

static const char description[] =
    "Give robots another program over their links, all robots at once."
    "\v"
    "A robot keeps the program that it has until the new one is whole, so nothing is lost when the "
    "link or the power fails on the way: run it again. Parameters stay. A robot that is on a "
    "mission is halted.\n\n"
    "Exit status: 0 every robot runs the program, 1 some do not (it is told which, and why), 2 "
    "wrong usage, or a site or a program that is refused.";

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;

    switch (key) {
    case KEY_FIRMWARE: request->firmware = value; break;
    case KEY_AGAIN: request->options.again = true; break;
    case KEY_FORCE: request->options.force = true; break;
    case ARGP_KEY_ARG:
        if (request->selection.path != NULL)
            argp_error(state, "%s: one site at a time", value);
        request->selection.path = value;
        break;
    case ARGP_KEY_NO_ARGS: argp_error(state, "which site?"); break;
    default: return selection_option(&request->selection, key, value);
    }
    return 0;
}

/* ---- the program ----------------------------------------------------------------------- */

static bool read_program(struct program *program, const char *path)
{
    char error[512], words[160];
    struct avr_image *image = avr_image_open(path, error, sizeof error);

    if (image == NULL) {
        fprintf(stderr, "muster flash: %s\n", error);
        return false;
    }
    bool good = program_take(program, image->flash, image->baud, words, sizeof words);
    avr_image_close(image);
    if (!good)
        fprintf(stderr, "muster flash: %s: %s\n", path, words);
    return good;
}

/* A robot that speaks at another rate than its radio is lost until it is flashed by a programmer.
 */
static bool suits_links(const struct program *program, const struct selection *selection,
                        const char *path)
{
    for (size_t i = 0; i < selection->count; i++) {
        const struct site_robot *robot = &selection->site->robots[selection->chosen[i]];

        if (robot->link.baud == program->baud)
            continue;
        fprintf(stderr,
                "muster flash: %s speaks at %lu baud, robot %u's link at %lu: `make firmware "
                "BAUD=%lu', or mend the site file\n",
                path, (unsigned long)program->baud, robot->id, (unsigned long)robot->link.baud,
                (unsigned long)robot->link.baud);
        return false;
    }
    return true;
}

/* ---- the work -------------------------------------------------------------------------- */

/* Of those whose job was ended from without, it was not told yet what they have. */
static void tell(const struct update *updates, size_t count)
{
    char standing[JOB_WORDS_MAX];
    size_t good = 0;

    for (size_t i = 0; i < count; i++) {
        const struct update *update = &updates[i];

        good += update->job.state == JOB_DONE;
        if (update->job.state != JOB_FAILED || update->told)
            continue;
        update_standing(update, standing);
        printf("robot %u %s\n", update->job.robot, standing);
    }
    printf("%zu of %zu robots run %08lX%s\n", good, count, (unsigned long)updates[0].program->crc,
           good < count ? "; for the others, run it again" : "");
}

static int run(const struct request *request, const struct program *program)
{
    const struct selection *selection = &request->selection;
    struct update *updates = calloc(selection->count, sizeof *updates);
    struct job **jobs = calloc(selection->count, sizeof *jobs);
    int status = STATUS_FAILED;

    if (updates == NULL || jobs == NULL) {
        fputs("muster flash: not enough memory\n", stderr);
    } else {
        for (size_t i = 0; i < selection->count; i++) {
            uint16_t id = selection->site->robots[selection->chosen[i]].id;

            update_begin(&updates[i], program, id, &request->options);
            jobs[i] = &updates[i].job;
        }
        enum session_end end = selection_run(selection, "flash", jobs, false);
        if (end != SESSION_FAILED)
            tell(updates, selection->count);
        status = selection_status(end);
    }
    free(jobs);
    free(updates);
    return status;
}

static int work(struct request *request)
{
    static struct program program;
    char place[PLACE_MAX];
    const char *path = request->firmware != NULL ? request->firmware : place_firmware(place);

    if (!read_program(&program, path) || !selection_open(&request->selection, "flash") ||
        !suits_links(&program, &request->selection, path))
        return STATUS_USAGE;
    return run(request, &program);
}

int cmd_flash(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "SITE.yaml", description,
                                     NULL,         NULL,         NULL};
    struct request request = {0};

    if (!selection_begin(&request.selection, "flash", argc))
        return STATUS_FAILED;
    argp_parse(&argp, argc, argv, 0, NULL, &request);
    int status = work(&request);
    selection_end(&request.selection);
    return status;
}
