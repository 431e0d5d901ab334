/* calibration.h: the job (job.h) that measures a robot's wheels by motion capture, gives the robot
 * their parameters, and shows by a drive before and one after what that has brought.
 *
 * What is measured is saved in the end; until then a robot that is switched off has its old
 * parameters again, and one whose calibration fails is given them back. */
#ifndef CALIBRATION_H
#define CALIBRATION_H

#include "job.h"
#include "parameter_file.h"
#include "talk.h"
#include "turns.h"
#include "wheel_fit.h"

/* The parameters that are measured: these and all between. */
#define CALIBRATION_FIRST PARAMETER_LEFT_GAIN
#define CALIBRATION_LAST PARAMETER_MOTOR_LAG
#define CALIBRATION_PARAMETERS (CALIBRATION_LAST - CALIBRATION_FIRST + 1)

struct calibration_settings {
    struct drive_wheels wheels;
    bool save; /* else the old parameters are set again in the end */
};

/* What came out of it, once the job is done. */
struct calibration_result {
    uint16_t value[CALIBRATION_PARAMETERS]; /* as in parameter_table.h */
    struct wheel_fit fit;
    double before, after; /* wheel_fit_trial_error(), m */
};

enum calibration_phase {
    CALIBRATION_MEET,    /* it says who it is and that it may drive */
    CALIBRATION_READ,    /* its old parameters */
    CALIBRATION_LOOK,    /* motion capture sees it */
    CALIBRATION_WAIT,    /* for its turn */
    CALIBRATION_MEASURE, /* drives as its motors are */
    CALIBRATION_BEFORE,  /* drives by its old parameters */
    CALIBRATION_SET,     /* is given the new ones */
    CALIBRATION_AFTER,   /* drives by them */
    CALIBRATION_SAVE,
    CALIBRATION_CHECK, /* reads what it has now */
    CALIBRATION_GIVE_BACK,
};

struct calibration {
    struct job job;
    const struct calibration_settings *settings;
    struct turns *turns;
    size_t place; /* its own among `turns` */
    struct calibration_result result;

    /* calibration.c's */
    struct talk talk;
    enum calibration_phase phase;
    int64_t phase_us; /* when that began */
    uint8_t next;     /* the parameter that is asked for or set */
    uint16_t old[CALIBRATION_PARAMETERS];
    bool changed;                /* the robot has other parameters in force than are stored */
    char trouble[JOB_WORDS_MAX]; /* what failed, while the old ones are given back */
    struct job_pose pose;        /* the newest one; at_us 0: none yet */
    double home_x, home_y;       /* where it stood when it got its turn */
    struct drive_plan plan;
    int64_t begun_us, told_us; /* the drive, 0: not yet; when the motors were told something last */
    uint32_t statuses;         /* that had come when it began */
    struct drive_record record;
};

void calibration_begin(struct calibration *calibration, uint16_t robot,
                       const struct calibration_settings *settings, struct turns *turns,
                       size_t place);

/* What a parameter file is to say of those that are done. `entries` has room for all; returns how
 * many they are. */
size_t calibration_entries(const struct calibration *calibrations, size_t count,
                           struct parameter_entry *entries);

/* Why a robot cannot be driven, in words; "" where it may be so yet; NULL when it can. */
const char *calibration_refusal(const struct talk *talk);

/* Ends it soon, failed, with these words: the robot stands, and is given its old parameters back
 * where it has others. One that is being saved ends by itself. */
void calibration_stop(struct calibration *calibration, const char *words, int64_t now_us);

#endif
