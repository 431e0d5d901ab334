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

    return chance_unit(chance_draw(network->seed, CHANCE_LOSS, name)) < network->loss;
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

/* A little wider than the reach, so that no rounding puts a neighbour two cells away. */
static double cell_size(const struct network *network)
{
    return fmax(network->range * (1 + 2 * RANGE_TOLERANCE), CELL_MIN);
}

static size_t cell_of(const struct network *network, int64_t column, int64_t row)
{
    return chance_scramble((uint64_t)column * 0x9E3779B97F4A7C15u + (uint64_t)row) &
           (network->cell_count - 1);
}

static void fill_cells(struct network *network)
{
    double size = cell_size(network);

    for (size_t i = 0; i < network->cell_count; i++)
        network->cell[i] = -1;
    for (size_t i = network->station_count; i-- > 0;) {
        struct station *s = &network->station[i];

        if (!s->tracked || !s->linked)
            continue;
        size_t cell = cell_of(network, (int64_t)floor(s->x / size), (int64_t)floor(s->y / size));
        s->next = network->cell[cell];
        network->cell[cell] = (int32_t)i;
    }
}

static bool in_range(const struct network *network, const struct station *a,
                     const struct station *b)
{
    double dx = a->x - b->x;
    double dy = a->y - b->y;
    double reach = network->range * (1 + RANGE_TOLERANCE);

    return dx * dx + dy * dy <= reach * reach;
}

/* Offers the beacon to the stations of one cell; different cells may share a bucket, so a
 * station counts only in the cell it lies in. */
static void offer_in_cell(struct network *network, const struct beacon_in_flight *beacon,
                          int64_t column, int64_t row, struct outbox *outbox)
{
    double size = cell_size(network);
    const struct station *from = &network->station[beacon->sender];

    for (int32_t i = network->cell[cell_of(network, column, row)]; i >= 0;
         i = network->station[i].next) {
        const struct station *to = &network->station[i];

        if ((int64_t)floor(to->x / size) == column && (int64_t)floor(to->y / size) == row &&
            in_range(network, from, to))
            offer(network, beacon, (size_t)i, outbox);
    }
}

static void relay(struct network *network, const struct beacon_in_flight *beacon,
                  struct outbox *outbox)
{
    const struct station *from = &network->station[beacon->sender];
    double size = cell_size(network);

    if (from->muted)
        return;
    if (beacon->to_all) {
        for (size_t i = 0; i < network->station_count; i++)
            offer(network, beacon, i, outbox);
        return;
    }
    if (!from->tracked)
        return;
    int64_t column = (int64_t)floor(from->x / size);
    int64_t row = (int64_t)floor(from->y / size);
    for (int64_t c = column - 1; c <= column + 1; c++)
        for (int64_t r = row - 1; r <= row + 1; r++)
            offer_in_cell(network, beacon, c, r, outbox);
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
