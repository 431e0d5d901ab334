/* rotation.h: how a body is turned, as a unit quaternion x, y, z, w. */
#ifndef ROTATION_H
#define ROTATION_H

#include <stdbool.h>

/* Each gives false, and no turn at all in `turn`, for what is no rotation: a number that is not
 * finite, or lengths more than 2 % off. Smaller errors are rounded away. */

/* Quaternion x, y, z, w. */
bool rotation_of_quaternion(const double quaternion[4], double turn[4]);

/* Matrix, column by column: the body's axes in the room. */
bool rotation_of_columns(const double columns[9], double turn[4]);

/* Angles in rad about the body's own axes, first x, then y, then z: R = Rx Ry Rz. */
bool rotation_of_angles(const double angles[3], double turn[4]);

#endif
