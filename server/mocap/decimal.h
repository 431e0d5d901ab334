/* decimal.h: numbers written in decimal, strictly: all of the text has to be the number. */
#ifndef DECIMAL_H
#define DECIMAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Digits with a sign, a point and an exponent where there are any, finite. False otherwise. */
bool decimal_read(const char *text, size_t length, double *value);

/* Digits alone, with a minus where there is one, from `low` to `high`. False otherwise. */
bool decimal_read_whole(const char *text, size_t length, int64_t low, int64_t high, int64_t *value);

#endif
