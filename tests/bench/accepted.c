#include "accepted.h"

#include "results.h"

#include <err.h>
#include <stdlib.h>
#include <string.h>

#define TOLERANCE 1.02

#define ENTRIES_MAX 100

struct entry {
    char name[64];
    double value;
};

struct record {
    size_t count;
    struct entry entry[ENTRIES_MAX];
};

static void read_record(const char *path, struct record *record)
{
    FILE *file = fopen(path, "r");
    struct entry entry;
    int fields;

    if (file == NULL)
        err(EXIT_FAILURE, "%s", path);
    while (record->count < ENTRIES_MAX &&
           (fields = fscanf(file, "%63s %lf", entry.name, &entry.value)) == 2)
        record->entry[record->count++] = entry;
    if (fields != EOF)
        errx(EXIT_FAILURE, "%s:%zu: not a figure's name and value", path, record->count + 1);
    fclose(file);
}

static const struct entry *find(const struct record *record, const char *name)
{
    for (size_t i = 0; i < record->count; i++)
        if (strcmp(record->entry[i].name, name) == 0)
            return &record->entry[i];
    return NULL;
}

static bool holds(const struct figure *figure, const struct entry *accepted)
{
    if (accepted == NULL) {
        warnx("%s has no record", figure->name);
        return false;
    }
    if (figure->value <= accepted->value * TOLERANCE)
        return true;
    warnx("%s was %g %s, is %g: %.1f %% worse", figure->name, accepted->value, figure->unit,
          figure->value, 100 * (figure->value / accepted->value - 1));
    return false;
}

static bool is_exact_figure(const char *name)
{
    for (size_t i = 0; i < figure_count; i++)
        if (!figures[i].of_host && strcmp(figures[i].name, name) == 0)
            return true;
    warnx("%s is in the record and not measured", name);
    return false;
}

bool accepted_check(const char *path)
{
    struct record record = {0};
    bool good = true;

    read_record(path, &record);
    for (size_t i = 0; i < figure_count; i++)
        if (!figures[i].of_host)
            good &= holds(&figures[i], find(&record, figures[i].name));
    for (size_t i = 0; i < record.count; i++)
        good &= is_exact_figure(record.entry[i].name);
    if (!good)
        warnx("if that is meant: make bench-record");
    return good;
}

void accepted_write(const char *path)
{
    FILE *file = fopen(path, "w");

    if (file == NULL)
        err(EXIT_FAILURE, "%s", path);
    for (size_t i = 0; i < figure_count; i++)
        if (!figures[i].of_host)
            fprintf(file, "%-28s %.*f\n", figures[i].name, figure_decimals(figures[i].value),
                    figures[i].value);
    if (fclose(file) != 0)
        err(EXIT_FAILURE, "%s", path);
}
