/* tick.c: whole control ticks; they have to be what they are taken for. */
#include "ticks.h"

#include "benchmarks.h"
#include "limits.h"
#include "marks.h"
#include "results.h"

#include <err.h>
#include <stdlib.h>

/* Ticks until every neighbour has been heard. */
#define ACQUAINTANCE 10

static bool drives(const struct tick_result *tick)
{
    return tick->left != 0 || tick->right != 0;
}

static void measure_full(struct marks *marks)
{
    unsigned fights = 0;
    uint16_t held = 0;

    for (int i = 0; i < TICKS_FULL; i++) {
        struct tick_result tick;
        uint32_t decoding = marks_measure(marks, NULL, 0);
        uint32_t step = marks_measure(marks, &tick, sizeof tick);

        figure_worst("ring_255_cycles_max", decoding);
        figure_worst("tick_100_cycles_max", decoding + step);
        if (i >= ACQUAINTANCE && (tick.neighbours != NEIGHBOURS_MAX || tick.sent == 0))
            errx(EXIT_FAILURE, "full tick %d has %u neighbours and sends %u bytes", i,
                 tick.neighbours, tick.sent);
        fights += tick.held != held;
        held = tick.held;
    }
    if (fights < TICKS_FULL / 20)
        errx(EXIT_FAILURE, "in %d full ticks the vertex changes only %u times", TICKS_FULL, fights);
}

static void measure_quiet(struct marks *marks)
{
    for (int i = 0; i < TICKS_QUIET; i++) {
        struct tick_result tick;
        uint32_t decoding = marks_measure(marks, NULL, 0);
        uint32_t step = marks_measure(marks, &tick, sizeof tick);

        if (!drives(&tick) || tick.neighbours < NEIGHBOURS_MAX - 1)
            errx(EXIT_FAILURE, "in quiet tick %d the robot does not drive among its neighbours", i);
        if (tick.sent == 0)
            figure_worst("tick_quiet_cycles_max", decoding + step);
    }
}

void measure_ticks(void)
{
    static struct marks marks;

    marks_open(&marks, "tick");
    measure_full(&marks);
    measure_quiet(&marks);
    marks_close(&marks);
}
