/* laws.h: three motion laws, made comparable. */
#ifndef PAPER_LAWS_H
#define PAPER_LAWS_H

#include "runs.h"

/* A robot has settled when its distance error stays within this, m. */
#define LAW_SETTLED 0.05

/* Finds gains for kanayama and pid with which they settle on the straight task as soon as fl does
 * with its own, k = 1 and k_theta = 3, and puts them into the runs of figure 1. Both gains are
 * scaled alike, so k_theta = 3 k and a law keeps its damping; the smallest such gains count. Tries
 * on native robots. */
enum sim_end laws_match(struct runs *runs, const struct paper_options *options,
                        const volatile bool *stop, char *error, size_t room);

/* What a law made of a task. */
struct law_result {
    double settling; /* s, INFINITY when it never does */
    double path;     /* m */
    double peak;     /* of |omega|, rad/s */
    double turning;  /* integral of omega^2, rad^2/s */
};

struct law_result law_result_of(const struct run *run);

#endif
