/* summary.h: what came out of a run: summary.json, and the same for a person to read. */
#ifndef SUMMARY_H
#define SUMMARY_H

#include "metrics.h"

#include <stdio.h>

/* Everything that summary.json says. */
struct summary {
    const struct scenario *scenario;
    uint64_t seed;
    bool avr;
    double duration; /* mission time, s */
    double wall;     /* from the robots' power-on to the last tick, s */
    struct metrics_result metrics;
    struct server_counters link;
    double load_max_pct; /* of the busiest processor */
    uint32_t tick_cycles_max;
    uint16_t stack_free_min;
};

/* Writes DIR/summary.json. False and words in `error` when that fails. */
bool summary_write(const struct summary *summary, const char *dir, char *error, size_t room);

/* The same for a person to read. */
void summary_print(const struct summary *summary, const char *dir, FILE *out);

#endif
