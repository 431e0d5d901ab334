/* Algorithm 1 in floating point and in Q16.16, in the fights that begin with an empty taboo list.
 */
#include "fights.h"
#include "float_allocation.h"
#include "mark.h"
#include "q16_allocation.h"
#include "si.h"

#include <string.h>

#define VERTICES 100
#define NEIGHBOURS 99

static struct fight fight;
static uint16_t chosen;
static bool taboo[VERTICES];

/* One after the other in the same memory. */
static union {
    struct {
        struct float_contest contest;
        struct float_vertex vertex[VERTICES];
        struct float_neighbour neighbour[NEIGHBOURS];
    } f;
    struct {
        struct q16_contest contest;
        struct q16_vertex vertex[VERTICES];
        struct q16_neighbour neighbour[NEIGHBOURS];
    } q;
} data;

static void run_float(void)
{
    chosen = float_allocate(&data.f.contest, taboo);
}

static void run_q16(void)
{
    chosen = q16_allocate(&data.q.contest, taboo);
}

/* A part of a vertex, wide. */
static int32_t wide(int16_t part)
{
    return part * ((int32_t)1 << fight.scale);
}

static void set_float_neighbour(uint8_t index)
{
    struct neighbour n = fight_neighbour(&fight, index);

    data.f.neighbour[index] = (struct float_neighbour){
        float_metres(n.pose.at.x),
        float_metres(n.pose.at.y),
        float_radians(n.pose.theta),
        float_metres(n.v),
        float_rate(n.omega),
        fight.now - n.time,
        n.id,
        n.vertex,
    };
}

static void set_float(void)
{
    struct vec16 place;

    data.f.contest = (struct float_contest){
        .x = float_metres(fight.base.at.x),
        .y = float_metres(fight.base.at.y),
        .theta = float_radians(fight.base.theta),
        .own_x = float_metres(fight.own.x),
        .own_y = float_metres(fight.own.y),
        .own_id = FIGHT_OWN_ID,
        .leader_vertex = fight.leader,
        .vertices = fight.size.vertices,
        .neighbours = fight.size.neighbours,
        .vertex = data.f.vertex,
        .neighbour = data.f.neighbour,
    };
    for (uint8_t rank = 0; rank < fight.size.vertices; rank++) {
        struct float_vertex *vertex = &data.f.vertex[fight_vertex(&fight, rank, &place) - 1];

        vertex->x = float_metres(wide(place.x));
        vertex->y = float_metres(wide(place.y));
    }
    for (uint8_t i = 0; i < fight.size.neighbours; i++)
        set_float_neighbour(i);
}

static void set_q16_neighbour(uint8_t index)
{
    struct neighbour n = fight_neighbour(&fight, index);

    data.q.neighbour[index] = (struct q16_neighbour){
        q16_metres(n.pose.at.x),
        q16_metres(n.pose.at.y),
        q16_radians(n.pose.theta),
        q16_metres(n.v),
        q16_rate(n.omega),
        fight.now - n.time,
        n.id,
        n.vertex,
    };
}

static void set_q16(void)
{
    struct vec16 place;

    data.q.contest = (struct q16_contest){
        .x = q16_metres(fight.base.at.x),
        .y = q16_metres(fight.base.at.y),
        .theta = q16_radians(fight.base.theta),
        .own_x = q16_metres(fight.own.x),
        .own_y = q16_metres(fight.own.y),
        .own_id = FIGHT_OWN_ID,
        .leader_vertex = fight.leader,
        .vertices = fight.size.vertices,
        .neighbours = fight.size.neighbours,
        .vertex = data.q.vertex,
        .neighbour = data.q.neighbour,
    };
    for (uint8_t rank = 0; rank < fight.size.vertices; rank++) {
        struct q16_vertex *vertex = &data.q.vertex[fight_vertex(&fight, rank, &place) - 1];

        vertex->x = q16_metres(wide(place.x));
        vertex->y = q16_metres(wide(place.y));
    }
    for (uint8_t i = 0; i < fight.size.neighbours; i++)
        set_q16_neighbour(i);
}

static void measure_with(void (*set)(void), void (*run)(void))
{
    set();
    memset(taboo, 0, sizeof taboo);
    measure(run);
    tell(&chosen, sizeof chosen);
}

int main(void)
{
    measure_nothing();
    for (uint8_t s = 0; s < FIGHT_SIZES; s++)
        for (uint16_t i = 0; i < FIGHTS_PLAIN; i++) {
            fight = fight_begin(fight_sizes[s], i);
            measure_with(set_float, run_float);
            measure_with(set_q16, run_q16);
        }
    mark(MARK_DONE);
    for (;;)
        ;
}
