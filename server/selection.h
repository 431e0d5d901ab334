/* selection.h: which robots of which site a command has in hand, read from the command line alike:
 * SITE.yaml, --robots, --set, --quiet. What is not allowed ends the program with STATUS_USAGE. */
#ifndef SELECTION_H
#define SELECTION_H

#include "session.h"

#include <argp.h>

struct selection {
    const char *path;      /* the site file; NULL: not named */
    const char **settings; /* --set */
    size_t setting_count;
    const char *robots; /* --robots; NULL: all */
    bool quiet;

    /* From selection_open() on. */
    struct site *site;
    size_t *chosen; /* places in site->robots, in the site's order */
    size_t count;
};

enum { SELECTION_KEY_ROBOTS = 512, SELECTION_KEY_SET, SELECTION_KEY_QUIET };

/* Part of a command's table of options. */
#define SELECTION_OPTIONS                                                                          \
    {"robots",                                                                                     \
     SELECTION_KEY_ROBOTS,                                                                         \
     "IDS",                                                                                        \
     0,                                                                                            \
     "Only these robots of the site, such as 3 or 1-12 or 1,3..5",                                 \
     0},                                                                                           \
        {"set",                                                                                    \
         SELECTION_KEY_SET,                                                                        \
         "KEY.PATH=VALUE",                                                                         \
         0,                                                                                        \
         "Put a value into the site, such as robots.0.baud=57600; repeatable",                     \
         0},                                                                                       \
    {                                                                                              \
        "quiet", SELECTION_KEY_QUIET, NULL, 0, "Show no progress; results and failures stay", 0    \
    }

/* Room for as many settings as there are arguments. False when there is no memory, having said
 * so. */
bool selection_begin(struct selection *selection, const char *command, int argc);

/* One of the options above: ARGP_ERR_UNKNOWN for others. */
error_t selection_option(struct selection *selection, int key, char *value);

/* Reads the site and finds the robots. False when one is refused, having said so. */
bool selection_open(struct selection *selection, const char *command);

/* Runs jobs[i] with the robot chosen[i] (session.h), and says what was wrong beside single
 * robots. */
enum session_end selection_run(const struct selection *selection, const char *command,
                               struct job *const *jobs, bool poses);

/* The exit status that goes with it. */
int selection_status(enum session_end end);

void selection_end(struct selection *selection);

#endif
