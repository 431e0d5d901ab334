#include "arguments.h"
#include "avr_image.h"
#include "commands.h"
#include "diagnosis.h"
#include "flash_map.h"
#include "places.h"
#include "selection.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define F_CPU_DEFAULT 16000000

struct request {
    struct selection selection;
    double seconds;
};

enum { KEY_SECONDS = 256 };

static const struct argp_option option_table[] = {
    {"seconds", KEY_SECONDS, "N", 0, "How long to look, 1 to 60 (default 3)", 0},
    SELECTION_OPTIONS,
    {0},
};

static const char description[] =
    "Look robots over: link, processor, memory, battery, program, id. Nothing moves."
    "\v"
    "Each robot is asked 20 times a second, so that its link shows what it loses and how long an "
    "answer takes. What is wrong is told, and what to do.\n\n"
    "Exit status: 0 all is good, 1 something is not, 2 wrong usage or a file that is refused.";

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;
    struct selection *selection = &request->selection;

    switch (key) {
    case KEY_SECONDS:
        request->seconds =
            (double)argument_number(state, "--seconds", value, 1, DOCTOR_SECONDS_MAX);
        break;
    case ARGP_KEY_ARG:
        if (selection->path != NULL)
            argp_error(state, "%s: one site at a time", value);
        selection->path = value;
        break;
    case ARGP_KEY_NO_ARGS: argp_error(state, "which site?"); break;
    default: return selection_option(selection, key, value);
    }
    return 0;
}

static struct diagnosis_image image_that_came_with_muster(void)
{
    char path[PLACE_MAX], error[PLACE_MAX + 128];
    struct avr_image *file = avr_image_open(place_firmware(path), error, sizeof error);
    struct diagnosis_image image = {.f_cpu = F_CPU_DEFAULT};
    struct seal seal;

    if (file == NULL)
        return image;
    memcpy(&seal, file->flash + SEAL_AT, sizeof seal);
    image.known = (seal.length ^ seal.complement) == 0xFFFF;
    image.crc = seal.crc;
    image.f_cpu = file->f_cpu;
    avr_image_close(file);
    return image;
}

static int look(const struct request *request, struct doctor_job *jobs, struct job **list)
{
    const struct selection *selection = &request->selection;
    struct diagnosis_image image = image_that_came_with_muster();

    for (size_t i = 0; i < selection->count; i++) {
        doctor_begin(&jobs[i], selection->site->robots[selection->chosen[i]].id, request->seconds);
        list[i] = &jobs[i].job;
    }
    enum session_end end = selection_run(selection, "doctor", list, false);
    if (end == SESSION_FAILED || end == SESSION_INTERRUPTED)
        return STATUS_FAILED;
    return diagnosis_print(stdout, jobs, selection->count, &image) ? STATUS_DONE : STATUS_FAILED;
}

static int work(struct request *request)
{
    struct selection *selection = &request->selection;

    if (!selection_open(selection, "doctor"))
        return STATUS_USAGE;
    struct doctor_job *jobs = calloc(selection->count, sizeof *jobs);
    struct job **list = calloc(selection->count, sizeof *list);
    int status = STATUS_FAILED;
    if (jobs == NULL || list == NULL)
        fputs("muster doctor: not enough memory\n", stderr);
    else
        status = look(request, jobs, list);
    free(list);
    free(jobs);
    return status;
}

int cmd_doctor(int argc, char **argv)
{
    static const struct argp argp = {option_table, parse_option, "SITE.yaml", description,
                                     NULL,         NULL,         NULL};
    struct request request = {.seconds = 3};

    if (!selection_begin(&request.selection, "doctor", argc))
        return STATUS_FAILED;
    argp_parse(&argp, argc, argv, 0, NULL, &request);
    int status = work(&request);
    selection_end(&request.selection);
    return status;
}
