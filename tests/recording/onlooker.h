/* onlooker.h: `muster` as a child process with a view, and one who looks at it. */
#ifndef ONLOOKER_H
#define ONLOOKER_H

#include "client.h"
#include "process.h"

#define TICK_MS 20
#define TICKS 1000 /* that can be seen */

/* A scene as it came. */
struct seen {
    uint8_t *bytes; /* NULL: it did not */
    size_t count;
};

struct onlooker {
    char dir[32]; /* for the test's files; gone with it */
    struct loop loop;
    struct watch clock;
    struct process process;
    struct client client;
    struct seen seen[TICKS]; /* by their ticks, from t = 0 */
    int32_t seen_ms;         /* the latest one; before: -TICK_MS */
    size_t scenes, events;
};

void onlooker_open(struct onlooker *onlooker);
void onlooker_close(struct onlooker *onlooker);

/* Starts muster with these arguments (a NULL ends them), and waits for its view. */
void onlooker_start(struct onlooker *onlooker, const char *const arguments[]);

/* Joins with this sub-protocol. */
void onlooker_join(struct onlooker *onlooker, const char *protocol);

/* The next message; what scenes of t = 0 and later are in it, is in `seen`. */
struct client_message onlooker_look(struct onlooker *onlooker);

/* Waits for the process's end, and returns its status. */
int onlooker_end(struct onlooker *onlooker);

/* Runs muster with these arguments to its end, and returns its status. */
int onlooker_run(struct onlooker *onlooker, const char *const arguments[]);

#endif
