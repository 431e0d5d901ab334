#include "units.h"

#include <math.h>

int32_t wide_of(double metres)
{
    return (int32_t)lround(metres * NARROW_PER_M);
}

angle_t angle_of(double radians)
{
    double turns = radians / (2 * M_PI);

    return (angle_t)llround((turns - floor(turns)) * ANGLE_TURN);
}
