#include "past.h"

#include "past_files.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool past_add(struct past *past, int32_t time_ms, uint16_t robot, const char *event,
              const char *detail)
{
    struct incident *more =
        realloc(past->incidents, (past->incident_count + 1) * sizeof *past->incidents);

    if (more == NULL)
        return false;
    past->incidents = more;
    struct incident *incident = &more[past->incident_count];
    *incident = (struct incident){time_ms, robot, strdup(event), strdup(detail)};
    past->incident_count++;
    return incident->event != NULL && incident->detail != NULL;
}

/* ---- reading --------------------------------------------------------------------------- */

static char *path_in(const char *dir, const char *name)
{
    size_t length = strlen(dir) + strlen(name) + 2;
    char *path = malloc(length);

    if (path != NULL)
        snprintf(path, length, "%s/%s", dir, name);
    return path;
}

/* A run that was killed has none. */
static bool read_summary(struct past *past, char *error, size_t room)
{
    json_error_t reason;
    char *path = path_in(past->path, "summary.json");

    if (path == NULL) {
        snprintf(error, room, "no memory");
        return false;
    }
    bool exists = access(path, F_OK) == 0;
    past->summary = exists ? json_load_file(path, JSON_REJECT_DUPLICATES, &reason) : NULL;
    if (exists && past->summary == NULL)
        snprintf(error, room, "%s:%d:%d: %s", path, reason.line, reason.column, reason.text);
    free(path);
    return !exists || past->summary != NULL;
}

static bool read_files(struct past *past, char *error, size_t room)
{
    struct stat about;

    if (stat(past->path, &about) != 0) {
        snprintf(error, room, "%s: %s", past->path, strerror(errno));
        return false;
    }
    if (!read_summary(past, error, room))
        return false;
    snprintf(error, room, "no memory");
    return past_read_trace(past, error, room) && past_read_events(past);
}

static void past_free(struct past *past)
{
    if (past == NULL)
        return;
    for (size_t i = 0; i < past->incident_count; i++) {
        free(past->incidents[i].event);
        free(past->incidents[i].detail);
    }
    free(past->incidents);
    free(past->name);
    history_free(&past->history);
    json_decref(past->summary);
    free(past);
}

static struct past *past_read(const char *path, char *error, size_t room)
{
    struct past *past = calloc(1, sizeof *past);

    if (past == NULL) {
        snprintf(error, room, "no memory");
        return NULL;
    }
    past->path = path;
    if (read_files(past, error, room))
        return past;
    past_free(past);
    return NULL;
}

double past_end(const struct past *past)
{
    return history_time(&past->history, past->history.ticks - 1);
}

/* ---- names ----------------------------------------------------------------------------- */

/* The last `parts` parts of a path, to be freed. NULL when there is no memory. */
static char *tail_of(const char *path, size_t parts)
{
    const char *end = path + strlen(path);

    while (end > path + 1 && end[-1] == '/')
        end--;
    const char *at = end;
    while (at > path && (at[-1] != '/' || at == end || --parts > 0))
        at--;
    return strndup(at, (size_t)(end - at));
}

static bool all_differ(struct past *const *pasts, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            if (strcmp(pasts[i]->name, pasts[j]->name) == 0)
                return false;
    return true;
}

static size_t parts_of(const char *path)
{
    size_t parts = 1;

    for (; *path != '\0'; path++)
        parts += *path == '/';
    return parts;
}

/* By as much of the ends of their paths as makes them different. */
static bool name_all(struct past *const *pasts, size_t count)
{
    size_t most = 1, parts = 0;

    for (size_t i = 0; i < count; i++)
        most = parts_of(pasts[i]->path) > most ? parts_of(pasts[i]->path) : most;
    do {
        parts++;
        for (size_t i = 0; i < count; i++) {
            free(pasts[i]->name);
            pasts[i]->name = tail_of(pasts[i]->path, parts);
            if (pasts[i]->name == NULL)
                return false;
        }
    } while (parts < most && !all_differ(pasts, count));
    return true;
}

struct past **past_read_all(char *const *paths, size_t count, char *error, size_t room)
{
    struct past **pasts = calloc(count, sizeof *pasts);

    if (pasts == NULL) {
        snprintf(error, room, "no memory");
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        pasts[i] = past_read(paths[i], error, room);
        if (pasts[i] == NULL) {
            past_free_all(pasts, i);
            return NULL;
        }
    }
    if (name_all(pasts, count))
        return pasts;
    snprintf(error, room, "no memory");
    past_free_all(pasts, count);
    return NULL;
}

void past_free_all(struct past **pasts, size_t count)
{
    for (size_t i = 0; i < count; i++)
        past_free(pasts[i]);
    free(pasts);
}
