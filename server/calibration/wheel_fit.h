/* wheel_fit.h: from the record of a drive to the wheels that drove so.
 *
 * Pure. A wheel at s PWM steps settles at
 *
 *   gain * wheel_max * sign(s) * max(0, |s| - dead) / (PWM_STEPS - dead)
 *
 * with a first-order lag; two of them, `track` apart, move the robot by equation 1. What is sent
 * takes effect late, each change by a little more or less than the others. All of that, where the
 * drive began, and how the body in motion capture lies on the robot, is fitted at once by least
 * squares: Levenberg and Marquardt's way, MINPACK's lmdif. */
#ifndef WHEEL_FIT_H
#define WHEEL_FIT_H

#include "drive.h"

enum { WHEEL_LEFT, WHEEL_RIGHT, WHEELS };

struct wheel_fit {
    double gain[WHEELS]; /* beside the wheels' nominal speed */
    double dead[WHEELS]; /* part of full PWM */
    double track;        /* m */
    double lag;          /* s */
    double delay;        /* s from sending to taking effect, in the mean */

    /* Of the body in motion capture: its heading beside the robot's, rad, and where its origin lies
     * from the middle between the wheels, m. */
    double heading, ahead, aside;

    double rms; /* of the places that were seen, from those of the fit, m */
};

#define WHEEL_FIT_WORDS_MAX 160

/* False, and in `words` what is wrong with the robot and what can be done, when the drive was not
 * that of such a robot, or not enough was seen of it. */
bool wheel_fit(const struct drive_record *record, const struct drive_wheels *wheels,
               struct wheel_fit *fit, char words[WHEEL_FIT_WORDS_MAX]);

/* How far from where wheels without fault would have led it a trial went at most, m: wheels with
 * the lag of `fit`, to which each change came up to 10 ms sooner or later than in the mean. `track`
 * as in drive_plan_trial(). NAN when nothing was seen of it. */
double wheel_fit_trial_error(const struct drive_record *record, const struct drive_wheels *wheels,
                             double track, const struct wheel_fit *fit);

#endif
