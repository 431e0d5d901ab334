/* parameter_words.h: a robot's parameters (parameter_table.h) as people read and write them: by
 * name, in their units. */
#ifndef PARAMETER_WORDS_H
#define PARAMETER_WORDS_H

#include "parameter_table.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A line of the table. */
struct parameter_line {
    const char *name, *unit, *about; /* unit: "" where there is none */
    uint16_t per_unit;
    uint16_t low, high, unless_set; /* whole numbers; 0 for readings */
};

/* Indices are 0 to PARAMETERS_STORED_COUNT - 1 and, of readings, PARAMETERS_READ_FROM to
 * PARAMETERS_END - 1. NULL for others. */
const struct parameter_line *parameter_line(uint8_t index);

bool parameter_is_stored(uint8_t index);

/* False, and words in `error`, for a name that is none. */
bool parameter_find(const char *name, uint8_t *index, char *error, size_t room);

#define PARAMETER_WORDS_MAX 24

/* "0.95300", "7.400 V", "1F0C55AA" of the image: as many digits as it takes for parameter_value()
 * to make the same value of them. Returns `words`. */
const char *parameter_words(uint8_t index, uint32_t value, char words[PARAMETER_WORDS_MAX]);

/* The same without the unit. */
const char *parameter_number(uint8_t index, uint32_t value, char words[PARAMETER_WORDS_MAX]);

/* What a stored one is to be set to: a number, or an expression (expression.h), in its unit. False,
 * and words in `error`, when it is none or out of range, and for readings. */
bool parameter_value(uint8_t index, const char *text, uint16_t *value, char *error, size_t room);

/* The whole number nearest to `number` units. False, and words in `error`, when the table does not
 * allow it. */
bool parameter_round(uint8_t index, double number, uint16_t *value, char *error, size_t room);

/* In units. */
double parameter_of(uint8_t index, uint32_t value);

#endif
