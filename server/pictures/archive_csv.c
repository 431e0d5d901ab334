/* archive_csv.c: trace.csv and events.csv, where there is no recording. */
#include "archive_files.h"

#include "message.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINE_MAX_BYTES 1100 /* an event's detail is the longest thing in them */
#define TICKS_FIRST 1024

static FILE *open_in(const char *dir, const char *name)
{
    size_t length = strlen(dir) + strlen(name) + 2;
    char *path = malloc(length);

    if (path == NULL)
        return NULL;
    snprintf(path, length, "%s/%s", dir, name);
    FILE *file = fopen(path, "r");
    free(path);
    return file;
}

static int32_t ms_of(double seconds)
{
    return (int32_t)lround(seconds * 1000);
}

/* ---- trace.csv ------------------------------------------------------------------------- */

struct row {
    double t;
    unsigned id;
    struct glimpse glimpse;
};

static bool role_of(char letter, uint8_t *role)
{
    *role = letter == 'L' ? ROLE_LEADER : letter == 'C' ? ROLE_CANDIDATE : ROLE_FOLLOWER;
    return letter == 'L' || letter == 'C' || letter == 'F';
}

static bool next_row(FILE *file, struct row *row)
{
    struct glimpse *g = &row->glimpse;
    char line[LINE_MAX_BYTES], letter, end;
    unsigned vertex;
    int alive;

    if (fgets(line, sizeof line, file) == NULL ||
        sscanf(line, "%lf,%u,%f,%f,%f,%*f,%f,%c,%u,%f,%d%c", &row->t, &row->id, &g->x, &g->y,
               &g->theta, &g->omega, &letter, &vertex, &g->error, &alive, &end) != 11)
        return false;
    g->vertex = (uint16_t)vertex;
    g->alive = alive != 0;
    return end == '\n' && role_of(letter, &g->role) && isfinite(g->x) && isfinite(g->y) &&
           isfinite(g->theta) && isfinite(g->error);
}

/* How many rows the first tick has. */
static size_t count_robots(FILE *file)
{
    struct row row;
    double first = 0;
    size_t count = 0;

    for (; next_row(file, &row) && (count == 0 || row.t == first); count++)
        first = row.t;
    return count;
}

static bool skip_head(FILE *file)
{
    char line[LINE_MAX_BYTES];

    rewind(file);
    return fgets(line, sizeof line, file) != NULL;
}

/* One tick. False at the end, and where a row is missing or none. */
static bool read_tick(struct history *history, FILE *file)
{
    struct glimpse *glimpses = history_add(history);
    struct row row = {0};

    if (glimpses == NULL)
        return false;
    for (size_t i = 0; i < history->robots; i++) {
        if (!next_row(file, &row)) {
            history->ticks--;
            return false;
        }
        history->id[i] = (uint16_t)row.id;
        glimpses[i] = row.glimpse;
    }
    history->moments[history->ticks - 1] = (struct moment){.time_ms = ms_of(row.t)};
    return true;
}

static bool read_rows(struct history *history, FILE *file)
{
    size_t robots = skip_head(file) ? count_robots(file) : 0;

    if (robots == 0 || !history_begin(history, robots, TICKS_FIRST) ||
        history_add_shape(history, "", 0) == NULL)
        return false;
    skip_head(file);
    while (read_tick(history, file))
        continue;
    return history->ticks > 0;
}

bool archive_read_trace(struct archive *archive, char *error, size_t room)
{
    FILE *file = open_in(archive->path, "trace.csv");

    if (file == NULL) {
        snprintf(error, room,
                 "%s: no run is in it, neither run.mcap nor trace.csv; `muster sim' "
                 "makes one",
                 archive->path);
        return false;
    }
    bool good = read_rows(&archive->history, file);
    fclose(file);
    if (!good)
        snprintf(error, room, "%s/trace.csv: not one good row is in it", archive->path);
    return good;
}

/* ---- events.csv ------------------------------------------------------------------------ */

static bool read_event(struct archive *archive, char *line)
{
    char event[64], detail[LINE_MAX_BYTES] = "";
    double t;
    unsigned robot;

    line[strcspn(line, "\n")] = '\0';
    if (sscanf(line, "%lf,%u,%63[^,],%1099[^\n]", &t, &robot, event, detail) < 3)
        return true;
    return archive_add(archive, ms_of(t), (uint16_t)robot, event, detail);
}

bool archive_read_events(struct archive *archive)
{
    FILE *file = open_in(archive->path, "events.csv");
    char line[LINE_MAX_BYTES];
    bool good = true;

    if (file == NULL)
        return true;
    while (good && fgets(line, sizeof line, file) != NULL)
        good = read_event(archive, line);
    fclose(file);
    return good;
}
