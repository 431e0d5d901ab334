#include "figure.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

const char *const verdict_words[] = {
    [HOLDS] = "holds",
    [FAILS] = "does not hold",
    [UNTOLD] = "cannot be told from print",
};

void figure_find(struct figure *figure, const char *claim, enum verdict verdict, const char *format,
                 ...)
{
    struct finding *finding = &figure->finding[figure->findings++];
    va_list arguments;

    finding->claim = claim;
    finding->verdict = verdict;
    va_start(arguments, format);
    vsnprintf(finding->reason, sizeof finding->reason, format, arguments);
    va_end(arguments);
}

struct table *figure_table(struct figure *figure, const char *title, const struct column *column)
{
    struct table *table = &figure->table[figure->tables++];

    *table = (struct table){.title = title, .column = column};
    while (column[table->columns].key != NULL)
        table->columns++;
    return table;
}

void table_words(struct table *table, const char *format, ...)
{
    struct cell *cell = &table->cell[table->cells++];
    va_list arguments;

    cell->number = false;
    va_start(arguments, format);
    vsnprintf(cell->text, sizeof cell->text, format, arguments);
    va_end(arguments);
}

void table_number(struct table *table, double number, int decimals)
{
    if (!isfinite(number)) {
        table_words(table, "never");
        return;
    }
    struct cell *cell = &table->cell[table->cells++];
    cell->number = true;
    snprintf(cell->text, sizeof cell->text, "%.*f", decimals, number);
}

struct panel *figure_panel(struct figure *figure, panel_draw *draw, const struct run *run,
                           const char *format, ...)
{
    struct panel *panel = &figure->panel[figure->panels++];
    va_list arguments;

    *panel = (struct panel){.draw = draw};
    panel_add(panel, &run->history, NULL);
    va_start(arguments, format);
    vsnprintf(panel->caption, sizeof panel->caption, format, arguments);
    va_end(arguments);
    return panel;
}
