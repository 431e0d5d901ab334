/* adapters.h: which Bluetooth adapter dials which robot, and when. Pure but for adapters_read().
 *
 * An adapter pages one robot at a time, and one that is absent holds it up for 5 s (the page
 * timeout of Bluetooth's Core specification, volume 4 part E, 6.6). So each has one dial under way
 * at most, and robots that did not answer come after those that may. */
#ifndef ADAPTERS_H
#define ADAPTERS_H

#include "link.h"

struct adapter {
    struct link_adapter seen;
    bool dialling;
    int64_t dialled_us; /* when that dial began */
    int64_t rest_us;    /* absent robots are not dialled before, for the sake of the others */
    size_t connected;
};

struct adapters {
    size_t count;
    struct adapter adapter[LINK_ADAPTERS_MAX];
};

/* A robot, as its adapter sees it. */
struct adapter_caller {
    bool bluetooth;  /* else it has nothing to do with adapters */
    int wanted;      /* n of hciN; -1: any */
    size_t own;      /* place of its adapter in the list */
    bool waits;      /* to be dialled */
    int64_t due_us;  /* not before */
    unsigned absent; /* dials in a row that it has not answered */
};

enum adapter_outcome { ADAPTER_CONNECTED, ADAPTER_ABSENT, ADAPTER_FAILED };

/* What the kernel has now, by number. 0 where there is none. */
size_t adapters_read(struct link_adapter list[LINK_ADAPTERS_MAX]);

/* Brings up to date what was read before: adapters keep their places, and are down when they are
 * gone. Robots that wait and may be dialled by any adapter leave those that are down. */
void adapters_refresh(struct adapters *adapters, const struct link_adapter *list, size_t count,
                      struct adapter_caller *callers, size_t caller_count);

/* Gives each robot its adapter: those that name one get it, the others the one with the fewest
 * robots. False with words in `error` when there is no such adapter, or none has a place left. */
bool adapters_spread(struct adapters *adapters, struct adapter_caller *callers, size_t count,
                     char *error, size_t room);

/* The robot to dial now; `count` for none. One that may be dialled by any adapter, and waits while
 * its own tries a robot that seems to be absent, is given one that has nothing to do. */
size_t adapters_next(struct adapters *adapters, struct adapter_caller *callers, size_t count,
                     int64_t now_us);

/* That it is being dialled, how that ended, and that a connection has. */
void adapters_begin(struct adapters *adapters, struct adapter_caller *caller, int64_t now_us);
void adapters_end(struct adapters *adapters, struct adapter_caller *caller,
                  enum adapter_outcome outcome, int64_t now_us);
void adapters_lose(struct adapters *adapters, const struct adapter_caller *caller);

/* What is to be said about a kernel (uname -r) that has Bluetooth crash; NULL for any other. */
const char *adapters_warn(const char *release);

#endif
