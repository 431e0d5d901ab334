#include "commands.h"
#include "param_table.h"
#include "parameter_file.h"
#include "selection.h"
#include "text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum action { ACTION_LIST, ACTION_GET, ACTION_SET, ACTION_SAVE, ACTION_RESET, ACTION_NONE };

static const char *const actions[] = {"list", "get", "set", "save", "reset", NULL};

/* What the command line says. */
struct request {
    struct selection selection;
    enum action action;
    struct param_plan plan;
    const char *from, *out;
    bool save;
    bool all; /* parameters are to be read */
};

enum { KEY_FROM = 256, KEY_OUT, KEY_SAVE };

static const struct argp_option option_table[] = {
    {"from", KEY_FROM, "FILE", 0, "set: the values that a parameter file has for each robot", 0},
    {"out", KEY_OUT, "FILE", 0, "get: write the stored parameters that were read to such a file",
     0},
    {"save", KEY_SAVE, NULL, 0, "set, reset: keep the new values over a power cycle", 0},
    SELECTION_OPTIONS,
    {0},
};

static const char description[] =
    "Read and change the parameters of robots, over their links, all robots at once."
    "\v"
    "  muster param list                     what parameters there are\n"
    "  muster param list SITE.yaml           what they are in every robot\n"
    "  muster param get SITE.yaml NAME...    the same of some\n"
    "  muster param set SITE.yaml NAME=VALUE...\n"
    "  muster param save SITE.yaml           so that it outlives a power cycle\n"
    "  muster param reset SITE.yaml          all but the id to the defaults\n\n"
    "What is set is in force at once. A robot that is on a mission is halted.\n\n"
    "Exit status: 0 done with every robot, 1 some failed (it is told which, and why), 2 wrong "
    "usage or a file that is refused.";

/* ---- the command line ------------------------------------------------------------------ */

static void read_action(struct argp_state *state, const char *word)
{
    struct request *request = state->input;

    for (request->action = 0; actions[request->action] != NULL; request->action++)
        if (strcmp(word, actions[request->action]) == 0)
            return;
    const char *nearest = text_nearest(word, actions);
    argp_error(state, "%s: list, get, set, save or reset is allowed%s%s", word,
               nearest != NULL ? "; perhaps " : "", nearest != NULL ? nearest : "");
}

static uint8_t read_name(struct argp_state *state, const char *name)
{
    char words[256];
    uint8_t index = 0;

    if (!parameter_find(name, &index, words, sizeof words))
        argp_error(state, "%s", words);
    return index;
}

static void read_assignment(struct argp_state *state, char *text)
{
    struct param_plan *plan = &((struct request *)state->input)->plan;
    char *equals = strchr(text, '=');
    char words[256];

    if (equals == NULL)
        argp_error(state, "%s: NAME=VALUE is allowed", text);
    *equals = '\0';
    uint8_t index = read_name(state, text);
    uint16_t value = 0;
    if (!parameter_value(index, equals + 1, &value, words, sizeof words))
        argp_error(state, "%s", words);
    if (plan->set & param_bit(index))
        argp_error(state, "%s is set twice", text);
    plan->set |= param_bit(index);
    plan->value[index] = value;
}

static void read_argument(struct argp_state *state, char *text)
{
    struct request *request = state->input;

    if (request->action == ACTION_NONE)
        read_action(state, text);
    else if (request->selection.path == NULL)
        request->selection.path = text;
    else if (request->action == ACTION_GET)
        request->plan.read |= param_bit(read_name(state, text));
    else if (request->action == ACTION_SET)
        read_assignment(state, text);
    else
        argp_error(state, "%s: %s takes a site and nothing else", text, actions[request->action]);
}

static void judge(struct argp_state *state)
{
    const struct request *request = state->input;
    bool sets = request->action == ACTION_SET;

    if (request->action == ACTION_NONE)
        argp_error(state, "list, get, set, save or reset?");
    if (request->selection.path == NULL && request->action != ACTION_LIST)
        argp_error(state, "which site?");
    if (sets && request->plan.set == 0 && request->from == NULL)
        argp_error(state, "set what? NAME=VALUE or --from FILE");
    if (request->from != NULL && !sets)
        argp_error(state, "--from goes with set");
    if (request->out != NULL && request->action != ACTION_GET)
        argp_error(state, "--out goes with get");
    if (request->save && !sets && request->action != ACTION_RESET)
        argp_error(state, "--save goes with set and reset");
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    struct request *request = state->input;

    switch (key) {
    case KEY_FROM: request->from = value; break;
    case KEY_OUT: request->out = value; break;
    case KEY_SAVE: request->save = true; break;
    case ARGP_KEY_ARG: read_argument(state, value); break;
    case ARGP_KEY_END: judge(state); break;
    default: return selection_option(&request->selection, key, value);
    }
    return 0;
}

/* ---- the parameter file ---------------------------------------------------------------- */

/* Every value of the file's, but what the command line sets. */
static void add_entry(struct param_plan *plan, const struct parameter_entry *entry)
{
    for (uint8_t i = 0; i < PARAMETERS_STORED_COUNT; i++) {
        if (i == PARAMETER_ID || (entry->given >> i & 1) == 0 || plan->set & param_bit(i))
            continue;
        plan->set |= param_bit(i);
        plan->value[i] = entry->parameters.value[i];
    }
}

