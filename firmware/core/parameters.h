/* parameters.h: what a robot keeps in its EEPROM, from address 0: the stored ones of
 * parameter_table.h, in two banks of PARAMETERS_BANK_BYTES.
 *
 *   byte 0       PARAMETERS_FORMAT
 *   byte 1       sequence: of two whole banks the one counts whose number is the later, modulo 256
 *   byte 2       how many values follow
 *   byte 3 ...   the values, 16 bits each, little-endian, in the table's order
 *   then         CRC-16 (frame.h) of all bytes before it, little-endian
 *
 * A save writes the bank that does not count, so one that is cut short loses nothing. A record with
 * fewer values than the table leaves the others at their defaults; of one with more the first are
 * read. A value that the table does not allow makes the record none. */
#ifndef PARAMETERS_H
#define PARAMETERS_H

#include "parameter_table.h"

#include <stdbool.h>
#include <stdint.h>

#define PARAMETERS_FORMAT 2
#define PARAMETERS_BANK_BYTES 64
#define PARAMETERS_BYTES (2 * PARAMETERS_BANK_BYTES)
#define PARAMETERS_HEAD_BYTES 3
#define PARAMETERS_RECORD_BYTES (PARAMETERS_HEAD_BYTES + 2 * PARAMETERS_STORED_COUNT + 2)

struct parameters {
    uint16_t value[PARAMETERS_STORED_COUNT];
};

/* Where they were found. */
struct parameters_source {
    uint8_t whole;    /* banks that are, 0 to 2 */
    uint8_t bank;     /* the one that counts, 0 or 1; a save goes to the other one. 1 where none
                         is whole */
    uint8_t sequence; /* its number */
};

void parameters_default(struct parameters *parameters);

/* Whether that one may have this value; false for an index that is no stored one's. */
bool parameters_allow(uint8_t index, uint32_t value);

/* All defaults where no bank is whole. */
struct parameters_source parameters_read(struct parameters *parameters,
                                         const uint8_t eeprom[PARAMETERS_BYTES]);

void parameters_record(const struct parameters *parameters, uint8_t sequence,
                       uint8_t record[PARAMETERS_RECORD_BYTES]);

/* The whole EEPROM area of a robot that has just been given these. */
void parameters_write(uint8_t eeprom[PARAMETERS_BYTES], const struct parameters *parameters);

#endif
