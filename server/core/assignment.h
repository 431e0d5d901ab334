/* assignment.h: the cheapest one-to-one assignment (the Hungarian problem), by shortest
 * augmenting paths with potentials, O(rows^2 columns). What a central planner that sees every
 * robot would do; CPA is compared with it. */
#ifndef ASSIGNMENT_H
#define ASSIGNMENT_H

#include <stddef.h>
#include <stdint.h>

/* The price of giving `column` to `row`, both from 0; finite. */
typedef double assignment_cost(const void *context, size_t row, size_t column);

#define ASSIGNMENT_NONE UINT32_MAX

/* One column's (and one row's) place in the working memory. */
struct assignment_node {
    uint32_t row;      /* matched to this column */
    uint32_t previous; /* column before it on the path */
    double row_potential, column_potential;
    double slack;
    uint8_t visited;
};

/* Gives every row a column of its own at the least total cost; rows <= columns. `nodes` has
 * columns + 1 entries. chosen[row] is the column. */
void assignment_solve(size_t rows, size_t columns, assignment_cost *cost, const void *context,
                      struct assignment_node *nodes, uint32_t *chosen);

#endif
