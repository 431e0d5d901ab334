/* eeprom.h: where the chip keeps the robot's parameters (parameters.h). */
#ifndef EEPROM_H
#define EEPROM_H

#include "parameters.h"

void eeprom_read(uint8_t bytes[PARAMETERS_BYTES]);

#endif
