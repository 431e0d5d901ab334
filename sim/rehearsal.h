/* rehearsal.h: jobs (job.h) with simulated robots, in virtual time: what session.h is to real ones.
 *
 * A period is that of robot.h. What a job sends waits for the robot's UART and goes at its baud
 * rate; what a robot sends in a period is with its job at the period's end, and then a pose. */
#ifndef SIM_REHEARSAL_H
#define SIM_REHEARSAL_H

#include "body.h"
#include "job.h"
#include "mocap.h"
#include "radio.h"
#include "robot.h"

struct rehearsal_member {
    struct sim_robot *robot; /* powered on and off by whoever calls */
    struct job *job;
    bool off; /* the robot has no power, and so no link; the job goes on */
    bool cut; /* the link is down, both ways */

    /* Its body, and motion capture for jobs that have `seen`. Without kind.wheel_max it stays where
     * it is; without `mocap` it is seen 50 times a second, as it is. */
    struct body_kind kind;
    struct body body;
    const struct mocap *mocap;

    /* The ways of its link, by enum radio_way: of the timing's slots and of ROBOT_TX_MAX bytes.
     * NULL: a cable. */
    struct radio_pipe *radio[2];

    /* rehearsal.c's */
    bool up;
    size_t waiting;
    uint8_t bytes[1024];
    int16_t left, right;
    struct job_pose pose;
};

/* One period for all of them. `now_us`, the virtual time, is moved on by TICK_MS. False when a
 * processor crashed: `crashed`, unless NULL, then says whose. */
bool rehearsal_tick(struct rehearsal_member *members, size_t count,
                    const struct link_timing *timing, int64_t *now_us, size_t *crashed);

/* Until all jobs have ended, or `limit_us` of virtual time are over. False then, or when a
 * processor crashed. */
bool rehearsal_run(struct rehearsal_member *members, size_t count, const struct link_timing *timing,
                   int64_t *now_us, int64_t limit_us);

#endif
