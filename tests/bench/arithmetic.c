/* arithmetic.c: what control ticks are made of, and how exact a direction is. */
#include "arithmetic_inputs.h"
#include "benchmarks.h"
#include "marks.h"
#include "results.h"

#include <math.h>

/* |u| from which a direction is asked to be exact: 16 mm/s. */
#define JUDGED (NARROW_PER_M * 16 / 1000)

static double direction_error(struct vec16 v, angle_t direction)
{
    double exact = atan2(v.y, v.x) / (2 * M_PI) * ANGLE_TURN;

    return fabs(remainder(direction - exact, ANGLE_TURN));
}

void measure_arithmetic(void)
{
    static struct marks marks;
    uint32_t state = ARITHMETIC_SEED;

    marks_open(&marks, "arithmetic");
    for (uint16_t i = 0; i < ARITHMETIC_INPUTS; i++) {
        struct vec16 v = arithmetic_vector(i, &state);
        angle_t direction;

        figure_worst("direction_cycles_max", marks_measure(&marks, &direction, sizeof direction));
        if (hypot(v.x, v.y) >= JUDGED)
            figure_worst("heading_error_turn65536", direction_error(v, direction));
        figure_worst("sincos_cycles_max", marks_measure(&marks, NULL, 0));
        figure_worst("pose_advance_cycles_max", marks_measure(&marks, NULL, 0));
    }
    marks_close(&marks);
}
