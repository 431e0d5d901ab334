#include "selection.h"

#include "commands.h"
#include "fields.h"
#include "limits.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool selection_begin(struct selection *selection, const char *command, int argc)
{
    *selection = (struct selection){
        .settings = calloc((size_t)argc, sizeof *selection->settings),
    };
    if (selection->settings != NULL)
        return true;
    fprintf(stderr, "muster %s: not enough memory\n", command);
    return false;
}

error_t selection_option(struct selection *selection, int key, char *value)
{
    switch (key) {
    case SELECTION_KEY_ROBOTS: selection->robots = value; break;
    case SELECTION_KEY_SET: selection->settings[selection->setting_count++] = value; break;
    case SELECTION_KEY_QUIET: selection->quiet = true; break;
    default: return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

static bool choose(struct refusal *refusal, const struct node *node, int64_t id, void *into)
{
    struct selection *selection = into;
    const struct site *site = selection->site;

    for (size_t i = 0; i < site->robot_count; i++) {
        if (site->robots[i].id != id)
            continue;
        for (size_t k = 0; k < selection->count; k++)
            if (selection->chosen[k] == i)
                return refuse(refusal, node->place, "robot %d is named twice", (int)id);
        selection->chosen[selection->count++] = i;
        return true;
    }
    return refuse(refusal, node->place, "%s has no robot %d", selection->path, (int)id);
}

static int by_place(const void *a, const void *b)
{
    size_t first = *(const size_t *)a, second = *(const size_t *)b;

    return (first > second) - (first < second);
}

/* "1-12" is what people write of ids; set_read() would take it for a difference. */
static char *with_dots(const char *text)
{
    char *copy = malloc(2 * strlen(text) + 1), *end = copy;

    if (copy == NULL)
        return NULL;
    for (; *text != '\0'; text++) {
        if (*text == '-')
            *end++ = '.';
        *end++ = *text == '-' ? '.' : *text;
    }
    *end = '\0';
    return copy;
}

static bool choose_named(struct selection *selection, char *error, size_t room)
{
    struct refusal refusal = {error, room};
    const struct node node = {
        .kind = NODE_SCALAR,
        .place = {"--robots", false, 1, 1},
        .text = with_dots(selection->robots),
    };

    if (node.text == NULL)
        return refuse_memory(&refusal, node.place);
    bool good = set_read(&refusal, &node, 1, ROBOT_ID_MAX, choose, selection);
    free(node.text);
    qsort(selection->chosen, selection->count, sizeof *selection->chosen, by_place);
    return good;
}

static bool choose_robots(struct selection *selection, char *error, size_t room)
{
    selection->chosen = calloc(selection->site->robot_count, sizeof *selection->chosen);
    if (selection->chosen == NULL) {
        snprintf(error, room, "not enough memory");
        return false;
    }
    if (selection->robots != NULL)
        return choose_named(selection, error, room);
    for (size_t i = 0; i < selection->site->robot_count; i++)
        selection->chosen[selection->count++] = i;
    return true;
}

bool selection_open(struct selection *selection, const char *command)
{
    char error[1024];

    selection->site = site_read(selection->path, selection->settings, selection->setting_count,
                                error, sizeof error);
    if (selection->site == NULL) {
        fprintf(stderr, "%s\n", error);
        return false;
    }
    if (choose_robots(selection, error, sizeof error))
        return true;
    fprintf(stderr, "muster %s: %s\n", command, error);
    return false;
}

enum session_end selection_run(const struct selection *selection, const char *command,
                               struct job *const *jobs, bool poses)
{
    const struct session_options options = {
        .poses = poses,
        .patience = SESSION_PATIENCE_S,
        .quiet = selection->quiet,
    };
    char error[512] = "";
    enum session_end end = session_run(selection->site, selection->chosen, jobs, selection->count,
                                       &options, error, sizeof error);

    if (end == SESSION_FAILED)
        fprintf(stderr, "muster %s: %s\n", command, error);
    else if (end == SESSION_INTERRUPTED)
        fprintf(stderr, "muster %s: interrupted\n", command);
    return end;
}

int selection_status(enum session_end end)
{
    return end == SESSION_DONE ? STATUS_DONE : STATUS_FAILED;
}

void selection_end(struct selection *selection)
{
    site_free(selection->site);
    free(selection->chosen);
    free(selection->settings);
}
