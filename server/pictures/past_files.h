/* past_files.h: the files of a run, one by one, for past.c. */
#ifndef PAST_FILES_H
#define PAST_FILES_H

#include "past.h"

/* The history, from trace.csv in the folder `past->path`; what follows a row that is none is left
 * out. False, and words in `error`, when there is not one good row. */
bool past_read_trace(struct past *past, char *error, size_t room);

/* The incidents, from events.csv; none when it is missing. False when there is no memory. */
bool past_read_events(struct past *past);

/* Both, from the recording. */
bool past_read_tape(struct past *past, char *error, size_t room);

/* Adds an incident; the words are copied. False when there is no memory. */
bool past_add(struct past *past, int32_t time_ms, uint16_t robot, const char *event,
              const char *detail);

#endif
