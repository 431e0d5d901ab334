/* summary.h: what came out of a run: summary.json, and the same for a person to read. */
#ifndef SUMMARY_H
#define SUMMARY_H

#include "metrics.h"

#include <stdio.h>

/* What only a run in real time has. The delay is that from a pose's arrival in the kernel to the
 * moment when the last robot's bytes were written. */
struct live_summary {
    double delay_p50_us, delay_p99_us, delay_max_us;
    uint64_t frames, skipped; /* of motion capture; skipped: a newer one was there already */
    uint32_t links_lost;
    const char *end; /* why it ended, in words */
};

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
    const struct live_summary *live; /* of real robots; NULL: simulated ones */
};

/* Writes DIR/summary.json. False and words in `error` when that fails. */
bool summary_write(const struct summary *summary, const char *dir, char *error, size_t room);

/* The same for a person to read. */
void summary_print(const struct summary *summary, const char *dir, FILE *out);

#endif
