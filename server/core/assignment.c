#include "assignment.h"

#include <math.h>

/* Columns are numbered from 1 here; column 0 is where the row to be placed starts its path.
 * Row potentials live in the first `rows` nodes, beside the columns' own. */

static void reset_path(struct assignment_node *nodes, size_t columns)
{
    for (size_t j = 0; j <= columns; j++) {
        nodes[j].slack = INFINITY;
        nodes[j].visited = 0;
    }
}

/* Lowers the slack of every open column by way of `at`, and returns the least one's column. */
static size_t nearest_column(struct assignment_node *nodes, size_t columns, size_t at,
                             assignment_cost *cost, const void *context)
{
    uint32_t row = nodes[at].row;
    size_t nearest = 0;
    double least = INFINITY;

    for (size_t j = 1; j <= columns; j++) {
        struct assignment_node *node = &nodes[j];

        if (node->visited)
            continue;
        double reduced =
            cost(context, row, j - 1) - nodes[row].row_potential - node->column_potential;
        if (reduced < node->slack) {
            node->slack = reduced;
            node->previous = (uint32_t)at;
        }
        if (node->slack < least) {
            least = node->slack;
            nearest = j;
        }
    }
    return nearest;
}

static void shift_potentials(struct assignment_node *nodes, size_t columns, double by)
{
    for (size_t j = 0; j <= columns; j++) {
        struct assignment_node *node = &nodes[j];

        if (node->visited) {
            nodes[node->row].row_potential += by;
            node->column_potential -= by;
        } else {
            node->slack -= by;
        }
    }
}

static void place_row(struct assignment_node *nodes, size_t columns, uint32_t row,
                      assignment_cost *cost, const void *context)
{
    size_t at = 0;

    nodes[0].row = row;
    reset_path(nodes, columns);
    while (nodes[at].row != ASSIGNMENT_NONE) {
        nodes[at].visited = 1;
        size_t next = nearest_column(nodes, columns, at, cost, context);
        shift_potentials(nodes, columns, nodes[next].slack);
        at = next;
    }
    while (at != 0) {
        size_t previous = nodes[at].previous;
        nodes[at].row = nodes[previous].row;
        at = previous;
    }
}

void assignment_solve(size_t rows, size_t columns, assignment_cost *cost, const void *context,
                      struct assignment_node *nodes, uint32_t *chosen)
{
    for (size_t j = 0; j <= columns; j++)
        nodes[j] = (struct assignment_node){.row = ASSIGNMENT_NONE};
    for (uint32_t row = 0; row < rows; row++)
        place_row(nodes, columns, row, cost, context);
    for (size_t j = 1; j <= columns; j++)
        if (nodes[j].row != ASSIGNMENT_NONE)
            chosen[nodes[j].row] = (uint32_t)(j - 1);
}
