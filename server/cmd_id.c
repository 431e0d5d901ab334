#include "arguments.h"
#include "commands.h"
#include "id.h"
#include "limits.h"
#include "param.h"
#include "selection.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BAUD_DEFAULT 115200
#define LINKS_MAX 1000

/* What the command line says, and what comes of it, by place in the selection. */
struct request {
    struct selection selection;
    const char **words; /* a site file, or links */
    size_t word_count;
    uint16_t first; /* 0: ids are the site's */
    uint32_t baud;
    bool force;
    struct id_link *links;
    struct param_job *jobs;
    struct job **list;
};

enum { KEY_FIRST = 256, KEY_BAUD, KEY_FORCE };

static const struct argp_option option_table[] = {
    {"first", KEY_FIRST, "N", 0,
     "The arguments are links of robots that are in no site yet: those without an id get N and so "
     "on, and the lines for a site file are printed",
     0},
    {"baud", KEY_BAUD, "N", 0, "With --first: the robots' baud rate (default 115200)", 0},
    {"force", KEY_FORCE, NULL, 0, "Also change the id of robots that have another one", 0},
    SELECTION_OPTIONS,
    {0},
};

static const char description[] =
    "Give robots their ids, over their links."
    "\v"
    "Robots that have none get the one that the site file has for their link; it is saved, and "
    "read back. One that has another is told of and left alone.\n\n"
    "  muster id SITE.yaml\n"
    "  muster id --first 5 tty:/dev/ttyUSB0 tty:/dev/ttyUSB1\n\n"
    "Exit status: 0 every robot has its id, 1 some have not (it is told which, and why), 2 wrong "
    "usage or a file that is refused.";

/* ---- the command line ------------------------------------------------------------------ */

static void judge_arguments(struct argp_state *state)
{
    struct request *request = state->input;
    const struct selection *selection = &request->selection;

    if (request->word_count == 0)
        argp_error(state, "which site? Or --first N and links");
    if (request->first == 0 && request->word_count > 1)
        argp_error(state, "%s: one site at a time", request->words[1]);
    if (request->first == 0 && request->baud != 0)
        argp_error(state, "--baud goes with --first; a site file has the robots' own");
    if (request->first != 0 && (selection->robots != NULL || selection->setting_count > 0))
        argp_error(state, "--robots and --set go with a site");
    if (request->word_count > LINKS_MAX)
        argp_error(state, "%zu links; 1 to %d are allowed", request->word_count, LINKS_MAX);
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;

    switch (key) {
    case KEY_FIRST:
        /* Those that are in use are left out. */
        request->first =
            (uint16_t)argument_number(state, "--first", value, 1, ROBOT_ID_MAX - 2 * LINKS_MAX);
        break;
    case KEY_BAUD:
        request->baud = (uint32_t)argument_number(state, "--baud", value, 1200, 1000000);
        break;
    case KEY_FORCE: request->force = true; break;
    case ARGP_KEY_ARG: request->words[request->word_count++] = value; break;
    case ARGP_KEY_END: judge_arguments(state); break;
    default: return selection_option(&request->selection, key, value);
    }
    return 0;
}

static bool read_link(const struct request *request, size_t i, struct site_robot *robot)
{
    char words[LINK_WORDS_MAX];

    for (size_t k = 0; k < i; k++) {
        if (strcmp(request->words[k], request->words[i]) != 0)
            continue;
        fprintf(stderr, "muster id: %s is named twice\n", request->words[i]);
        return false;
    }
    robot->link = (struct link_settings){
        .adapter = -1,
        .baud = request->baud != 0 ? request->baud : BAUD_DEFAULT,
    };
    if (link_address_read(request->words[i], &robot->link.address, words))
        return true;
    fprintf(stderr, "muster id: link is '%s'; %s\n", request->words[i], words);
    return false;
}

/* A site of nothing but links. */
static bool open_links(struct request *request)
{
    struct selection *selection = &request->selection;

    selection->site = calloc(1, sizeof *selection->site);
    if (selection->site != NULL)
        selection->site->robots = calloc(request->word_count, sizeof *selection->site->robots);
    selection->chosen = calloc(request->word_count, sizeof *selection->chosen);
    if (selection->chosen == NULL || selection->site == NULL || selection->site->robots == NULL) {
        fputs("muster id: not enough memory\n", stderr);
        return false;
    }
    for (size_t i = 0; i < request->word_count; i++) {
        if (!read_link(request, i, &selection->site->robots[i]))
            return false;
        selection->chosen[selection->count++] = i;
        selection->site->robot_count++;
    }
    return true;
}

/* ---- the work -------------------------------------------------------------------------- */

static uint16_t wanted(const struct request *request, size_t i)
{
    const struct selection *selection = &request->selection;

    return selection->site->robots[selection->chosen[i]].id;
}

static enum session_end ask_all(struct request *request)
{
    const struct param_plan plan = {
        .any = true,
        .read = param_bit(PARAMETER_ID) | param_bit(PARAMETER_UNSAVED),
    };
    const struct selection *selection = &request->selection;

    for (size_t i = 0; i < selection->count; i++) {
        param_begin(&request->jobs[i], wanted(request, i), &plan);
        request->list[i] = &request->jobs[i].job;
    }
    enum session_end end = selection_run(selection, "id", request->list, false);
    for (size_t i = 0; i < selection->count; i++)
        request->links[i] = (struct id_link){
            .wanted = wanted(request, i),
            .answered = request->jobs[i].job.state == JOB_DONE,
            .has = (uint16_t)request->jobs[i].before[param_row(PARAMETER_ID)].value,
        };
    return end;
}

