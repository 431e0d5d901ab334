/* law.c: the motion law, judged against the same law in double. */
#include "benchmarks.h"
#include "float_law.h"
#include "law_inputs.h"
#include "marks.h"
#include "q16_law.h"
#include "results.h"

#include <err.h>
#include <math.h>
#include <stdlib.h>

/* Below this |u| the direction of u is coarse: only v is compared. m/s */
#define JUDGED_M_S 0.064

struct law_output {
    double v, omega; /* m/s, rad/s */
};

/* How far a law may be from the exact one. */
struct bounds {
    const char *name;
    double v, omega;
};

static const struct bounds of_fixed = {"the fixed-point law", 0.001, 0.06};
static const struct bounds of_float = {"the float baseline", 0.0001, 0.001};
static const struct bounds of_q16 = {"the Q16.16 baseline", 0.0005, 0.04};

static double metres(int32_t value)
{
    return (double)value / NARROW_PER_M;
}

static double clamp(double value, double limit)
{
    return fmin(fmax(value, -limit), limit);
}

/* Returns |u|, 0 where the heading error is so near half a turn that its sign is chance. */
static double exact_law(const struct law_input *in, struct law_output *out)
{
    double theta = in->own.theta * 2 * M_PI / ANGLE_TURN;
    double k = (double)in->mission.k / GAIN_ONE;
    double k_theta = (double)in->mission.k_theta / GAIN_ONE;
    double ux = metres(in->velocity.x) + k * metres(in->at.x - in->own.at.x);
    double uy = metres(in->velocity.y) + k * metres(in->at.y - in->own.at.y);
    double v = clamp(ux * cos(theta) + uy * sin(theta), metres(in->mission.v_max));
    double ux_dot = metres(in->acceleration.x) + k * (metres(in->velocity.x) - v * cos(theta));
    double uy_dot = metres(in->acceleration.y) + k * (metres(in->velocity.y) - v * sin(theta));
    double turn = (ux * uy_dot - uy * ux_dot) / (ux * ux + uy * uy);
    double off = remainder(atan2(uy, ux) - theta, 2 * M_PI);

    out->v = v;
    out->omega = clamp(turn + k_theta * off, (double)in->mission.omega_max / RATE_ONE);
    return fabs(off) < 0.99 * M_PI ? hypot(ux, uy) : 0;
}

static void judge(const struct law_input *input, struct law_output got, const struct bounds *bounds)
{
    struct law_output exact;
    double u = exact_law(input, &exact);

    if (fabs(got.v - exact.v) > bounds->v)
        errx(EXIT_FAILURE, "%s is wrong: v is %.4f m/s, exactly %.4f", bounds->name, got.v,
             exact.v);
    if (u >= JUDGED_M_S && fabs(got.omega - exact.omega) > bounds->omega)
        errx(EXIT_FAILURE, "%s is wrong: omega is %.4f rad/s, exactly %.4f at |u| = %.3f m/s",
             bounds->name, got.omega, exact.omega, u);
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
            judge(&input, (struct law_output){metres(command.v), (double)command.omega / RATE_ONE},
                  &of_fixed);
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
        judge(&input, (struct law_output){f.v, f.omega}, &of_float);
        figure_worst_baseline("fl_law_cycles_max", "q16_16", marks_measure(marks, &q, sizeof q));
        judge(&input, (struct law_output){(double)q.v / Q16_ONE, (double)q.omega / Q16_ONE},
              &of_q16);
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
