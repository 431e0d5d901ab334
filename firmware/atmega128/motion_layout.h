/* motion_layout.h: where motion_fl.S finds what it needs; motion_layout.c holds it to the structs.
 */
#ifndef MOTION_LAYOUT_H
#define MOTION_LAYOUT_H

#define MISSION_K 6
#define MISSION_K_THETA 8
#define MISSION_V_MAX 10
#define MISSION_OMEGA_MAX 12

#define GOAL_AT 0
#define GOAL_VELOCITY 8
#define GOAL_ACCELERATION 12

#define POSE_AT 0
#define POSE_THETA 8

#define MOTION_HOLD_UNITS 32

#endif
