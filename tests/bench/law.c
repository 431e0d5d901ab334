/* law.c: the motion law, judged against the same law in double. */
#include "benchmarks.h"
#include "exact_law.h"
#include "float_law.h"
#include "law_inputs.h"
#include "marks.h"
#include "q16_law.h"
#include "results.h"

#include <err.h>
#include <math.h>
#include <stdlib.h>

/* How far a law may be from the exact one. */
struct bounds {
    const char *name;
    double v, omega;
};

static const struct bounds of_fixed = {"the fixed-point law", 0.001, 0.06};
static const struct bounds of_float = {"the float baseline", 0.0001, 0.001};
static const struct bounds of_q16 = {"the Q16.16 baseline", 0.0005, 0.04};

static struct exact_law exact_input(const struct law_input *in)
{
    struct vec32 error = vec_sub(in->goal.at, in->own.at);

    return (struct exact_law){
        .theta = in->own.theta * 2 * M_PI / ANGLE_TURN,
        .error_x = metres(error.x),
        .error_y = metres(error.y),
        .vel_x = metres(in->goal.velocity.x),
        .vel_y = metres(in->goal.velocity.y),
        .acc_x = metres(in->goal.acceleration.x),
        .acc_y = metres(in->goal.acceleration.y),
        .k = (double)in->mission.k / GAIN_ONE,
        .k_theta = (double)in->mission.k_theta / GAIN_ONE,
        .v_max = metres(in->mission.v_max),
        .omega_max = (double)in->mission.omega_max / RATE_ONE,
    };
}

static void judge(const struct law_input *input, double v, double omega,
                  const struct bounds *bounds)
{
    struct exact_law in = exact_input(input);
    struct exact_command exact = exact_law(&in);

    if (fabs(v - exact.v) > bounds->v)
        errx(EXIT_FAILURE, "%s is wrong: v is %.4f m/s, exactly %.4f", bounds->name, v, exact.v);
    if (exact.judged && fabs(omega - exact.omega) > bounds->omega)
        errx(EXIT_FAILURE, "%s is wrong: omega is %.4f rad/s, exactly %.4f at |u| = %.3f m/s",
             bounds->name, omega, exact.omega, exact.u);
}

static void measure_fixed(struct marks *marks)
{
    uint32_t state = LAW_SEED;
    struct law_input input;

    for (uint16_t i = 0; i < LAW_INPUTS; i++) {
        struct motion_command command;

        law_input(&input, i, &state);
        figure_worst("fl_law_cycles_max", marks_measure(marks, &command, sizeof command));
        if (i < LAW_NEAR)
            judge(&input, metres(command.v), (double)command.omega / RATE_ONE, &of_fixed);
    }
}

static void measure_baselines(struct marks *marks)
{
    uint32_t state = LAW_SEED;
    struct law_input input;

    for (uint16_t i = 0; i < LAW_NEAR; i++) {
        struct float_command f;
        struct q16_command q;

        law_input(&input, i, &state);
        figure_worst_baseline("fl_law_cycles_max", "float", marks_measure(marks, &f, sizeof f));
        judge(&input, f.v, f.omega, &of_float);
        figure_worst_baseline("fl_law_cycles_max", "q16_16", marks_measure(marks, &q, sizeof q));
        judge(&input, (double)q.v / Q16_ONE, (double)q.omega / Q16_ONE, &of_q16);
    }
}

void measure_law(void)
{
    static struct marks marks;

    marks_open(&marks, "law");
    measure_fixed(&marks);
    measure_baselines(&marks);
    marks_close(&marks);
}
