/* benchmarks.h: what there is to measure. Each function sets its figures (results.h), and ends the
 * program, with words, when something cannot be measured or a baseline disagrees. */
#ifndef BENCHMARKS_H
#define BENCHMARKS_H

/* On a simulated chip, exact. */
void measure_arithmetic(void);
void measure_law(void);
void measure_allocation(void);
void measure_frame(void);
void measure_ticks(void);
void measure_plain_ticks(void);

/* What the images take of the chip's memories. */
void measure_sizes(void);

/* Whole fleets of chips: the busiest processor and the deepest stack, exact too. After
 * measure_sizes(). */
void measure_loads(void);

/* Of this machine. */
void measure_speeds(void);
void measure_view(void);
void measure_robot_memory(void);
void measure_serve(void);

#endif
