/* figures_data.h: what the figures show of a run's files, thinned out to what a picture can. */
#ifndef FIGURES_DATA_H
#define FIGURES_DATA_H

#include <stdbool.h>
#include <stddef.h>

/* A row of trace.csv. */
struct sample {
    double x, y, error; /* m */
    bool leads, alive;
};

/* trace.csv: every n-th control tick of it, and the last. */
struct trace {
    size_t robots, ticks;
    unsigned *id;           /* of each robot */
    double *t;              /* of each tick, s */
    struct sample *samples; /* [tick * robots + robot] */
};

/* False when there is no such file, or not one row of it is good. */
bool trace_read(struct trace *trace, const char *dir);
void trace_free(struct trace *trace);

/* Something that the scenario did to the team. */
struct mark {
    double t; /* s */
    const char *word;
    unsigned robot; /* 0 = none in particular */
};

#define MARKS_MAX 64

struct marks {
    size_t count;
    struct mark mark[MARKS_MAX];
};

/* The scenario's events among those of events.csv, the first MARKS_MAX; none without the file. */
void marks_read(struct marks *marks, const char *dir);

#endif
