/* archive_files.h: the files of a run, one by one, for archive.c. */
#ifndef ARCHIVE_FILES_H
#define ARCHIVE_FILES_H

#include "archive.h"

/* The history, from trace.csv in the folder `archive->path`; what follows a row that is none is
 * left out. False, and words in `error`, when there is not one good row. */
bool archive_read_trace(struct archive *archive, char *error, size_t room);

/* The incidents, from events.csv; none when it is missing. False when there is no memory. */
bool archive_read_events(struct archive *archive);

/* Both, from the recording. */
bool archive_read_tape(struct archive *archive, char *error, size_t room);

/* Adds an incident; the words are copied. False when there is no memory. */
bool archive_add(struct archive *archive, int32_t time_ms, uint16_t robot, const char *event,
                 const char *detail);

#endif
