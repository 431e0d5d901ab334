/* record.h: the files that grow while a run goes on: trace.csv and events.csv. */
#ifndef RECORD_H
#define RECORD_H

#include "metrics.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct record;

/* Creates DIR/NAME. NULL and words in `error` when that fails. */
FILE *record_create(const char *dir, const char *name, char *error, size_t room);

/* Closes it. False when something could not be written. */
bool record_finish(FILE *file);

/* Opens the run's files in `dir`, which must exist. NULL and words in `error` when one cannot
 * be written. Without `trace` there is no trace.csv. */
struct record *record_open(const char *dir, bool trace, char *error, size_t room);

/* One row per robot. */
void record_trace(struct record *record, int32_t time_ms, const struct scenario *scenario,
                  const struct sample *samples);

void record_event(struct record *record, int32_t time_ms, const struct server_report *report);

/* Something that happened outside the server core: to a link, say. `detail` may hold anything; `id`
 * 0 stands for all robots. */
void record_note(struct record *record, int32_t time_ms, uint16_t id, const char *event,
                 const char *detail);

/* Hands what has been recorded to the system, so that a crash of this program loses none of it. */
void record_flush(struct record *record);

/* Flushes and closes. False and words in `error` when anything could not be written. */
bool record_close(struct record *record, char *error, size_t room);

#endif
