/* param_table.h: what came out of parameter jobs, for people. Jobs that have failed are left
 * out. */
#ifndef PARAM_TABLE_H
#define PARAM_TABLE_H

#include "param.h"

#include <stdio.h>

/* The table itself: every parameter that there is, its range and what it is. */
void param_table_print_all(FILE *out);

/* What was read (`rows`, of param_bit()): a line for each robot, a column for each parameter. With
 * `folded` those that are the same in all robots stand above, a line each. Robots with values that
 * are not saved are marked, where PARAMETER_UNSAVED was read. */
void param_table_print(FILE *out, const struct param_job *jobs, size_t count, uint64_t rows,
                       bool folded);

/* What was changed: a line for each value, the old one and the new one. */
void param_table_print_changes(FILE *out, const struct param_job *jobs, size_t count);

#endif
