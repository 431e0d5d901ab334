/* Algorithm 1 in floating point and in Q16.16, in the fights that begin with an empty taboo list.
 */
#include "mark.h"
#include "plain_fights.h"

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

static void set_float(void)
{
    float_fight(&fight, &data.f.contest, data.f.vertex, data.f.neighbour);
}

static void set_q16(void)
{
    q16_fight(&fight, &data.q.contest, data.q.vertex, data.q.neighbour);
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
    calibrate();
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
