/* act.h: what somebody who looks on may do to a run. */
#ifndef ACT_H
#define ACT_H

#include "scene.h"

enum act_kind {
    /* A robot. */
    ACT_KILL,
    ACT_REVIVE,
    ACT_STALL,
    ACT_MUTE,
    ACT_UNMUTE,
    ACT_DRAIN,
    ACT_MOVE, /* a simulated one, elsewhere */
    /* The fleet. */
    ACT_FORMATION, /* one of those there are, by its name */
    ACT_DRAW,      /* a new one, which takes effect at once */
    ACT_ESTOP,
    ACT_BEGIN, /* a real mission, with those that are ready */
    ACT_END,   /* the run ends in good order */
    /* The simulation's time. */
    ACT_PAUSE,
    ACT_RESUME,
    ACT_STEP, /* one tick of a simulation that is paused */
    ACT_SPEED,
    ACT_COUNT,
};

/* Vertices that can be drawn. */
#define ACT_VERTICES_MAX 128

#define ACT_SPEED_MIN 0.01
#define ACT_SPEED_MAX 1000.0

struct act {
    enum act_kind kind;
    uint32_t viewer, number;   /* who asked, and his number of it: view_answer() */
    uint16_t robot;            /* id */
    struct scene_pose pose;    /* MOVE: finite, within +-POSITION_MAX_M */
    double speed;              /* times real time, ACT_SPEED_MIN to _MAX; 0: as fast as it goes */
    char name[SCENE_NAME_MAX]; /* FORMATION, DRAW: letters, digits, . _ - */
    size_t count;              /* DRAW: vertices, exactly one with L = 0 */
    double L[ACT_VERTICES_MAX], psi[ACT_VERTICES_MAX]; /* m, rad, finite */
};

#define ACT_BIT(kind) (1u << (kind))

/* The word of an act on the wire: "kill", "formation", ... */
extern const char *const act_words[ACT_COUNT];

#endif
