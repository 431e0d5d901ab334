#include "parameter_words.h"

#include "expression.h"
#include "text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define STORED_LINE(symbol, name, unit, per_unit, low, high, unless_set, about)                    \
    [PARAMETER_##symbol] = {name, unit, about, per_unit, low, high, unless_set},
#define READING_LINE(symbol, name, unit, per_unit, about)                                          \
    [PARAMETER_##symbol - PARAMETERS_READ_FROM] = {name, unit, about, per_unit, 0, 0, 0},

static const struct parameter_line stored[] = {PARAMETERS_STORED(STORED_LINE)};
static const struct parameter_line readings[] = {PARAMETER_READINGS(READING_LINE)};

enum { STORED = PARAMETERS_STORED_COUNT, READINGS = PARAMETERS_END - PARAMETERS_READ_FROM };

const struct parameter_line *parameter_line(uint8_t index)
{
    if (index < STORED)
        return &stored[index];
    if (index >= PARAMETERS_READ_FROM && index < PARAMETERS_END)
        return &readings[index - PARAMETERS_READ_FROM];
    return NULL;
}

bool parameter_is_stored(uint8_t index)
{
    return index < STORED;
}

static bool refuse_name(const char *name, char *error, size_t room)
{
    const char *known[STORED + READINGS + 1];
    size_t count = 0;

    for (int i = 0; i < STORED; i++)
        known[count++] = stored[i].name;
    for (int i = 0; i < READINGS; i++)
        known[count++] = readings[i].name;
    known[count] = NULL;

    const char *nearest = text_nearest(name, known);
    if (nearest != NULL)
        snprintf(error, room, "no parameter is called '%.60s'; perhaps '%s'", name, nearest);
    else
        snprintf(error, room, "no parameter is called '%.60s'; 'muster param list' names them",
                 name);
    return false;
}

bool parameter_find(const char *name, uint8_t *index, char *error, size_t room)
{
    for (unsigned i = 0; i < PARAMETERS_END; i++) {
        const struct parameter_line *line = parameter_line((uint8_t)i);

        if (line == NULL || strcmp(line->name, name) != 0)
            continue;
        *index = (uint8_t)i;
        return true;
    }
    return refuse_name(name, error, room);
}

/* Digits after the point, so that no two values have the same. */
static int decimals(const struct parameter_line *line)
{
    return (int)ceil(log10(line->per_unit));
}

double parameter_of(uint8_t index, uint32_t value)
{
    return (double)value / parameter_line(index)->per_unit;
}

const char *parameter_number(uint8_t index, uint32_t value, char words[PARAMETER_WORDS_MAX])
{
    if (index == PARAMETER_IMAGE)
        snprintf(words, PARAMETER_WORDS_MAX, "%08lX", (unsigned long)value);
    else
        snprintf(words, PARAMETER_WORDS_MAX, "%.*f", decimals(parameter_line(index)),
                 parameter_of(index, value));
    return words;
}

const char *parameter_words(uint8_t index, uint32_t value, char words[PARAMETER_WORDS_MAX])
{
    const char *unit = parameter_line(index)->unit;
    size_t length = strlen(parameter_number(index, value, words));

    if (unit[0] != '\0')
        snprintf(words + length, PARAMETER_WORDS_MAX - length, " %s", unit);
    return words;
}

static bool refuse_number(uint8_t index, double number, char *error, size_t room)
{
    const struct parameter_line *line = parameter_line(index);
    bool whole = line->per_unit == 1;
    int digits = whole ? 5 : 4; /* a bound that is round in units was rounded to a whole number */

    snprintf(error, room, "%s is %.10g; a %snumber from %.*g to %.*g%s%s is allowed", line->name,
             number, whole ? "whole " : "", digits, parameter_of(index, line->low), digits,
             parameter_of(index, line->high), line->unit[0] != '\0' ? " " : "", line->unit);
    return false;
}

bool parameter_round(uint8_t index, double number, uint16_t *value, char *error, size_t room)
{
    const struct parameter_line *line = parameter_line(index);
    double whole = round(number * line->per_unit);

    if (!(whole >= line->low && whole <= line->high) || (line->per_unit == 1 && whole != number))
        return refuse_number(index, number, error, room);
    *value = (uint16_t)whole;
    return true;
}

bool parameter_value(uint8_t index, const char *text, uint16_t *value, char *error, size_t room)
{
    static const char *const no_names[] = {NULL};
    const char *name = parameter_line(index)->name;
    char reason[256];

    if (!parameter_is_stored(index)) {
        snprintf(error, room, "%s is a reading; only stored parameters can be set", name);
        return false;
    }
    struct expression *expression = expression_new(text, no_names, reason, sizeof reason);
    if (expression == NULL) {
        snprintf(error, room, "%s is '%.60s', no number: %s", name, text, reason);
        return false;
    }
    double number = expression_value(expression, NULL);
    expression_free(expression);
    return parameter_round(index, number, value, error, room);
}
