/* drawing.h: what maps and graphs draw alike. */
#ifndef DRAWING_H
#define DRAWING_H

#include "chart.h"
#include "panel.h"

/* Pixels. */
#define NARROW 460
#define WIDE 940

double panel_width(const struct panel *panel);

/* The last tick of a run that the panel shows. */
size_t panel_end(const struct panel *panel, const struct history *history);

/* Many robots are drawn finely, in a scale of colours, and have no names. */
bool is_crowd(const struct history *history);

/* Ticks from one point of a line to the next. */
size_t panel_stride(const struct panel *panel, const struct history *history);

/* The classes of a robot's colour: c0 to c7 are told apart, m0 to m9 are a scale. The second puts
 * one more class beside it and is good until the next call. */
const char *robot_class(const struct history *history, size_t robot);
const char *robot_classes(const struct history *history, size_t robot, const char *more);

/* The class of the i-th of several runs. */
const char *run_class(size_t i);

void draw_key_of_robots(struct chart *chart, const struct history *history);

#endif
