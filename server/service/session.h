/* session.h: jobs with the robots of a site, over their own links, all at once, in real time.
 *
 * When it ends, for whatever reason, no robot of it moves: nothing that makes wheels turn outlives
 * the 200 ms of MESSAGE_DRIVE. */
#ifndef SESSION_H
#define SESSION_H

#include "job.h"
#include "site.h"

struct session_options {
    const char *command; /* for words and progress */
    bool poses;          /* opens the site's motion capture for the jobs' `seen` */
    double patience;     /* s for a robot whose link does not come up, or comes and goes */
    bool quiet;          /* no progress */
};

enum session_end {
    SESSION_DONE,        /* every job is done */
    SESSION_INCOMPLETE,  /* some failed; each job's words say why */
    SESSION_INTERRUPTED, /* SIGINT or SIGTERM */
    SESSION_FAILED,      /* `error` says why */
};

/* Runs jobs[i] with site->robots[robots[i]], until all of them have ended. Shows the progress of
 * each on a terminal. */
enum session_end session_run(const struct site *site, const size_t *robots, struct job *const *jobs,
                             size_t count, const struct session_options *options, char *error,
                             size_t room);

#endif
