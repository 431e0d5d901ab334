/* results.h: the figures of a run of the benchmarks. */
#ifndef RESULTS_H
#define RESULTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#define BASELINES_MAX 2

struct baseline {
    const char *name; /* NULL: none */
    double value;
};

struct figure {
    const char *name, *unit;
    double goal;  /* NAN: none */
    bool of_host; /* differs from machine to machine; all others are exact, and less is better */
    bool more_is_better;
    bool known;
    double value;
    struct baseline baseline[BASELINES_MAX];
};

/* Every figure there is, in the order of the table. */
extern struct figure figures[];
extern const size_t figure_count;

/* A name that is not among them ends the program. */
struct figure *figure_of(const char *name);
void figure_set(const char *name, double value);

/* Sets the figure, or raises it to `value`. */
void figure_worst(const char *name, double value);
void figure_worst_baseline(const char *name, const char *baseline, double value);

/* How many decimals a value is told with. */
int figure_decimals(double value);

/* For people and for programs. */
void results_print(FILE *out);
void results_write_json(FILE *out);

#endif
