#include "archive.h"

#include "archive_files.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool archive_add(struct archive *archive, int32_t time_ms, uint16_t robot, const char *event,
                 const char *detail)
{
    struct incident *more =
        realloc(archive->incidents, (archive->incident_count + 1) * sizeof *archive->incidents);

    if (more == NULL)
        return false;
    archive->incidents = more;
    struct incident *incident = &more[archive->incident_count];
    *incident = (struct incident){time_ms, robot, strdup(event), strdup(detail)};
    archive->incident_count++;
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

static bool exists_in(const char *dir, const char *name)
{
    char *path = path_in(dir, name);
    bool exists = path != NULL && access(path, F_OK) == 0;

    free(path);
    return exists;
}

/* A run that was killed has none. */
static bool read_summary(struct archive *archive, char *error, size_t room)
{
    json_error_t reason;
    char *path = path_in(archive->path, "summary.json");

    if (path == NULL) {
        snprintf(error, room, "no memory");
        return false;
    }
    bool exists = access(path, F_OK) == 0;
    archive->summary = exists ? json_load_file(path, 0, &reason) : NULL;
    if (exists && archive->summary == NULL &&
        json_error_code(&reason) == json_error_numeric_overflow) {
        /* A seed that is too large for JSON's integers: better none than another one. */
        archive->summary = json_load_file(path, JSON_DECODE_INT_AS_REAL, &reason);
        json_object_del(archive->summary, "seed");
    }
    if (exists && archive->summary == NULL)
        snprintf(error, room, "%s:%d:%d: %s", path, reason.line, reason.column, reason.text);
    free(path);
    return !exists || archive->summary != NULL;
}

bool archive_is_folder(const char *path)
{
    struct stat about;

    return stat(path, &about) == 0 && S_ISDIR(about.st_mode);
}

static bool read_files(struct archive *archive, char *error, size_t room)
{
    if (access(archive->path, F_OK) != 0) {
        snprintf(error, room, "%s: %s", archive->path, strerror(errno));
        return false;
    }
    if (!archive_is_folder(archive->path))
        return archive_read_tape(archive, error, room);
    if (!read_summary(archive, error, room))
        return false;
    if (exists_in(archive->path, "run.mcap"))
        return archive_read_tape(archive, error, room);
    snprintf(error, room, "no memory");
    return archive_read_trace(archive, error, room) && archive_read_events(archive);
}

static void archive_free(struct archive *archive)
{
    if (archive == NULL)
        return;
    for (size_t i = 0; i < archive->incident_count; i++) {
        free(archive->incidents[i].event);
        free(archive->incidents[i].detail);
    }
    free(archive->incidents);
    free(archive->name);
    history_free(&archive->history);
    json_decref(archive->summary);
    json_decref(archive->about);
    free(archive);
}

static struct archive *archive_read(const char *path, char *error, size_t room)
{
    struct archive *archive = calloc(1, sizeof *archive);

    if (archive == NULL) {
        snprintf(error, room, "no memory");
        return NULL;
    }
    archive->path = path;
    if (read_files(archive, error, room))
        return archive;
    archive_free(archive);
    return NULL;
}

double archive_end(const struct archive *archive)
{
    return history_time(&archive->history, archive->history.ticks - 1);
}

double archives_end(struct archive *const *archives, size_t count)
{
    double end = 1e-3;

    for (size_t i = 0; i < count; i++)
        end = fmax(end, archive_end(archives[i]));
    return end;
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

static bool all_differ(struct archive *const *archives, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            if (strcmp(archives[i]->name, archives[j]->name) == 0)
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
static bool name_all(struct archive *const *archives, size_t count)
{
    size_t most = 1, parts = 0;

    for (size_t i = 0; i < count; i++)
        most = parts_of(archives[i]->path) > most ? parts_of(archives[i]->path) : most;
    do {
        parts++;
        for (size_t i = 0; i < count; i++) {
            free(archives[i]->name);
            archives[i]->name = tail_of(archives[i]->path, parts);
            if (archives[i]->name == NULL)
                return false;
        }
    } while (parts < most && !all_differ(archives, count));
    return true;
}

struct archive **archive_read_all(char *const *paths, size_t count, char *error, size_t room)
{
    struct archive **archives = calloc(count, sizeof *archives);

    if (archives == NULL) {
        snprintf(error, room, "no memory");
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        archives[i] = archive_read(paths[i], error, room);
        if (archives[i] == NULL) {
            archive_free_all(archives, i);
            return NULL;
        }
    }
    if (name_all(archives, count))
        return archives;
    snprintf(error, room, "no memory");
    archive_free_all(archives, count);
    return NULL;
}

void archive_free_all(struct archive **archives, size_t count)
{
    for (size_t i = 0; i < count; i++)
        archive_free(archives[i]);
    free(archives);
}
