#include "exact_fight.h"

#include "exact_law.h"

#include <math.h>
#include <string.h>

/* Two distances that differ by less than this, m, may be taken for the same, and the other vertex
 * be chosen: a few units of the coarsest numbers that are compared, and more where neighbours were
 * fast and are carried on for long. */
#define TIE 0.02
#define TIE_OLD 0.05
#define TIE_FAR 0.1

static double radians(angle_t angle)
{
    return angle * 2 * M_PI / ANGLE_TURN;
}

static double distance(struct point a, struct point b)
{
    return hypot(a.x - b.x, a.y - b.y);
}

void motion_advance(struct motion *motion, double age)
{
    double middle = motion->theta + motion->omega * age / 2;

    motion->at.x += motion->v * age * cos(middle);
    motion->at.y += motion->v * age * sin(middle);
    motion->theta += motion->omega * age;
}

static struct motion motion_of(const struct pose *pose, int16_t v, int16_t omega)
{
    return (struct motion){.at = {metres(pose->at.x), metres(pose->at.y)},
                           .theta = radians(pose->theta),
                           .v = metres(v),
                           .omega = (double)omega / RATE_ONE};
}

struct motion exact_base(const struct fight *fight)
{
    return motion_of(&fight->base, FIGHT_BASE_V, FIGHT_BASE_OMEGA);
}

struct motion exact_own(const struct fight *fight)
{
    return motion_of(&fight->own, FIGHT_OWN_V, FIGHT_OWN_OMEGA);
}

static struct point place_of(const struct exact_fight *exact, struct vec16 place)
{
    const struct motion *base = &exact->base;
    double unit = ldexp(1.0 / NARROW_PER_M, exact->fight->scale);
    double c = cos(base->theta), s = sin(base->theta);

    return (struct point){base->at.x + unit * (place.x * c - place.y * s),
                          base->at.y + unit * (place.x * s + place.y * c)};
}

static struct point position_of(const struct message_beacon *b, uint16_t now)
{
    struct motion motion = motion_of(&b->pose, b->v, b->omega);

    motion_advance(&motion, (uint16_t)(now - b->time) / 1000.0);
    return motion.at;
}

static void place_vertices(struct exact_fight *exact)
{
    for (uint8_t rank = 0; rank < exact->fight->size.vertices; rank++) {
        struct vec16 place;
        uint16_t v = fight_vertex(exact->fight, rank, &place);

        exact->vertex[v] = place_of(exact, place);
        exact->own_distance[v] = distance(exact->own, exact->vertex[v]);
        exact->rival_distance[v] = INFINITY;
        exact->taboo[v] = fight_is_taboo(exact->fight, v);
    }
}

void exact_prepare(struct exact_fight *exact, const struct fight *fight, const struct motion *base,
                   struct point own)
{
    *exact = (struct exact_fight){.fight = fight, .base = *base, .own = own};
    place_vertices(exact);
    for (uint8_t i = 0; i < fight->size.neighbours; i++) {
        struct message_beacon b = fight_beacon(fight, i);
        double its = distance(position_of(&b, fight->now), exact->vertex[b.vertex]);

        exact->rival_distance[b.vertex] = fmin(exact->rival_distance[b.vertex], its);
    }
}

static uint16_t closest(const struct exact_fight *exact)
{
    uint16_t best = 0;

    for (uint16_t v = 1; v <= exact->fight->size.vertices; v++)
        if (!exact->taboo[v] && v != exact->fight->leader &&
            (best == 0 || exact->own_distance[v] < exact->own_distance[best]))
            best = v;
    return best;
}

uint16_t exact_allocate(struct exact_fight *exact)
{
    bool cleared = false;

    for (;;) {
        uint16_t vertex = closest(exact);

        if (vertex == 0 && cleared)
            return 0;
        if (vertex == 0) {
            memset(exact->taboo, 0, sizeof exact->taboo);
            cleared = true;
        } else if (exact->rival_distance[vertex] <=
                   exact->own_distance[vertex]) { /* own id is the largest */
            exact->taboo[vertex] = true;
        } else {
            return vertex;
        }
    }
}

static double own_distance(const struct exact_fight *exact, uint16_t vertex)
{
    return vertex == 0 ? INFINITY : exact->own_distance[vertex];
}

bool exact_is_tied(const struct exact_fight *exact, uint16_t chosen, uint16_t right)
{
    double tie = exact->fight->far ? TIE_FAR : exact->fight->old ? TIE_OLD : TIE;
    double farther = fmax(own_distance(exact, chosen), own_distance(exact, right));

    if (fabs(own_distance(exact, chosen) - own_distance(exact, right)) < tie)
        return true;
    for (uint16_t v = 1; v <= exact->fight->size.vertices; v++)
        if (v != exact->fight->leader && exact->own_distance[v] < farther + tie &&
            fabs(exact->own_distance[v] - exact->rival_distance[v]) < tie)
            return true;
    return false;
}
