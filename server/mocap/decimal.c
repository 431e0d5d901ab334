#include "decimal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LENGTH_MAX 63

static size_t digits(const char *text, size_t length)
{
    size_t count = 0;

    while (count < length && text[count] >= '0' && text[count] <= '9')
        count++;
    return count;
}

static size_t sign(const char *text, size_t length)
{
    return length > 0 && (text[0] == '-' || text[0] == '+');
}

/* strtod() takes more than decimal numbers, and other points in other countries. */
static bool is_decimal(const char *text, size_t length)
{
    size_t at = sign(text, length);
    size_t whole = digits(text + at, length - at);
    size_t fraction = 0;

    at += whole;
    if (at < length && text[at] == '.') {
        at++;
        fraction = digits(text + at, length - at);
        at += fraction;
    }
    if (whole + fraction == 0)
        return false;
    if (at < length && (text[at] == 'e' || text[at] == 'E')) {
        at++;
        at += sign(text + at, length - at);
        size_t exponent = digits(text + at, length - at);
        if (exponent == 0)
            return false;
        at += exponent;
    }
    return at == length;
}

bool decimal_read(const char *text, size_t length, double *value)
{
    char copy[LENGTH_MAX + 1];
    char *end;

    if (length > LENGTH_MAX || !is_decimal(text, length))
        return false;
    memcpy(copy, text, length);
    copy[length] = '\0';
    *value = strtod(copy, &end);
    return *end == '\0' && isfinite(*value);
}

bool decimal_read_whole(const char *text, size_t length, int64_t low, int64_t high, int64_t *value)
{
    bool minus = length > 0 && text[0] == '-';
    int64_t sum = 0;

    text += minus;
    length -= minus;
    if (length == 0 || length > 18 || digits(text, length) != length)
        return false;
    for (size_t i = 0; i < length; i++)
        sum = 10 * sum + (text[i] - '0');
    *value = minus ? -sum : sum;
    return *value >= low && *value <= high;
}
