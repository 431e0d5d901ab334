/* session.h: jobs with the robots of a site, over their own links, all at once, in real time.
 *
 * When it ends, for whatever reason, no robot of it moves: nothing that makes wheels turn outlives
 * the 200 ms of MESSAGE_DRIVE. */
#ifndef SESSION_H
#define SESSION_H

#include "job.h"
#include "site.h"

/* What else a command is told of; each may be NULL. */
struct session_watcher {
    void *context;
    /* Where each of the site's robots is seen, also those that have no job. */
    void (*seen)(void *context, size_t robot, const struct job_pose *pose);
    /* The session is to end within two seconds: jobs are to put right what must not stay. Those
     * that have not ended by then fail. Without it they fail at once. */
    void (*stop)(void *context, const char *words, int64_t now_us);
    /* stdin has something to be read; false when it is to be left alone from now on. */
    bool (*typed)(void *context, int64_t now_us);
};

struct session_options {
    bool poses;      /* opens the site's motion capture for the jobs' `seen` */
    double patience; /* s in a row in which nothing is heard of a robot; by radio, and 5 more
                        for each other robot of its adapter, which dials one at a time */
    bool quiet;      /* no progress, and nothing of jobs that are done */
    struct session_watcher watcher;
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
