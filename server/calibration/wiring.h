/* wiring.h: which motor turns, and which way, when one alone is told to. */
#ifndef WIRING_H
#define WIRING_H

#include "wheel_fit.h"

/* False when motors are swapped, turn backwards or stand, or the heading of the body in motion
 * capture is not the robot's: then `words` say what is to be done. */
bool wiring_is_right(const struct drive_record *record, const struct drive_wheels *wheels,
                     char words[WHEEL_FIT_WORDS_MAX]);

#endif