/* To those that are to get one. */
static enum session_end give(struct request *request)
{
    struct selection part = request->selection;
    struct param_plan plan = {
        .any = true,
        .read = param_bit(PARAMETER_UNSAVED),
        .set = param_bit(PARAMETER_ID),
        .save = true,
    };

    part.chosen = calloc(part.count, sizeof *part.chosen);
    part.count = 0;
    for (size_t i = 0; part.chosen != NULL && i < request->selection.count; i++) {
        if (request->links[i].verdict != ID_GETS)
            continue;
        plan.value[PARAMETER_ID] = request->links[i].gets;
        param_begin(&request->jobs[i], wanted(request, i), &plan);
        request->list[part.count] = &request->jobs[i].job;
        part.chosen[part.count++] = request->selection.chosen[i];
    }
    enum session_end end = part.chosen == NULL ? SESSION_FAILED
                           : part.count > 0    ? selection_run(&part, "id", request->list, false)
                                               : SESSION_DONE;
    free(part.chosen);
    return end;
}

/* ---- the words ------------------------------------------------------------------------- */

static const char *link_of(const struct request *request, size_t i, char *words, size_t room)
{
    const struct selection *selection = &request->selection;

    link_address_write(&selection->site->robots[selection->chosen[i]].link.address, words, room);
    return words;
}

static void tell_good(const struct request *request, size_t i, FILE *out)
{
    const struct id_link *link = &request->links[i];
    char where[160];

    if (request->selection.quiet)
        return;
    link_of(request, i, where, sizeof where);
    if (link->verdict == ID_KEEPS)
        fprintf(out, "%s: is robot %u already\n", where, link->has);
    else if (link->has == 0)
        fprintf(out, "%s: had no id, is robot %u now\n", where, link->gets);
    else
        fprintf(out, "%s: was robot %u, is robot %u now\n", where, link->has, link->gets);
    if (link->verdict == ID_KEEPS && request->jobs[i].before[param_row(PARAMETER_UNSAVED)].value)
        fprintf(out, "%s: has values that are not saved (`muster param save')\n", where);
}

static void tell_bad(const struct request *request, size_t i)
{
    const struct id_link *link = &request->links[i];
    char where[160], other[160];

    link_of(request, i, where, sizeof where);
    link_of(request, link->twin, other, sizeof other);
    if (link->verdict == ID_TAKEN)
        fprintf(stderr, "%s: gets no id: %s says it is robot %u already; --force sorts them\n",
                where, other, link->wanted);
    else if (link->twin != i)
        fprintf(stderr, "%s and %s: both say they are robot %u; --force gives each its own\n",
                where, other, link->has);
    if (link->verdict == ID_OTHER)
        fprintf(stderr,
                "%s: is robot %u, not %u, and is left alone: mend the site file, or --force makes "
                "it robot %u\n",
                where, link->has, link->wanted, link->wanted);
}

/* True when every robot has its id. */
static bool tell(const struct request *request)
{
    FILE *out = request->first == 0 ? stdout : stderr;
    bool good = true;

    for (size_t i = 0; i < request->selection.count; i++) {
        enum id_verdict verdict = request->links[i].verdict;
        bool done = request->jobs[i].job.state == JOB_DONE;

        if (done && (verdict == ID_KEEPS || verdict == ID_GETS))
            tell_good(request, i, out);
        else if (done)
            tell_bad(request, i);
        good &= done && (verdict == ID_KEEPS || verdict == ID_GETS);
    }
    return good;
}

/* The lines for a site file. */
static void print_robots(const struct request *request)
{
    puts("robots:");
    for (size_t i = 0; i < request->selection.count; i++) {
        const struct id_link *link = &request->links[i];
        bool gets = link->verdict == ID_GETS;

        if (request->jobs[i].job.state != JOB_DONE || (!gets && link->verdict != ID_KEEPS))
            continue;
        printf("  - {id: %u, link: \"%s\"", gets ? link->gets : link->has, request->words[i]);
        if (request->baud != 0)
            printf(", baud: %u", request->baud);
        puts("}");
    }
}

static int work(struct request *request)
{
    struct selection *selection = &request->selection;

    selection->path = request->words[0];
    bool open = request->first == 0 ? selection_open(selection, "id") : open_links(request);
    if (!open)
        return STATUS_USAGE;
    request->links = calloc(selection->count, sizeof *request->links);
    request->jobs = calloc(selection->count, sizeof *request->jobs);
    request->list = calloc(selection->count, sizeof *request->list);
    if (request->links == NULL || request->jobs == NULL || request->list == NULL) {
        fputs("muster id: not enough memory\n", stderr);
        return STATUS_FAILED;
    }
    if (ask_all(request) == SESSION_INTERRUPTED)
        return STATUS_FAILED;
    id_judge(request->links, selection->count, request->first, request->force);
    enum session_end given = give(request);
    bool good = tell(request);
    if (request->first != 0)
        print_robots(request);
    return good && given == SESSION_DONE ? STATUS_DONE : STATUS_FAILED;
}

int cmd_id(int argc, char **argv)
{
    static const struct argp argp = {
        option_table, parse_option, "SITE.yaml\n--first N LINK...", description, NULL, NULL, NULL};
    struct request request = {.words = calloc((size_t)argc, sizeof *request.words)};

    if (request.words == NULL || !selection_begin(&request.selection, "id", argc)) {
        free(request.words);
        return STATUS_FAILED;
    }
    argp_parse(&argp, argc, argv, 0, NULL, &request);
    int status = work(&request);
    free(request.links);
    free(request.jobs);
    free(request.list);
    free(request.words);
    selection_end(&request.selection);
    return status;
}
