/* exact_law.h: the motion law of motion.h in double and SI units, to judge by. */
#ifndef EXACT_LAW_H
#define EXACT_LAW_H

#include <stdbool.h>
#include <stdint.h>

struct exact_law {
    double theta;            /* rad */
    double error_x, error_y; /* goal - position, m */
    double vel_x, vel_y;     /* of the goal, m/s */
    double acc_x, acc_y;     /* of the goal, m/s^2 */
    double k, k_theta;       /* 1/s */
    double v_max, omega_max; /* m/s, rad/s */
};

struct exact_command {
    double v, omega; /* m/s, rad/s */
    double u;        /* |u|, m/s */
    bool judged;     /* omega can be: u is not so short that its direction is coarse, and does not
                        point so nearly backwards that the side to turn to is chance */
};

struct exact_command exact_law(const struct exact_law *in);

/* Of a wide or narrow value. */
double metres(int32_t value);

#endif
