#include "eeprom.h"

#include <avr/eeprom.h>

/* All there is in this section, so it lies at address 0. The image brings it blank: a robot gets
 * its id apart from its program. */
static uint8_t stored[PARAMETERS_BYTES] EEMEM = {[0 ... PARAMETERS_BYTES - 1] = 0xFF};

void eeprom_read(uint8_t bytes[PARAMETERS_BYTES])
{
    eeprom_read_block(bytes, stored, PARAMETERS_BYTES);
}

void eeprom_store(uint8_t at, uint8_t byte)
{
    eeprom_update_byte(&stored[at], byte);
}

uint8_t eeprom_byte(uint8_t at)
{
    return eeprom_read_byte(&stored[at]);
}
