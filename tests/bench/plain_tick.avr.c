/* What a follower reckons in a tick, in floating point and in Q16.16. */
#include "float_tick.h"
#include "mark.h"
#include "plain_fights.h"
#include "q16_tick.h"
#include "si.h"

#include <string.h>

#define VERTICES 100

static struct fight fight;
static bool taboo[VERTICES];

/* One after the other in the same memory. */
static union {
    struct {
        struct float_tick tick;
        struct float_vertex vertex[VERTICES];
        struct float_neighbour neighbour[NEIGHBOURS_MAX];
        struct float_wheels wheels;
    } f;
    struct {
        struct q16_tick tick;
        struct q16_vertex vertex[VERTICES];
        struct q16_neighbour neighbour[NEIGHBOURS_MAX];
        struct q16_wheels wheels;
    } q;
} data;

static void run_float(void)
{
    data.f.wheels = float_tick(&data.f.tick, taboo);
}

static void run_q16(void)
{
    data.q.wheels = q16_tick(&data.q.tick, taboo);
}

static struct float_state float_state(const struct pose *pose, int16_t v, int16_t omega,
                                      uint16_t age)
{
    return (struct float_state){float_metres(pose->at.x),   float_metres(pose->at.y),
                                float_radians(pose->theta), float_metres(v),
                                float_rate(omega),          age};
}

static void set_float(void)
{
    data.f.tick = (struct float_tick){
        .own = float_state(&fight.own, FIGHT_OWN_V, FIGHT_OWN_OMEGA, FIGHT_OWN_AGE),
        .leader = float_state(&fight.base, FIGHT_BASE_V, FIGHT_BASE_OMEGA, FIGHT_BASE_AGE),
        .law = {.k = float_gain(FIGHT_K),
                .k_theta = float_gain(FIGHT_K_THETA),
                .v_max = float_metres(FIGHT_V_MAX),
                .omega_max = float_rate(FIGHT_OMEGA_MAX)},
        .track = float_metres(FIGHT_TRACK),
        .wheel_max = float_metres(FIGHT_WHEEL_MAX),
    };
    float_fight(&fight, &data.f.tick.contest, data.f.vertex, data.f.neighbour);
}

static struct q16_state q16_state(const struct pose *pose, int16_t v, int16_t omega, uint16_t age)
{
    return (struct q16_state){q16_metres(pose->at.x),   q16_metres(pose->at.y),
                              q16_radians(pose->theta), q16_metres(v),
                              q16_rate(omega),          age};
}

static void set_q16(void)
{
    data.q.tick = (struct q16_tick){
        .own = q16_state(&fight.own, FIGHT_OWN_V, FIGHT_OWN_OMEGA, FIGHT_OWN_AGE),
        .leader = q16_state(&fight.base, FIGHT_BASE_V, FIGHT_BASE_OMEGA, FIGHT_BASE_AGE),
        .law = {.k = q16_gain(FIGHT_K),
                .k_theta = q16_gain(FIGHT_K_THETA),
                .v_max = q16_metres(FIGHT_V_MAX),
                .omega_max = q16_rate(FIGHT_OMEGA_MAX)},
        .track = q16_metres(FIGHT_TRACK),
        .wheel_max = q16_metres(FIGHT_WHEEL_MAX),
    };
    q16_fight(&fight, &data.q.tick.contest, data.q.vertex, data.q.neighbour);
}

static void measure_with(void (*set)(void), void (*run)(void))
{
    set();
    memset(taboo, 0, sizeof taboo);
    measure(run);
}

int main(void)
{
    calibrate();
    for (uint16_t i = 0; i < FIGHTS_PLAIN; i++) {
        fight = fight_begin(fight_in_tick, i);
        measure_with(set_float, run_float);
        tell(&data.f.wheels, sizeof data.f.wheels);
        measure_with(set_q16, run_q16);
        tell(&data.q.wheels, sizeof data.q.wheels);
    }
    mark(MARK_DONE);
    for (;;)
        ;
}
