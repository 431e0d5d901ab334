/* record.h: the files of a run: trace.csv, events.csv, summary.json. */
#ifndef RECORD_H
#define RECORD_H

#include "metrics.h"
#include "robot.h"

#include <stdio.h>

struct record;

/* Opens the run's files in `dir`, which must exist. NULL and words in `error` when one cannot
 * be written. Without `trace` there is no trace.csv. */
struct record *record_open(const char *dir, bool trace, char *error, size_t room);

/* One row per robot. */
void record_trace(struct record *record, int32_t time_ms, const struct scenario *scenario,
                  const struct sample *samples);

void record_event(struct record *record, int32_t time_ms, const struct server_report *report);

/* Flushes and closes. False and words in `error` when anything could not be written. */
bool record_close(struct record *record, char *error, size_t room);

/* Everything that summary.json says. */
struct summary {
    const struct scenario *scenario;
    uint64_t seed;
    bool avr;
    double duration, wall; /* s */
    struct metrics_result metrics;
    struct server_counters link;
    double load_max_pct;   /* of the busiest processor */
    uint32_t tick_cycles_max;
    uint16_t stack_free_min;
};

/* Writes DIR/summary.json. False and words in `error` when that fails. */
bool summary_write(const struct summary *summary, const char *dir, char *error, size_t room);

/* The same for a person to read. */
void summary_print(const struct summary *summary, const char *dir, FILE *out);

#endif
