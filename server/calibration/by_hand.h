/* by_hand.h: the job (job.h) of a person who trims a robot's wheels by eye, key by key. */
#ifndef BY_HAND_H
#define BY_HAND_H

#include "job.h"
#include "talk.h"

/* Keys beside letters. */
enum by_hand_key {
    BY_HAND_FORWARD = 256,
    BY_HAND_BACK,
    BY_HAND_LEFT,
    BY_HAND_RIGHT,
};

struct by_hand {
    struct job job;
    /* What was done, or could not be, one line each. */
    void (*say)(const char *words);

    /* by_hand.c's */
    struct talk talk;
    bool ready; /* its trims are known */
    uint16_t value[PARAMETERS_STORED_COUNT];
    uint16_t known, due; /* by index, bits: those that have been read, those to be set */
    bool save_due, unsaved;
    int left, right;  /* which way the wheels turn, */
    int64_t until_us; /* and until when */
    int64_t told_us;  /* the motors, last */
};

void by_hand_begin(struct by_hand *hand, uint16_t robot, void (*say)(const char *words));

/* `key` is a letter or one of by_hand_key; another one is answered by what there is. */
void by_hand_press(struct by_hand *hand, int key, int64_t now_us);

#endif
