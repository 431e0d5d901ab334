/* allocation.c: passes of allocation, judged against Algorithm 1 in double. */
#include "benchmarks.h"
#include "exact_fight.h"
#include "marks.h"
#include "results.h"

#include <err.h>
#include <stdio.h>
#include <stdlib.h>

static void judge(const struct fight *fight, uint16_t number, uint16_t chosen, const char *who)
{
    struct motion base = exact_base(fight), own = exact_own(fight);
    struct exact_fight exact;

    exact_prepare(&exact, fight, &base, own.at);
    uint16_t right = exact_allocate(&exact);
    if (chosen != right && (chosen > fight->size.vertices || !exact_is_tied(&exact, chosen, right)))
        errx(EXIT_FAILURE, "%s chooses vertex %u, not %u, in fight %u of %u vertices and %u others",
             who, chosen, right, number, fight->size.vertices, fight->size.neighbours);
}

static const char *figure_name(struct fight_size size)
{
    static char name[40];

    snprintf(name, sizeof name, "cpa_%u_%u_cycles_max", size.vertices, size.neighbours);
    return name;
}

static void measure_fixed(void)
{
    static struct marks marks;

    marks_open(&marks, "allocation");
    for (int s = 0; s < FIGHT_SIZES; s++)
        for (uint16_t i = 0; i < FIGHTS; i++) {
            struct fight fight = fight_begin(fight_sizes[s], i);
            uint16_t chosen;

            figure_worst(figure_name(fight.size), marks_measure(&marks, &chosen, sizeof chosen));
            judge(&fight, i, chosen, "the allocation");
        }
    marks_close(&marks);
}

static void measure_baseline(struct marks *marks, const struct fight *fight, uint16_t number,
                             const char *baseline)
{
    uint16_t chosen;
    uint32_t cycles = marks_measure(marks, &chosen, sizeof chosen);

    figure_worst_baseline(figure_name(fight->size), baseline, cycles);
    judge(fight, number, chosen, baseline);
}

static void measure_baselines(void)
{
    static struct marks marks;

    marks_open(&marks, "plain_allocation");
    for (int s = 0; s < FIGHT_SIZES; s++)
        for (uint16_t i = 0; i < FIGHTS_PLAIN; i++) {
            struct fight fight = fight_begin(fight_sizes[s], i);

            measure_baseline(&marks, &fight, i, "float");
            measure_baseline(&marks, &fight, i, "q16_16");
        }
    marks_close(&marks);
}

void measure_allocation(void)
{
    measure_fixed();
    measure_baselines();
}
