/* expression.h: the arithmetic of scenario files.
 *
 * Decimal numbers, pi, the names it is given, + - * / ^, comparisons, && ||, c ? a : b and
 * EXPRESSION_FUNCTIONS. A comparison is 1 or 0; ^ binds to the right and before a sign (-2^2 is
 * -4). muParser computes; what it would take besides (assignments, lists, strings, further
 * functions) is refused before it sees it. */
#ifndef SCENARIO_EXPRESSION_H
#define SCENARIO_EXPRESSION_H

#include <stdbool.h>
#include <stddef.h>

#define EXPRESSION_NAMES_MAX 4

#define EXPRESSION_FUNCTIONS                                                                       \
    "sin cos tan asin acos atan atan2 sinh cosh tanh exp ln sqrt abs min max floor"

struct expression;

/* `names`, up to EXPRESSION_NAMES_MAX and then NULL, are what the text may refer to. NULL when
 * the text is refused; `error` then holds the reason, without a position. */
struct expression *expression_new(const char *text, const char *const *names, char *error,
                                  size_t room);

/* The value where the names have `values`, in their order. May be NAN or infinite. Not for two
 * threads at once on the same expression. */
double expression_value(const struct expression *expression, const double *values);

/* Whether the text refers to none of the names. */
bool expression_is_constant(const struct expression *expression);

void expression_free(struct expression *expression);

#endif
