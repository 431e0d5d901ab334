/* runs.h: the runs that the figures are made of. */
#ifndef PAPER_RUNS_H
#define PAPER_RUNS_H

#include "history.h"
#include "paper.h"
#include "scenario.h"
#include "sim.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define RUN_SETTINGS 4
#define RUN_SETTING_MAX 32 /* bytes */
#define RUN_NAME_MAX 64

enum { LAW_COUNT = 3 }; /* by enum motion_law */
enum task { STRAIGHT, STRAIGHT_TURNED, CURVE, CURVE_TURNED, TASK_COUNT };
enum scheme { CPA, RIGID, OPTIMAL, SCHEME_COUNT };
enum reading { AS_PRINTED, V_ALONG, V_MIRRORED, READING_COUNT };
enum reach { RANGE_1, RANGE_3, REACH_COUNT };

struct run {
    char name[RUN_NAME_MAX]; /* of its folder */
    const char *file;        /* among the scenarios */
    char setting[RUN_SETTINGS][RUN_SETTING_MAX];
    size_t settings;
    uint32_t figures; /* bit n: figure n shows it */
    bool native;      /* always on native robots */

    struct scenario *scenario; /* once prepared */

    bool done; /* from here on, what came out */
    struct summary summary;
    struct history history;
};

struct runs {
    union {
        struct {
            struct run law[TASK_COUNT][LAW_COUNT];
            struct run fault[SCHEME_COUNT], change[SCHEME_COUNT];
            struct run hundred[READING_COUNT][REACH_COUNT][SCHEME_COUNT];
            struct run fault_experiment, change_experiment;
        };
        struct run all[TASK_COUNT * LAW_COUNT + 2 * SCHEME_COUNT +
                       READING_COUNT * REACH_COUNT * SCHEME_COUNT + 2];
    };
};

#define RUN_COUNT (sizeof((struct runs *)0)->all / sizeof(struct run))

extern const char *const scheme_words[SCHEME_COUNT];
extern const char *const law_words[LAW_COUNT];

/* Says which runs there are, and runs none. */
void runs_plan(struct runs *runs);
void runs_free(struct runs *runs);

/* Puts a setting of `muster sim --set` into a run. */
void run_set(struct run *run, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Reads its scenario. False, with words in `error`, when it is refused. */
bool run_prepare(struct run *run, const struct paper_options *options, char *error, size_t room);

/* Forgets the scenario and what came out. */
void run_forget(struct run *run);

/* What its robots are. */
enum sim_robots run_robots(const struct run *run, const struct paper_options *options);

/* Who looks at how far a run is. */
struct run_watch {
    void (*tick)(void *watcher, double t);
    void *watcher;
};

/* Runs one that is prepared, its files in DIR/runs/NAME. `watch` may be NULL. */
enum sim_end run_carry_out(struct run *run, const struct paper_options *options,
                           const struct run_watch *watch, const volatile bool *stop, char *error,
                           size_t room);

#endif
