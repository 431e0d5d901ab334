/* archive.h: a run that is over, read back from what it left: run.mcap and summary.json, or, in a
 * folder without a recording, trace.csv and events.csv, which know nothing of formations. */
#ifndef ARCHIVE_H
#define ARCHIVE_H

#include "history.h"

#include <jansson.h>

/* A row of events.csv. */
struct incident {
    int32_t time_ms;
    uint16_t robot; /* id, 0 = all */
    char *event, *detail;
};

struct archive {
    const char *path; /* as it was asked for */
    char *name;       /* the end of it that tells it from the others (archive_read_all) */
    bool cut;         /* its recording ends where the writer was killed */
    struct history history;
    size_t incident_count;
    struct incident *incidents; /* in the order of time */
    json_t *summary;            /* NULL: it has none */
    json_t *about;              /* what the recording says of itself, by summary.json's words */
};

/* Each path is a run's folder, or an MCAP file, and stays the caller's. NULL, and words in `error`,
 * when there is no run in one, or nothing of it can be read. */
struct archive **archive_read_all(char *const *paths, size_t count, char *error, size_t room);
void archive_free_all(struct archive **archives, size_t count);

/* The last moment of it, and of the longest of several, s. */
double archive_end(const struct archive *archive);
double archives_end(struct archive *const *archives, size_t count);

bool archive_is_folder(const char *path);

#endif
