/* session.h: jobs with the robots of a site, over their own links, all at once, in real time.
 *
 * When it ends, for whatever reason, no robot of it moves: nothing that makes wheels turn outlives
 * the 200 ms of MESSAGE_DRIVE. */
#ifndef SESSION_H
#define SESSION_H

#include "job.h"
#include "site.h"

struct session_options {
    bool poses;      /* opens the site's motion capture for the jobs' `seen` */
    double patience; /* s in a row in which nothing is heard of a robot; by radio, and 5 more
                        for each other robot of its adapter, which dials one at a time */
    bool quiet;      /* no progress, and nothing of jobs that are done */
};

#define SESSION_PATIENCE_S 10 /* unless somebody knows better */

enum session_end {
    SESSION_DONE,        /* every job is done */
    SESSION_INCOMPLETE,  /* some failed; each job's words say why */
    SESSION_INTERRUPTED, /* SIGINT or SIGTERM; those that were at work have failed */
    SESSION_FAILED,      /* `error` says why; nothing was begun, or waiting failed */
};

/* Runs jobs[i] with site->robots[robots[i]], until all of them have ended. Of the site only robots
 * are looked at, and mocap and tracker where poses are wanted.
 *
 * On stderr: one line for each job that ends with words, as it ends; on a terminal, below them, a
 * line with the progress of each that works. A failure is told with the robot's link. */
enum session_end session_run(const struct site *site, const size_t *robots, struct job *const *jobs,
                             size_t count, const struct session_options *options, char *error,
                             size_t room);

#endif
