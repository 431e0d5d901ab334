/* record.h: what grows while a run goes on: its files trace.csv, events.csv and run.mcap, and what
 * is shown to those who look on. A program that is killed loses the last second of the files, at
 * most. */
#ifndef RECORD_H
#define RECORD_H

#include "recording.h"
#include "server.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct record;

/* Creates DIR/NAME. NULL and words in `error` when that fails. */
FILE *record_create(const char *dir, const char *name, char *error, size_t room);

/* Closes it. False when something could not be written. */
bool record_finish(FILE *file);

/* Those who look on, as scene_write() and scene_event_write() put it. The bytes are gone after the
 * call. */
struct audience {
    void *context;
    void (*scene)(void *context, int32_t time_ms, const uint8_t *fleet, size_t count);
    void (*event)(void *context, int32_t time_ms, const uint8_t *log, size_t count);
};

/* They, and run.mcap, need not know how long it is until the mission begins: to them all that was
 * long before it was at this time. */
#define AUDIENCE_BEGIN_MS (-1000)

/* Opens the run's files in `dir`, which must exist. NULL and words in `error` when one cannot
 * be written. Without `trace` there is neither trace.csv nor run.mcap. `audience` NULL: nobody. */
struct record *record_open(const char *dir, const struct recording_about *about, bool trace,
                           const struct audience *audience, char *error, size_t room);

/* Whether a scene would go anywhere. */
bool record_wants_scenes(const struct record *record);

/* The scene of a control tick, at t = 0 or later: a row per robot, and the recording's. */
void record_scene(struct record *record, const struct scene *scene);

/* One of before t = 0 or between two ticks, for the audience alone. */
void record_show(struct record *record, const struct scene *scene);

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
