/* q16_law.h: the motion law of motion.h in Q16.16, SI units throughout. */
#ifndef Q16_LAW_H
#define Q16_LAW_H

#include "q16.h"

struct q16_law {
    q16 x, y, theta;
    q16 goal_x, goal_y;
    q16 vel_x, vel_y;
    q16 acc_x, acc_y;
    q16 k, k_theta;
    q16 v_max, omega_max;
};

struct q16_command {
    q16 v, omega;
};

struct q16_command q16_law(const struct q16_law *in);

#endif
