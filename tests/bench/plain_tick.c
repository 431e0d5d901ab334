/* plain_tick.c: what a follower reckons in a tick, plainly; judged by the same in double. */
#include "benchmarks.h"
#include "exact_fight.h"
#include "exact_law.h"
#include "marks.h"
#include "results.h"

#include <err.h>
#include <math.h>
#include <stdlib.h>

/* How far a wheel's set-point may be from the exact one, parts of full scale. */
#define WHEEL_BOUND 0.005

/* As an image tells it; packed as on the chip. */
struct told {
    union {
        float f;
        int32_t q;
    } left, right;
    uint16_t held;
} __attribute__((packed));

struct wheels {
    double left, right; /* parts of full scale */
    bool judged;
};

static struct exact_command command_towards(const struct exact_fight *exact,
                                            const struct motion *own, uint16_t vertex)
{
    const struct motion *base = &exact->base;
    double dx = exact->vertex[vertex].x - base->at.x;
    double dy = exact->vertex[vertex].y - base->at.y;
    double vel_x = base->v * cos(base->theta) - base->omega * dy;
    double vel_y = base->v * sin(base->theta) + base->omega * dx;
    struct exact_law in = {.theta = own->theta,
                           .error_x = exact->vertex[vertex].x - own->at.x,
                           .error_y = exact->vertex[vertex].y - own->at.y,
                           .vel_x = vel_x,
                           .vel_y = vel_y,
                           .acc_x = -base->omega * vel_y,
                           .acc_y = base->omega * vel_x,
                           .k = (double)FIGHT_K / GAIN_ONE,
                           .k_theta = (double)FIGHT_K_THETA / GAIN_ONE,
                           .v_max = metres(FIGHT_V_MAX),
                           .omega_max = (double)FIGHT_OMEGA_MAX / RATE_ONE};

    return exact_law(&in);
}

static struct wheels wheels_of(const struct exact_command *command)
{
    double half = command->omega * metres(FIGHT_TRACK) / 2;
    double left = command->v - half, right = command->v + half;
    double fastest = fmax(fmax(fabs(left), fabs(right)), metres(FIGHT_WHEEL_MAX));

    return (struct wheels){left / fastest, right / fastest, command->judged};
}

static void judge(uint16_t number, const char *who, uint16_t held, double left, double right)
{
    struct fight fight = fight_begin(fight_in_tick, number);
    struct motion base = exact_base(&fight), own = exact_own(&fight);
    struct exact_fight exact;

    motion_advance(&base, FIGHT_BASE_AGE / 1000.0);
    motion_advance(&own, FIGHT_OWN_AGE / 1000.0);
    exact_prepare(&exact, &fight, &base, own.at);
    uint16_t vertex = exact_allocate(&exact);
    if (held != vertex && (held > fight.size.vertices || !exact_is_tied(&exact, held, vertex)))
        errx(EXIT_FAILURE, "the tick in %s holds vertex %u, not %u, in fight %u", who, held, vertex,
             number);
    if (held == 0)
        return;
    struct exact_command command = command_towards(&exact, &own, held);
    struct wheels wheels = wheels_of(&command);
    if (wheels.judged &&
        (fabs(wheels.left - left) > WHEEL_BOUND || fabs(wheels.right - right) > WHEEL_BOUND))
        errx(EXIT_FAILURE, "the tick in %s drives at (%.4f, %.4f), not (%.4f, %.4f), in fight %u",
             who, left, right, wheels.left, wheels.right, number);
}

void measure_plain_ticks(void)
{
    static struct marks marks;
    const double one = 65536;

    marks_open(&marks, "plain_tick");
    for (uint16_t i = 0; i < FIGHTS_PLAIN; i++) {
        struct told told;

        figure_worst_baseline("tick_100_cycles_max", "float",
                              marks_measure(&marks, &told, sizeof told));
        judge(i, "float", told.held, told.left.f, told.right.f);
        figure_worst_baseline("tick_100_cycles_max", "q16_16",
                              marks_measure(&marks, &told, sizeof told));
        judge(i, "Q16.16", told.held, told.left.q / one, told.right.q / one);
    }
    marks_close(&marks);
}
