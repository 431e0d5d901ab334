/* tables.h: functions of a fraction i / 256, for linear interpolation. They lie in flash on the
 * chip: rom.h reads them. Neighbouring entries differ by less than 256. */
#ifndef TABLES_H
#define TABLES_H

#include <stdint.h>

extern const uint16_t sine_table[257];       /* sin(i / 256 quarter turns), Q1.15 */
extern const uint16_t arctangent_table[257]; /* atan(i / 256), quarter units of an angle */
extern const uint16_t reciprocal_table[257]; /* 2^30 / (2^15 + 128 i), at most 32,767 */
extern const uint16_t falloff_table[257];    /* 1 / (1 + (i / 256)^2), Q1.15 */

#endif
