/* figure.h: a figure as this project has it: pictures, numbers, and what they say of the paper's
 * claims. Filled in by figures.h, written out by report.h. */
#ifndef PAPER_FIGURE_H
#define PAPER_FIGURE_H

#include "panel.h"
#include "runs.h"

#include <stdbool.h>
#include <stddef.h>

#define FINDINGS_MAX 5
#define TABLES_MAX 2
#define PANELS_MAX 8
#define COLUMNS_MAX 10
#define CELLS_MAX 200
#define REASON_MAX 1000
#define CELL_MAX 48

enum verdict { HOLDS, FAILS, UNTOLD };

/* A claim and what became of it. */
struct finding {
    const char *claim;
    enum verdict verdict;
    char reason[REASON_MAX];
};

struct column {
    const char *key;  /* in summary.json */
    const char *head; /* for readers, with the unit */
};

struct cell {
    char text[CELL_MAX];
    bool number; /* else words */
};

/* Row after row. */
struct table {
    const char *title;
    const struct column *column;
    size_t columns, cells;
    struct cell cell[CELLS_MAX];
};

struct figure {
    int number;
    const char *title;
    const char *shows; /* what is seen, and how it came about */
    size_t findings, tables, panels;
    struct finding finding[FINDINGS_MAX];
    struct table table[TABLES_MAX];
    struct panel panel[PANELS_MAX];
};

extern const char *const verdict_words[];

/* Adds a claim; the words say why the verdict is what it is. The first is the figure's own. */
void figure_find(struct figure *figure, const char *claim, enum verdict verdict, const char *format,
                 ...) __attribute__((format(printf, 4, 5)));

/* Adds an empty table; `column` ends with a key of NULL. */
struct table *figure_table(struct figure *figure, const char *title, const struct column *column);

/* The next cell; a number that is not finite says "never". */
void table_words(struct table *table, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void table_number(struct table *table, double number, int decimals);

/* Adds a panel of one run. */
struct panel *figure_panel(struct figure *figure, panel_draw *draw, const struct run *run,
                           const char *format, ...) __attribute__((format(printf, 4, 5)));

#endif
