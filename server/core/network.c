#include "network.h"

#include "chance.h"

#include <math.h>

/* Distances that should equal the range come out a rounding error above it. */
#define RANGE_TOLERANCE 1e-9

/* The narrowest cell, m: a range of 0 still needs cells. */
#define CELL_MIN 0.1

void network_send(struct network *network, uint64_t tick, size_t sender, uint32_t sequence,
                  bool to_all, const struct beacon_frame *frame)
{
    if (network->flight_count == network->flight_room) {
        network->dropped++;
        return;
    }
    size_t place = (network->flight_first + network->flight_count++) % network->flight_room;
    network->flight[place] = (struct beacon_in_flight){
        .due = tick + network->delay_ticks,
        .sender = sender,
        .sequence = sequence,
        .to_all = to_all,
        .frame = *frame,
    };
}

bool network_loses(const struct network *network, uint16_t sender, uint16_t receiver,
                   uint32_t sequence)
{
    uint64_t name = (uint64_t)sender << 48 | (uint64_t)receiver << 32 | sequence;

    return network->loss > 0 &&
           chance_unit(chance_draw(network->seed, CHANCE_LOSS, name)) < network->loss;
}

static void offer(struct network *network, const struct beacon_in_flight *beacon, size_t receiver,
                  struct outbox *outbox)
{
    const struct station *from = &network->station[beacon->sender];
    const struct station *to = &network->station[receiver];

    if (receiver == beacon->sender || !to->linked || to->muted || to->group != from->group ||
        network_loses(network, from->id, to->id, beacon->sequence))
        return;
    outbox_put_beacon(&outbox[receiver], &beacon->frame);
}

static double reach(const struct network *network)
{
    return network->range * (1 + RANGE_TOLERANCE);
}

/* A little wider than the reach, so that no rounding puts a neighbour two cells away. */
static double cell_size(const struct network *network)
{
    return fmax(network->range * (1 + 2 * RANGE_TOLERANCE), CELL_MIN);
}

static int32_t *bucket(const struct network *network, int32_t column, int32_t row)
{
    uint64_t name = (uint64_t)column * 0x9E3779B97F4A7C15u + (uint64_t)row;

    return &network->cell[chance_scramble(name) & (network->cell_count - 1)];
}

static void fill_cells(struct network *network)
{
    double size = cell_size(network);

    for (size_t i = 0; i < network->cell_count; i++)
        network->cell[i] = -1;
    for (size_t i = network->station_count; i-- > 0;) {
        struct station *s = &network->station[i];

        if (!s->tracked)
            continue;
        s->column = (int32_t)floor(s->x / size);
        s->row = (int32_t)floor(s->y / size);
        if (!s->linked)
            continue; /* hears nothing, but may have sent */
        int32_t *first = bucket(network, s->column, s->row);
        s->next = *first;
        *first = (int32_t)i;
    }
}

/* Offers the beacon to the stations of one cell. Cells may share a bucket: a station counts only
 * in the one it lies in. */
static void offer_in_cell(struct network *network, const struct beacon_in_flight *beacon,
                          int32_t column, int32_t row, struct outbox *outbox)
{
    const struct station *from = &network->station[beacon->sender];
    double reach_squared = reach(network) * reach(network);

    for (int32_t i = *bucket(network, column, row); i >= 0; i = network->station[i].next) {
        const struct station *to = &network->station[i];
        double dx = to->x - from->x;
        double dy = to->y - from->y;

        if (to->column == column && to->row == row && dx * dx + dy * dy <= reach_squared)
            offer(network, beacon, (size_t)i, outbox);
    }
}

static void relay(struct network *network, const struct beacon_in_flight *beacon,
                  struct outbox *outbox)
{
    const struct station *from = &network->station[beacon->sender];

    if (from->muted)
        return;
    if (beacon->to_all) {
        for (size_t i = 0; i < network->station_count; i++)
            offer(network, beacon, i, outbox);
        return;
    }
    if (!from->tracked)
        return;
    for (int32_t column = from->column - 1; column <= from->column + 1; column++)
        for (int32_t row = from->row - 1; row <= from->row + 1; row++)
            offer_in_cell(network, beacon, column, row, outbox);
}

void network_deliver(struct network *network, uint64_t tick, struct outbox *outbox)
{
    fill_cells(network);
    while (network->flight_count > 0) {
        const struct beacon_in_flight *beacon = &network->flight[network->flight_first];

        if (beacon->due > tick)
            return;
        relay(network, beacon, outbox);
        network->flight_first = (network->flight_first + 1) % network->flight_room;
        network->flight_count--;
    }
}
