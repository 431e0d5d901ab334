/* sights.h: where the site's motion capture sees the site's robots, in real time. */
#ifndef SIGHTS_H
#define SIGHTS_H

#include "job.h"
#include "site.h"

struct sights_owner {
    void *context;
    /* A robot's pose, by its place among the site's. */
    void (*seen)(void *context, size_t robot, const struct job_pose *pose);
    /* How motion capture stands. */
    void (*say)(void *context, const char *words);
};

struct sights;

/* NULL, and words in `error`, when the site's settings make no sense or memory is short. Site and
 * owner must outlive it. */
struct sights *sights_open(struct loop *loop, const struct site *site,
                           const struct sights_owner *owner, char *error, size_t room);

/* At least ten times a second. */
void sights_tick(struct sights *sights, int64_t now_us);

void sights_close(struct sights *sights);

#endif
