/* motion.h: from a moving goal to the speed and rate that lead there. */
#ifndef MOTION_H
#define MOTION_H

#include "fixed.h"
#include "message.h"

/* Where the robot should be: pd, pd' and pd''. What lies more than 8.19 m off in x or y is taken to
 * lie that far off in the same direction. */
struct motion_goal {
    struct vec32 at;           /* wide */
    struct vec16 velocity;     /* narrow */
    struct vec16 acceleration; /* narrow */
};

struct motion_command {
    int16_t v;     /* narrow */
    int16_t omega; /* rate */
};

/* Below this |u| (8 mm/s) the direction of u is noise: the heading is held. */
#define MOTION_HOLD (NARROW_PER_M * 8 / 1000)

/* What a law keeps from tick to tick; zero at the start of a mission. */
struct motion_memory {
    struct vec32 integral; /* of the error, narrow * s, Q.8 */
    struct motion_command last;
};

/* The command of the mission's law, within its v_max and omega_max. */
struct motion_command motion_step(const struct message_mission *mission,
                                  struct motion_memory *memory, const struct motion_goal *goal,
                                  const struct pose *own);

/* The feedback-linearising law, the paper's own:
 *
 *   u = pd' + k (pd - p)          v = u . (cos theta, sin theta)
 *   theta_d = atan2(u_y, u_x)     omega = theta_d' + k_theta wrap(theta_d - theta)
 *
 * with theta_d' = (u x u') / |u|^2 and u' = pd'' + k (pd' - p'). The paper cites it without
 * printing it. */
struct motion_command motion_fl(const struct message_mission *mission,
                                const struct motion_goal *goal, const struct pose *own);

/* Kanayama, Kimura, Miyazaki and Noguchi, IROS 1991, with the goal's velocity as the reference
 * posture's:
 *
 *   v = v_r cos e_theta + K_x e_x      omega = omega_r + v_r (K_y e_y + K_theta sin e_theta)
 *
 * K_x = k; K_theta = k_theta per metre and K_y = K_theta^2 / 4, their critical damping. */
struct motion_command motion_kanayama(const struct message_mission *mission,
                                      const struct motion_goal *goal, const struct pose *own);

/* A PID controller on the error, without feed-forward:
 *
 *   u = k e + k^2 / 4 integral(e) + 1/4 (pd' - p')     v and omega from u as above, theta_d' = 0
 *
 * The integral stands still while v is at its limit. */
struct motion_command motion_pid(const struct message_mission *mission,
                                 struct motion_memory *memory, const struct motion_goal *goal,
                                 const struct pose *own);

#endif