static bool write_file(const struct request *request, const struct param_job *jobs)
{
    struct parameter_entry *entries = calloc(request->selection.count, sizeof *entries);
    char error[512] = "not enough memory";
    size_t count = 0;

    for (size_t i = 0; entries != NULL && i < request->selection.count; i++) {
        struct parameter_entry *entry = &entries[count];

        if (jobs[i].job.state != JOB_DONE)
            continue;
        count++;
        parameters_default(&entry->parameters);
        for (uint8_t k = 0; k < PARAMETERS_STORED_COUNT; k++) {
            if (!jobs[i].before[k].known)
                continue;
            entry->given |= 1u << k;
            entry->parameters.value[k] = (uint16_t)jobs[i].before[k].value;
        }
        entry->given |= 1u << PARAMETER_ID;
        entry->parameters.value[PARAMETER_ID] = jobs[i].job.robot;
    }
    bool good =
        entries != NULL && parameter_file_write(request->out, entries, count, error, sizeof error);
    free(entries);
    if (!good)
        fprintf(stderr, "muster param: %s\n", error);
    return good;
}

/* ---- the work -------------------------------------------------------------------------- */

/* What else is read or done for the sake of an action. */
static void complete_plan(struct request *request)
{
    struct param_plan *plan = &request->plan;

    request->all =
        request->action == ACTION_LIST || (request->action == ACTION_GET && plan->read == 0);
    if (request->all)
        plan->read = PARAM_ALL & ~param_bit(PARAMETER_ID); /* it is every line's head */
    plan->reset = request->action == ACTION_RESET;
    plan->save = request->save || request->action == ACTION_SAVE;
}

static bool prepare(struct request *request, struct param_job *jobs)
{
    const struct selection *selection = &request->selection;
    struct parameter_file *file = NULL;
    char error[1024];
    bool good = true;

    if (request->from != NULL &&
        (file = parameter_file_read(request->from, error, sizeof error)) == NULL) {
        fprintf(stderr, "%s\n", error);
        return false;
    }
    for (size_t i = 0; i < selection->count && good; i++) {
        uint16_t id = selection->site->robots[selection->chosen[i]].id;
        const struct parameter_entry *entry = file != NULL ? parameter_file_find(file, id) : NULL;
        struct param_plan plan = request->plan;

        plan.read |= param_bit(PARAMETER_UNSAVED);
        if (entry != NULL)
            add_entry(&plan, entry);
        good = file == NULL || entry != NULL;
        if (!good)
            fprintf(stderr, "muster param: %s has no robot %u; --robots leaves it out\n",
                    request->from, id);
        param_begin(&jobs[i], id, &plan);
    }
    parameter_file_free(file);
    return good;
}

static void tell_unsaved(const struct param_job *jobs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (jobs[i].job.state != JOB_DONE || jobs[i].after[param_row(PARAMETER_UNSAVED)].value == 0)
            continue;
        fprintf(stderr, "Not saved yet: `muster param save' or --save keeps it over a power "
                        "cycle.\n");
        return;
    }
}

static void tell_saved(const struct param_job *jobs, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (jobs[i].job.state == JOB_DONE)
            printf("robot %u: %s\n", jobs[i].job.robot,
                   jobs[i].before[param_row(PARAMETER_UNSAVED)].value == 0 ? "was saved already"
                                                                           : "saved");
}

static int tell(const struct request *request, const struct param_job *jobs, int status)
{
    size_t count = request->selection.count;

    switch (request->action) {
    case ACTION_LIST: param_table_print(stdout, jobs, count, request->plan.read, true); break;
    case ACTION_GET:
        param_table_print(stdout, jobs, count, request->plan.read, request->plan.read == PARAM_ALL);
        if (request->out != NULL && !write_file(request, jobs))
            status = STATUS_FAILED;
        break;
    case ACTION_SET:
    case ACTION_RESET:
        param_table_print_changes(stdout, jobs, count);
        if (!request->selection.quiet)
            tell_unsaved(jobs, count);
        break;
    case ACTION_SAVE: tell_saved(jobs, count); break;
    case ACTION_NONE: break;
    }
    return status;
}

static int run(struct request *request)
{
    size_t count = request->selection.count;
    struct param_job *jobs = calloc(count, sizeof *jobs);
    struct job **list = calloc(count, sizeof *list);
    int status = STATUS_FAILED;

    if (jobs == NULL || list == NULL) {
        fputs("muster param: not enough memory\n", stderr);
    } else if (!prepare(request, jobs)) {
        status = STATUS_USAGE;
    } else {
        for (size_t i = 0; i < count; i++)
            list[i] = &jobs[i].job;
        enum session_end end = selection_run(&request->selection, "param", list, false);
        status = tell(request, jobs, selection_status(end));
    }
    free(list);
    free(jobs);
    return status;
}

static int work(struct request *request)
{
    bool one_id = request->plan.set & param_bit(PARAMETER_ID);

    if (request->selection.path == NULL) {
        param_table_print_all(stdout);
        return STATUS_DONE;
    }
    if (!selection_open(&request->selection, "param"))
        return STATUS_USAGE;
    if (one_id && request->selection.count > 1) {
        fprintf(stderr,
                "muster param: one id for %zu robots: each has its own (`muster id' gives them)\n",
                request->selection.count);
        return STATUS_USAGE;
    }
    complete_plan(request);
    return run(request);
}

int cmd_param(int argc, char **argv)
{
    static const struct argp argp = {
        option_table, parse_option, "ACTION [SITE.yaml [NAME[=VALUE]...]]", description, NULL,
        NULL,         NULL};
    struct request request = {.action = ACTION_NONE};

    if (!selection_begin(&request.selection, "param", argc))
        return STATUS_FAILED;
    argp_parse(&argp, argc, argv, 0, NULL, &request);
    int status = work(&request);
    selection_end(&request.selection);
    return status;
}
