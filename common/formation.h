/* formation.h: the vertices (L_j, psi_j) about the leader's pose (equation 2).
 *
 * Kept in the leader's frame as int16 at one scale per formation: a unit is 2^scale quarter
 * millimetres. Parts stay within FORMATION_REACH, half of int16, so that the difference of two
 * places fits it too: scale 0 reaches 4.09 m at 1/4 mm, scale 5 131 m at 8 mm. */
#ifndef FORMATION_H
#define FORMATION_H

#include "fixed.h"
#include "limits.h"
#include "message.h"

#define FORMATION_SCALE_MAX 9
#define FORMATION_REACH 16383

struct formation {
    uint8_t number; /* 0 = none */
    uint8_t scale;
    uint16_t total;
    uint16_t leader; /* vertex number of the leader's vertex, the one with L = 0; 0 = none */
    struct vec16 vertex[VERTICES_MAX]; /* [0] is vertex 1 */
};

/* The smallest scale that fits a formation whose farthest vertex is `distance` (wide, >= 0). */
uint8_t formation_scale(int32_t distance);

/* (L cos psi, L sin psi) at `scale`. */
struct vec16 formation_place(struct polar_vertex vertex, uint8_t scale);

/* The vertex `goal` as a wide offset from the leader, turned by the leader's heading. */
struct vec32 formation_offset(struct vec16 goal, uint8_t scale, struct sincos heading);

#endif
