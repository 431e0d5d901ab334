/* eeprom.h: where the chip keeps the robot's parameters (parameters.h). */
#ifndef EEPROM_H
#define EEPROM_H

#include "parameters.h"

void eeprom_read(uint8_t bytes[PARAMETERS_BYTES]);

/* Begins to write a byte, unless it is there already. It takes 9 ms, for which the next call of any
 * of these would wait. */
void eeprom_store(uint8_t at, uint8_t byte);

uint8_t eeprom_byte(uint8_t at);

#endif
