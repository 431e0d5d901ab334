/* eeprom.h: the robot's record in the chip's EEPROM (parameters.h). */
#ifndef EEPROM_H
#define EEPROM_H

#include "parameters.h"

/* id 0 when there is no valid record. */
void eeprom_read(struct parameters *parameters);

#endif
