/* Passes of allocation, one a fight: whole ones, also where a robot would take two ticks. */
#include "allocation.h"

#include "fights.h"
#include "mark.h"

#include <string.h>

static struct fight fight;
static struct formation formation;
static struct neighbours neighbours;
static struct allocation_state state;
static struct allocation_view view;

static void run_pass(void)
{
    do
        allocation_pass(&state, &view);
    while (state.unfinished);
}

static void set_formation(void)
{
    struct vec16 place;

    formation.number = 1;
    formation.scale = fight.scale;
    formation.total = fight.size.vertices;
    formation.leader = fight.leader;
    for (uint8_t rank = 0; rank < fight.size.vertices; rank++) {
        uint16_t vertex = fight_vertex(&fight, rank, &place);

        formation.vertex[vertex - 1] = place;
    }
}

static void set_neighbours(void)
{
    memset(&neighbours, 0, sizeof neighbours);
    for (uint8_t i = 0; i < fight.size.neighbours; i++) {
        struct message_beacon beacon = fight_beacon(&fight, i);

        neighbours_hear(&neighbours, &beacon, 0, &fight.own.at);
    }
}

static void set_state(void)
{
    allocation_begin(&state);
    allocation_under(&state, FIGHT_LEADER_ID, formation.number);
    for (uint16_t vertex = 1; vertex <= fight.size.vertices; vertex++)
        if (fight_is_taboo(&fight, vertex))
            state.taboo[(vertex - 1) / 8] |= (uint8_t)(1 << (vertex - 1) % 8);
}

static void set_view(void)
{
    view = (struct allocation_view){
        .formation = &formation,
        .neighbours = &neighbours,
        .id = FIGHT_OWN_ID,
        .leader = FIGHT_LEADER_ID,
        .origin = fight.base.at,
        .heading = sincos_of(fight.base.theta),
        .own = fight.own.at,
        .now = fight.now,
    };
}

int main(void)
{
    calibrate();
    for (uint8_t s = 0; s < FIGHT_SIZES; s++)
        for (uint16_t i = 0; i < FIGHTS; i++) {
            fight = fight_begin(fight_sizes[s], i);
            set_formation();
            set_neighbours();
            set_state();
            set_view();
            measure(run_pass);
            tell(&state.held, sizeof state.held);
        }
    mark(MARK_DONE);
    for (;;)
        ;
}
