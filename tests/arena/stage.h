/* stage.h: a whole arena for a test, on this machine and in real time: `muster arena`, one
 * `muster robot` for each robot, `muster serve`, and between them what a test can spoil.
 *
 * Robots send their set-points here first, which passes them on to the arena. So a robot's time is
 * counted in its own control ticks, 20 ms each: a machine that is busy with something else slows
 * the judge as it does the robots. Where it holds a robot up for longer than that makes up for, a
 * test that goes wrong is ignored, and says so. */
#ifndef STAGE_H
#define STAGE_H

#include "cable.h"
#include "process.h"

#include <stdbool.h>
#include <stdint.h>

#define STAGE_ROBOTS 4

/* Robots stand so many ticks after a fault: the 500 ms of the supervisor. */
#define SAFE_TICKS 25

struct stage_plan {
    const char *scenario; /* path, or NULL: four robots that drive straight on for `duration` s */
    double duration;
    bool avr;                       /* simulated chips in place of native robots */
    enum cable_kind cable;          /* CABLE_NONE: the robots' own ptys */
    const char *mocap;              /* more of the site's mocap: ", jump: 0.5"; NULL: nothing */
    const char *site;               /* more lines of the site; NULL: none */
    const char *preload;            /* a library for the server; NULL: none */
    bool looked_at;                 /* the server has a view, at a port that is free */
    int output;                     /* for the server's words; 0: they are read */
    bool absent[STAGE_ROBOTS];      /* robots that are not started */
    unsigned answers[STAGE_ROBOTS]; /* id of who answers; 0: the robot itself */
};

struct stage_robot {
    struct process process;
    struct cable cable;
    uint16_t id; /* of who answers there */
    char link[128];
    uint64_t ticks;   /* control ticks so far */
    uint64_t moved;   /* the newest one with the motors on */
    uint64_t stood;   /* the newest one with the motors off */
    int64_t heard_us; /* when its last tick came; 0: it is not to be judged by it */
    uint64_t marked;  /* the tick of the last stage_mark() */
    uint64_t pause;   /* most ticks in a row with the motors off, since then */
};

struct stage {
    struct loop loop;
    struct watch clock;
    struct watch tap; /* set-points come here */
    bool open;
    const struct stage_plan *plan;
    char directory[64];
    uint16_t natnet_port, robots_port; /* the arena's */
    int64_t held_us;                   /* the longest that a robot's ticks did not come */
    struct process arena, server;
    struct stage_robot robot[STAGE_ROBOTS];
};

/* Arena and robots are there, and the server dials them. */
void stage_open(struct stage *stage, const struct stage_plan *plan);

/* Until somebody leads: the mission has begun. */
void stage_begin(struct stage *stage);

/* Fails the test with `words` if it is not so: of what depends on time. */
void stage_expect(const struct stage *stage, bool so, const char *words);

/* Lets time pass until `done` says so. Fails the test with `words` after a generous time. */
void stage_until(struct stage *stage, bool (*done)(struct stage *stage, const void *context),
                 const void *context, const char *words);

/* Until every robot that runs has come so many control ticks further. */
void stage_ticks(struct stage *stage, unsigned ticks);

/* Here something is about to happen: ticks, pauses and what the server says count from now. */
void stage_mark(struct stage *stage);

/* Until the server has said it, since the last mark. */
void stage_says(struct stage *stage, const char *words);

/* Robot `id` comes to stand within SAFE_TICKS of the mark, and stands. */
void stage_stands(struct stage *stage, unsigned id);

/* Robot `id` drives, now or after a while. */
void stage_drives(struct stage *stage, unsigned id);

/* Robot `id` drives for so many ticks without a stop, now or after a while. */
void stage_drives_for(struct stage *stage, unsigned id, unsigned ticks);

/* Robot `id` has been driving ever since the mark, but for a few ticks. */
void stage_drove_on(struct stage *stage, unsigned id);

/* Anew, where they were before. */
void stage_start_arena(struct stage *stage);
void stage_start_robot(struct stage *stage, unsigned id);

struct stage_robot *stage_robot(struct stage *stage, unsigned id);

/* The server ends with this status. */
void stage_server_ends(struct stage *stage, int status);

/* A number of summary.json, the one behind the first `key` behind the first `section`. */
double stage_summary(const struct stage *stage, const char *section, const char *key);

/* Every vertex was held at the end, and robots were no farther off than `error` m in the mean. */
void stage_is_complete(const struct stage *stage, double error);

/* Whether events.csv holds these words. */
bool stage_logged(const struct stage *stage, const char *words);

/* Port of the server's that the arena sends frames to. */
uint16_t stage_frames_port(const struct stage *stage);

/* Ends the rest in good order: arena and robots leave with 0. */
void stage_end(struct stage *stage);

/* For tearDown(): ends everything, however far a test has come. Of one that has failed it says what
 * was said, and keeps the files. */
void stage_close(struct stage *stage);

/* What main() returns: STAGE_SKIPPED when nothing failed and something was ignored. */
#define STAGE_SKIPPED 77
int stage_verdict(void);

#endif
