#include "layout.h"

#include "motion.h"
#include "rival.h"
#include "sweep.h"

#include <stddef.h>

#define AT(type, member, offset) _Static_assert(offsetof(struct type, member) == (offset), #member)

AT(frame_decoder, payload, DECODER_PAYLOAD);
AT(frame_decoder, length, DECODER_LENGTH);
AT(frame_decoder, run, DECODER_RUN);
AT(frame_decoder, crc, DECODER_CRC);

AT(message_mission, k, MISSION_K);
AT(message_mission, k_theta, MISSION_K_THETA);
AT(message_mission, v_max, MISSION_V_MAX);
AT(message_mission, omega_max, MISSION_OMEGA_MAX);

AT(motion_goal, at, GOAL_AT);
AT(motion_goal, velocity, GOAL_VELOCITY);
AT(motion_goal, acceleration, GOAL_ACCELERATION);

AT(sweep, vertex, SWEEP_VERTEX);
AT(sweep, skip, SWEEP_SKIP);
AT(sweep, at, SWEEP_AT);
AT(sweep, bytes, SWEEP_BYTES);
AT(sweep, by, SWEEP_BY);
AT(sweep, closest, SWEEP_CLOSEST);
AT(sweep, square, SWEEP_SQUARE);

AT(lookout, origin, LOOKOUT_ORIGIN);
AT(lookout, heading, LOOKOUT_HEADING);
AT(lookout, now, LOOKOUT_NOW);
AT(lookout, reach, LOOKOUT_REACH);
AT(lookout, byte, LOOKOUT_BYTE);
AT(lookout, by, LOOKOUT_BY);

AT(neighbour, time, NEIGHBOUR_TIME);
AT(neighbour, pose.at, NEIGHBOUR_AT);
AT(neighbour, drift, NEIGHBOUR_DRIFT);

AT(pose, at, POSE_AT);
AT(pose, theta, POSE_THETA);

_Static_assert(STATE_AGE_MAX_MS == STATE_AGE_LIMIT, "STATE_AGE_MAX_MS");
_Static_assert(MOTION_HOLD == MOTION_HOLD_UNITS, "MOTION_HOLD");
