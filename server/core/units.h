/* units.h: from SI units to those of the wire (common/fixed.h). */
#ifndef UNITS_H
#define UNITS_H

#include "fixed.h"

/* m; the caller has checked the range. */
int32_t wide_of(double metres);

/* rad, any number of turns. */
angle_t angle_of(double radians);

#endif
