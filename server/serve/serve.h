/* serve.h: a run with real robots: the server core in real time, between motion capture and links.
 *
 * One thread. A frame of motion capture is decoded, its poses go to the core, and each robot it
 * speaks of gets what is due in one write; nothing on that way allocates, waits or touches a file.
 * The core's tick, 50 Hz by a timer, does the rest. */
#ifndef SERVE_H
#define SERVE_H

#include "scenario.h"
#include "site.h"
#include "view.h"

/* What those who look on may ask for, ACT_BIT(). */
#define SERVE_ACTS                                                                                 \
    (ACT_BIT(ACT_KILL) | ACT_BIT(ACT_REVIVE) | ACT_BIT(ACT_STALL) | ACT_BIT(ACT_MUTE) |            \
     ACT_BIT(ACT_UNMUTE) | ACT_BIT(ACT_FORMATION) | ACT_BIT(ACT_DRAW) | ACT_BIT(ACT_ESTOP) |       \
     ACT_BIT(ACT_BEGIN) | ACT_BIT(ACT_END))

enum serve_what {
    SERVE_RUN,
    SERVE_CHECK, /* everything but the start: robots never move */
};

struct serve_options {
    enum serve_what what;
    const char *out;   /* directory for the run's files; unused by a check */
    uint64_t seed;     /* of emulated losses */
    double seconds;    /* a check: how long to look */
    bool trace;        /* write trace.csv and the figures */
    struct view *view; /* those who look on a run, and may act on it; NULL: nobody */
    bool quiet;        /* neither table nor progress; words on stderr stay */
};

enum serve_end {
    SERVE_DONE,    /* the mission is over, or someone ended it in good order */
    SERVE_BAD,     /* stopped by the fence or the separation, or the check found fault */
    SERVE_FAILED,  /* `error` says why; robots have been stopped if that was possible */
    SERVE_REFUSED, /* site and scenario do not fit, `error` says why; nothing was begun */
};

enum serve_end serve_run(const struct site *site, const struct scenario *scenario,
                         const struct serve_options *options, char *error, size_t room);

#endif
