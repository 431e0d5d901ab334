/* float_law.h: the motion law of motion.h in floating point, SI units throughout. */
#ifndef FLOAT_LAW_H
#define FLOAT_LAW_H

struct float_law {
    float x, y, theta;      /* the robot's pose: m, rad */
    float goal_x, goal_y;   /* m */
    float vel_x, vel_y;     /* of the goal, m/s */
    float acc_x, acc_y;     /* of the goal, m/s^2 */
    float k, k_theta;       /* 1/s */
    float v_max, omega_max; /* m/s, rad/s */
};

struct float_command {
    float v, omega; /* m/s, rad/s */
};

struct float_command float_law(const struct float_law *in);

#endif
