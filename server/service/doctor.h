/* doctor.h: the job that looks a robot over: what it says of itself, and how well it is heard. */
#ifndef DOCTOR_H
#define DOCTOR_H

#include "param.h"

#define DOCTOR_SECONDS_MAX 60

/* Questions are asked at most so often: no link is kept busy by them. */
#define DOCTOR_ASK_US 50000
#define DOCTOR_ASKS_MAX (DOCTOR_SECONDS_MAX * 1000000 / DOCTOR_ASK_US + 1)

struct doctor_job {
    struct job job;
    struct talk talk;
    int64_t look_us;                          /* how long to look */
    struct param_reading reading[PARAM_ROWS]; /* of every parameter */
    struct message_status first;              /* its first status; talk.status is the last one */
    uint32_t asks;                            /* answered questions */
    uint32_t trips;                           /* those that were asked once, and */
    uint32_t trip_us[DOCTOR_ASKS_MAX];        /* how long they took; sorted at the end */

    /* doctor.c's */
    size_t row;
    int64_t began_us, asked_us;
};

/* Done without words, whatever is wrong with it; failed when it cannot be asked. */
void doctor_begin(struct doctor_job *job, uint16_t robot, double seconds);

#endif
