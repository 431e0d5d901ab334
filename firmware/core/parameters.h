/* parameters.h: what a robot keeps in its EEPROM, at address 0.
 *
 *   byte 0     PARAMETERS_VERSION
 *   byte 1, 2  id, little-endian, 1..65,534
 *   byte 3, 4  CRC-16 (frame.h) of the bytes before it, little-endian
 *
 * A record of another version or with a wrong CRC is no record: the robot then has no id, says
 * so in its status and does not move. A newer version appends before the CRC. */
#ifndef PARAMETERS_H
#define PARAMETERS_H

#include <stdbool.h>
#include <stdint.h>

#define PARAMETERS_VERSION 1
#define PARAMETERS_BYTES 5

struct parameters {
    uint16_t id; /* 0 = none */
};

void parameters_write(uint8_t record[PARAMETERS_BYTES], const struct parameters *parameters);

/* False, and id 0, when the record is not valid. */
bool parameters_read(struct parameters *parameters, const uint8_t record[PARAMETERS_BYTES]);

#endif
