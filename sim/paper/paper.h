/* paper.h: every figure of the paper that can be regenerated.
 *
 * Runs the scenarios behind the figures, judges what the paper claims of each by what comes out,
 * and writes it down three times: for readers, for programs, for the documentation. */
#ifndef PAPER_H
#define PAPER_H

#include "sim.h"

#include <stdbool.h>
#include <stddef.h>

struct paper_options {
    enum sim_robots robots; /* SIM_AVR: all but the baselines of a hundred are chips */
    const char *firmware;   /* ELF file for SIM_AVR */
    const char *scenarios;  /* folder */
    const char *out;        /* folder, made when missing */
    unsigned threads;
    int only; /* a figure's number, 0 = all */
    bool quiet;
};

/* Whether there is a figure of this number. */
bool paper_has_figure(int number);

/* Writes report.html, summary.json, paper.md and runs/ into options->out. `stop` is looked at once
 * a tick. Without SIM_DONE there is no report, and `error` says why unless it was interrupted;
 * SIM_REFUSED is a scenario or an image that is not good. */
enum sim_end paper_write(const struct paper_options *options, const volatile bool *stop,
                         char *error, size_t room);

#endif
