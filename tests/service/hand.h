/* hand.h: robots in hand for a test, in real time: processes of `muster robot`, a site file that
 * names their links, and one command after another. */
#ifndef HAND_H
#define HAND_H

#include "process.h"

#include <stdbool.h>

#define HAND_CREWS 2   /* processes of robots */
#define HAND_ROBOTS 16 /* in all of them */

struct hand {
    bool open;
    struct loop loop;
    struct watch clock;
    char directory[64];
    struct process crew[HAND_CREWS];
    struct process command;
    struct process arena;
    unsigned natnet_port, robots_port; /* the arena's */
    size_t crew_count, robot_count;
    char link[HAND_ROBOTS][128]; /* of each robot, in the order of their crews */
};

void hand_open(struct hand *hand);

/* Starts a crew by these options of `muster robot` (a NULL ends them), and waits for its links. */
void hand_add(struct hand *hand, const char *const options[]);

/* Starts `muster arena` with this scenario's text, and waits for its ports. */
void hand_add_arena(struct hand *hand, const char *scenario);

/* A site of `ids` (a 0 ends them): the robots by their place in `link`, beyond it one that is not
 * there. Returns its path. */
const char *hand_site(struct hand *hand, const unsigned ids[]);

/* Runs `muster` with these arguments (a NULL ends them) to its end, and returns its status. What it
 * said, on stdout and stderr, is hand->command.said. */
int hand_run(struct hand *hand, const char *const arguments[]);

/* Only starts it, and waits for its end. */
void hand_start(struct hand *hand, const char *const arguments[]);
int hand_end(struct hand *hand);

/* Whether the last command has said this. */
bool hand_said(const struct hand *hand, const char *words);

/* Until the command that was started has said it. */
void hand_waits(struct hand *hand, const char *words);

/* Until a crew has said it, in all that it has said. */
void hand_hears(struct hand *hand, size_t crew, const char *words);

/* Switches a crew's robots off and on again. */
void hand_power_cycle(struct hand *hand, size_t crew);

/* For tearDown(): ends everything; of a test that has failed it says what was said. */
void hand_close(struct hand *hand);

#endif
