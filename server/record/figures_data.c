#include "figures_data.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define POINTS_MAX 40000 /* of all robots in a figure: beyond it gnuplot takes seconds */
#define TICKS_MIN 20
#define TICKS_MAX 1500

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

/* The fields of a line that the figures want: t, robot, x, y, role, distance_error, alive. */
static bool parse_row(const char *line, double *t, unsigned *id, struct sample *sample)
{
    char role;
    int alive;

    if (sscanf(line, "%lf,%u,%lf,%lf,%*f,%*f,%*f,%c,%*u,%lf,%d", t, id, &sample->x, &sample->y,
               &role, &sample->error, &alive) != 7)
        return false;
    sample->leads = role == 'L';
    sample->alive = alive != 0;
    return true;
}

/* How many rows there are, and how many of them the first control tick has. */
static void count_rows(FILE *file, size_t *rows, size_t *robots)
{
    char line[256];
    double t, first = 0;
    unsigned id;
    struct sample sample;

    *rows = *robots = 0;
    for (; fgets(line, sizeof line, file) != NULL; ++*rows) {
        if (*rows != *robots)
            continue;
        if (!parse_row(line, &t, &id, &sample))
            return;
        if (*rows == 0)
            first = t;
        *robots += t == first;
    }
}

static bool skip_line(FILE *file)
{
    char line[256];

    return fgets(line, sizeof line, file) != NULL;
}

static size_t ticks_wanted(size_t robots)
{
    size_t ticks = POINTS_MAX / robots;

    return ticks < TICKS_MIN ? TICKS_MIN : ticks > TICKS_MAX ? TICKS_MAX : ticks;
}

static bool make_room(struct trace *trace, size_t ticks)
{
    trace->id = calloc(trace->robots, sizeof *trace->id);
    trace->t = calloc(ticks, sizeof *trace->t);
    trace->samples = calloc(ticks * trace->robots, sizeof *trace->samples);
    return trace->id != NULL && trace->t != NULL && trace->samples != NULL;
}

static bool read_tick(struct trace *trace, FILE *file)
{
    struct sample *samples = &trace->samples[trace->ticks * trace->robots];
    char line[256];

    for (size_t i = 0; i < trace->robots; i++) {
        if (fgets(line, sizeof line, file) == NULL ||
            !parse_row(line, &trace->t[trace->ticks], &trace->id[i], &samples[i]))
            return false;
    }
    trace->ticks++;
    return true;
}

static bool skip_tick(const struct trace *trace, FILE *file)
{
    for (size_t i = 0; i < trace->robots; i++) {
        if (!skip_line(file))
            return false;
    }
    return true;
}

static bool read_file(struct trace *trace, FILE *file)
{
    size_t rows;

    skip_line(file); /* the header */
    count_rows(file, &rows, &trace->robots);
    if (trace->robots == 0)
        return false;

    size_t ticks = rows / trace->robots;
    size_t stride = ticks / ticks_wanted(trace->robots) + 1;
    if (!make_room(trace, ticks / stride + 2))
        return false;
    rewind(file);
    skip_line(file);
    for (size_t tick = 0; tick < ticks; tick++) {
        bool wanted = tick % stride == 0 || tick + 1 == ticks;
        if (!(wanted ? read_tick(trace, file) : skip_tick(trace, file)))
            break;
    }
    return trace->ticks > 0;
}

bool trace_read(struct trace *trace, const char *dir)
{
    FILE *file = open_in(dir, "trace.csv");

    *trace = (struct trace){0, 0, NULL, NULL, NULL};
    if (file == NULL)
        return false;
    bool good = read_file(trace, file);
    fclose(file);
    if (!good)
        trace_free(trace);
    return good;
}

void trace_free(struct trace *trace)
{
    free(trace->id);
    free(trace->t);
    free(trace->samples);
    *trace = (struct trace){0, 0, NULL, NULL, NULL};
}

/* The word as the figures have it, NULL when it is no event of a scenario. */
static const char *find_word(const char *word)
{
    static const char *const words[] = {
        "kill", "revive", "stall", "mute",  "unmute",    "formation",
        "loss", "delay",  "range", "estop", "partition", "heal",
    };

    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        if (strcmp(word, words[i]) == 0)
            return words[i];
    }
    return NULL;
}

void marks_read(struct marks *marks, const char *dir)
{
    FILE *file = open_in(dir, "events.csv");
    char line[256], word[32];

    marks->count = 0;
    if (file == NULL)
        return;
    while (marks->count < MARKS_MAX && fgets(line, sizeof line, file) != NULL) {
        struct mark *mark = &marks->mark[marks->count];
        if (sscanf(line, "%lf,%u,%31[a-z_]", &mark->t, &mark->robot, word) != 3)
            continue;
        mark->word = find_word(word);
        marks->count += mark->word != NULL;
    }
    fclose(file);
}
