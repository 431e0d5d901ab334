/* serve_state.h: a running server's own memory, seen by its parts only.
 *
 *   serve.c    building, the loop, the beginning and the end
 *   pass.c     the way of a pose to the robots, and of robots' bytes to the core
 *   tick.c     what happens 50 times a second
 *   acts.c     what those who look on see and may do
 *   table.c    what the operator sees
 *   verdict.c  what a check finds
 */
#ifndef SERVE_STATE_H
#define SERVE_STATE_H

#include "console.h"
#include "guard.h"
#include "histogram.h"
#include "link_loss.h"
#include "loop.h"
#include "metrics.h"
#include "onlookers.h"
#include "plan.h"
#include "record.h"
#include "serve.h"
#include "server.h"
#include "steer.h"

enum serve_phase {
    PHASE_GATHER, /* robots are dialled and told their mission */
    PHASE_RUN,
    PHASE_STOP, /* everyone is halted; waits until they say so */
    PHASE_OVER,
};

/* What there is of a robot outside the core. */
struct member_link {
    bool withheld;         /* its poses: a stall of the scenario's */
    int64_t posed_us;      /* when motion capture last had one of it */
    int64_t sent_us;       /* when it last got one */
    int64_t spacing_us;    /* of those it gets, at the least */
    uint64_t bytes;        /* sent and received when the rate was taken last */
    double rate;           /* bytes/s both ways */
    struct link_loss seen; /* likewise */
    double loss;           /* part of the frames lost since */
    bool warned;           /* of its battery */
    bool astray;           /* its body is not seen, or not believed; it has been said */
};

struct serve {
    const struct site *site;
    const struct scenario *scenario;
    const struct serve_options *options;
    struct plan *plan;
    struct server *core;
    struct drawings *drawings;
    struct steer steer;
    struct loop loop;
    struct watch timer, signals, keys;
    struct watch acts; /* of those who look on */
    int awake;         /* awake.h; -1: not allowed */
    struct console console;

    /* All by the scenario's order of robots. */
    size_t count;
    struct link_settings *link_settings;
    struct links *links;
    struct tracker_body *bodies;
    struct tracker *tracker;
    struct member_link *member;
    struct guard_limits limits;
    struct guard_robot *places;
    struct sample *samples;

    struct link_owner link_owner;
    struct source_owner source_owner;
    struct source *source;
    struct metrics *metrics;
    struct scene scene;    /* of the last row */
    struct record *record; /* NULL: a check */
    struct reference_state reference;
    struct histogram delay; /* us from a pose's arrival to the last robot's bytes */

    enum serve_phase phase;
    int64_t began_us;
    int64_t tick_us;  /* when the last tick was due */
    int64_t frame_us; /* when motion capture spoke last */
    uint64_t ticks;
    uint64_t phase_tick; /* when the phase began */
    int32_t until;       /* mission time of the last row, ms */
    bool chores;         /* of the last tick are still to be done */
    bool event;          /* one took effect since the last row */
    bool alarmed;        /* the guard has spoken before the start */
    bool estopped;
    uint32_t links_lost;
    enum serve_end end;
    char reason[256]; /* why it ends */
    int32_t ended_ms; /* mission time of that */
    struct metrics_result metrics_end;
    size_t table_room;
    char *table;
};

/* pass.c */
void pass_frame(void *serve, const struct capture_frame *frame, int64_t arrival_us);
void pass_up(void *serve, size_t robot);
void pass_down(void *serve, size_t robot, const char *words);
void pass_received(void *serve, size_t robot, const uint8_t *bytes, size_t count);
void pass_flush(struct serve *serve, size_t robot, int64_t now_us);

/* acts.c: from now on their acts are watched. False with errno. */
bool acts_watch(struct serve *serve);

/* Says how it stands. */
void acts_tell(struct serve *serve);

#define ALARM_WORDS_MAX 160

/* tick.c: whether a robot is where it may not be, in words. */
bool tick_alarm(struct serve *serve, char words[ALARM_WORDS_MAX]);

/* Takes what the core reports and orders. */
void tick_drain(struct serve *serve);

/* One control tick, due at `due_us`. */
void tick(struct serve *serve, int64_t due_us);

/* After the ticks that were due: what goes out without a pose, and where there are no poses the
 * chores. */
void tick_flush(struct serve *serve);

/* What a tick leaves to be done when the next poses have gone out, so that none of them waits for
 * it: files, metrics, dialling, the table. */
void tick_chores(struct serve *serve);

/* serve.c: the robots are halted, then the run ends. */
void serve_stop(struct serve *serve, enum serve_end end, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void serve_estop(struct serve *serve);

/* The mission begins, whoever is missing, if a candidate is ready, nobody stands where he may not,
 * and there is no emergency stop. NULL: it does; else why not, in words. */
const char *serve_begin(struct serve *serve);

/* Ends in good order. A check that is cut short has found nothing good. */
void serve_leave(struct serve *serve, const char *who);

/* table.c */
const char *table_phase(const struct serve *serve); /* in a word */
void table_draw(struct serve *serve);
void table_line(struct serve *serve); /* where there is no terminal */
void table_missing(const struct serve *serve, char *words, size_t room);

/* verdict.c: prints what was found. True when all is good. */
bool verdict_print(struct serve *serve, FILE *out);

/* The robot can take part now. */
bool serve_is_ready(const struct serve *serve, size_t robot);

#endif
