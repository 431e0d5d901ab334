#include "eeprom.h"

#include <avr/eeprom.h>

/* All there is in this section, so it lies at address 0. The image brings a blank record: a robot
 * gets its id apart from its program. */
static uint8_t stored[PARAMETERS_BYTES] EEMEM = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

void eeprom_read(struct parameters *parameters)
{
    uint8_t record[PARAMETERS_BYTES];

    eeprom_read_block(record, stored, sizeof record);
    parameters_read(parameters, record);
}
