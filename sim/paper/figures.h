/* figures.h: which figures there are, and what each says of the paper's claims. */
#ifndef PAPER_FIGURES_H
#define PAPER_FIGURES_H

#include "figure.h"
#include "runs.h"

#define FIGURE_COUNT 14

/* Figures are counted 0 to FIGURE_COUNT - 1; this is what the paper calls them. */
int figure_number(size_t i);

/* Fills in figure `i`, once the runs that it shows are done. */
void figure_fill(struct figure *figure, size_t i, const struct runs *runs);

/* The figures of one kind each, of the runs they are given. */
void figure_of_laws(struct figure *figure, const struct runs *runs);
void figure_of_fault_routes(struct figure *figure, const struct run *run);
void figure_of_fault_roles(struct figure *figure, const struct run *run);
void figure_of_fault_errors(struct figure *figure, const struct run *run);
void figure_of_change_routes(struct figure *figure, const struct run *run);
void figure_of_change_vertices(struct figure *figure, const struct run *run);
void figure_of_change(struct figure *figure, const struct run *run); /* both */
void figure_of_change_errors(struct figure *figure, const struct run *run);
void figure_of_schemes(struct figure *figure, const struct runs *runs);
void figure_of_hundred(struct figure *figure, const struct runs *runs);

#endif
