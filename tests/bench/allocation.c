/* allocation.c: passes of allocation, judged against Algorithm 1 in double. */
#include "benchmarks.h"
#include "fights.h"
#include "marks.h"
#include "results.h"

#include <err.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Two distances that differ by less than this, m, may be taken for the same, and the other vertex
 * be chosen: a few units of the coarsest numbers that are compared. */
#define TIE_NEAR 0.02
#define TIE_FAR 0.1

struct point {
    double x, y; /* m */
};

/* A fight in double. */
struct exact {
    const struct fight *fight;
    double own[VERTICES_MAX_CHIP + 1];   /* from the robot to vertex 1.., m */
    double rival[VERTICES_MAX_CHIP + 1]; /* from the closest of those that hold it */
    bool taboo[VERTICES_MAX_CHIP + 1];
};

static double metres(int32_t value)
{
    return (double)value / NARROW_PER_M;
}

static double radians(angle_t angle)
{
    return angle * 2 * M_PI / ANGLE_TURN;
}

static double distance(struct point a, struct point b)
{
    return hypot(a.x - b.x, a.y - b.y);
}

static struct point place_of(const struct fight *fight, struct vec16 place)
{
    double unit = ldexp(1.0 / NARROW_PER_M, fight->scale);
    double c = cos(radians(fight->base.theta)), s = sin(radians(fight->base.theta));

    return (struct point){metres(fight->base.at.x) + unit * (place.x * c - place.y * s),
                          metres(fight->base.at.y) + unit * (place.x * s + place.y * c)};
}

static struct point position_of(const struct fight *fight, const struct neighbour *n)
{
    double age = (uint16_t)(fight->now - n->time) / 1000.0;
    double middle = radians(n->pose.theta) + (double)n->omega / RATE_ONE * age / 2;
    double chord = metres(n->v) * age;

    return (struct point){metres(n->pose.at.x) + chord * cos(middle),
                          metres(n->pose.at.y) + chord * sin(middle)};
}

static void prepare(struct exact *exact, const struct fight *fight)
{
    struct point own = {metres(fight->own.x), metres(fight->own.y)};
    struct point vertex[VERTICES_MAX_CHIP + 1];

    exact->fight = fight;
    for (uint8_t rank = 0; rank < fight->size.vertices; rank++) {
        struct vec16 place;
        uint16_t number = fight_vertex(fight, rank, &place);

        vertex[number] = place_of(fight, place);
        exact->own[number] = distance(own, vertex[number]);
        exact->rival[number] = INFINITY;
        exact->taboo[number] = fight_is_taboo(fight, number);
    }
    for (uint8_t i = 0; i < fight->size.neighbours; i++) {
        struct neighbour n = fight_neighbour(fight, i);
        double its = distance(position_of(fight, &n), vertex[n.vertex]);

        exact->rival[n.vertex] = fmin(exact->rival[n.vertex], its);
    }
}

static uint16_t closest(const struct exact *exact)
{
    uint16_t best = 0;

    for (uint16_t v = 1; v <= exact->fight->size.vertices; v++)
        if (!exact->taboo[v] && v != exact->fight->leader &&
            (best == 0 || exact->own[v] < exact->own[best]))
            best = v;
    return best;
}

static uint16_t allocate(struct exact *exact)
{
    bool cleared = false;

    for (;;) {
        uint16_t vertex = closest(exact);

        if (vertex == 0 && cleared)
            return 0;
        if (vertex == 0) {
            memset(exact->taboo, 0, sizeof exact->taboo);
            cleared = true;
        } else if (exact->rival[vertex] <= exact->own[vertex]) { /* own id is the largest */
            exact->taboo[vertex] = true;
        } else {
            return vertex;
        }
    }
}

static bool is_tied(const struct exact *exact, uint16_t a, uint16_t b)
{
    double tie = exact->fight->far ? TIE_FAR : TIE_NEAR;

    if (a != 0 && b != 0 && fabs(exact->own[a] - exact->own[b]) < tie)
        return true;
    for (uint16_t v = 1; v <= exact->fight->size.vertices; v++)
        if (v != exact->fight->leader && fabs(exact->own[v] - exact->rival[v]) < tie)
            return true;
    return false;
}

static void judge(const struct fight *fight, uint16_t number, uint16_t chosen, const char *who)
{
    struct exact exact;

    prepare(&exact, fight);
    uint16_t right = allocate(&exact);
    if (chosen != right && (chosen > fight->size.vertices || !is_tied(&exact, chosen, right)))
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
