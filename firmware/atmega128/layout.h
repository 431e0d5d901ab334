/* layout.h: where in the structs of C the assembler finds things; layout.c holds it to them. */
#ifndef LAYOUT_H
#define LAYOUT_H

#define DECODER_PAYLOAD 0
#define DECODER_LENGTH 58
#define DECODER_RUN 59
#define DECODER_CRC 62

#define MISSION_K 6
#define MISSION_K_THETA 8
#define MISSION_V_MAX 10
#define MISSION_OMEGA_MAX 12

#define GOAL_AT 0
#define GOAL_VELOCITY 8
#define GOAL_ACCELERATION 12

#define SWEEP_VERTEX 0
#define SWEEP_SKIP 2
#define SWEEP_AT 4
#define SWEEP_BYTES 8
#define SWEEP_BY 9
#define SWEEP_CLOSEST 10
#define SWEEP_SQUARE 12

#define LOOKOUT_ORIGIN 0
#define LOOKOUT_HEADING 8
#define LOOKOUT_NOW 12
#define LOOKOUT_REACH 14
#define LOOKOUT_BYTE 18
#define LOOKOUT_BY 19

#define NEIGHBOUR_TIME 2
#define NEIGHBOUR_AT 4
#define NEIGHBOUR_DRIFT 14

#define POSE_AT 0
#define POSE_THETA 8

#define MOTION_HOLD_UNITS 32
#define STATE_AGE_LIMIT 1000

#endif
