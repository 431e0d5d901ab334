#include "radio.h"

#include "chance.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* HC-05 and HC-06 modules take 20 to 50 ms one way. */
#define SMALL_LEAST 1
#define SMALL_JITTER 1

#define LANDINGS (RADIO_TICKS_MAX + 1)

struct radio_pipe {
    struct radio radio;
    uint64_t name;            /* of this way of this robot's link, for its draws */
    size_t landing[LANDINGS]; /* bytes that arrive at a tick, by its number modulo LANDINGS */
    size_t landed;            /* bytes that have arrived, of `count` */
    size_t count, room;
    uint8_t bytes[];
};

struct radio radio_of(const struct scenario *scenario, uint64_t seed)
{
    if (scenario->body == BODY_SMALL)
        return (struct radio){SMALL_LEAST, SMALL_JITTER, seed};
    return (struct radio){.seed = seed};
}

bool radio_is_cable(const struct radio *radio)
{
    return radio->least + radio->jitter == 0;
}

struct radio_pipe *radio_pipe_new(const struct radio *radio, uint16_t robot, enum radio_way way,
                                  size_t burst)
{
    /* Every tick's bytes until they arrive, and one burst that waits behind another. */
    size_t room = (radio->least + radio->jitter + 2) * burst;
    struct radio_pipe *pipe = malloc(sizeof *pipe + room);

    assert(radio->least + radio->jitter <= RADIO_TICKS_MAX);
    if (pipe == NULL)
        return NULL;
    *pipe = (struct radio_pipe){
        .radio = *radio,
        .name = (uint64_t)robot << 48 | (uint64_t)way << 40,
        .room = room,
    };
    return pipe;
}

void radio_pipe_free(struct radio_pipe *pipe)
{
    free(pipe);
}

/* Bytes are told apart by their order alone: where later ones land earlier, they do so for those
 * that were sent before them, and all delays stay between least and least + jitter. */
void radio_put(struct radio_pipe *pipe, uint64_t tick, const uint8_t *bytes, size_t count)
{
    const struct radio *radio = &pipe->radio;
    uint64_t draw = chance_draw(radio->seed, CHANCE_JITTER, pipe->name | tick);
    uint64_t due = tick + radio->least + draw % (radio->jitter + 1);

    assert(count <= pipe->room - pipe->count);
    pipe->landing[due % LANDINGS] += count;
    memcpy(pipe->bytes + pipe->count, bytes, count);
    pipe->count += count;
}

size_t radio_take(struct radio_pipe *pipe, uint64_t tick, uint8_t *bytes, size_t room)
{
    size_t *landing = &pipe->landing[tick % LANDINGS];

    pipe->landed += *landing;
    *landing = 0;

    size_t taken = pipe->landed < room ? pipe->landed : room;
    memcpy(bytes, pipe->bytes, taken);
    pipe->landed -= taken;
    pipe->count -= taken;
    memmove(pipe->bytes, pipe->bytes + taken, pipe->count);
    return taken;
}

void radio_clear(struct radio_pipe *pipe)
{
    memset(pipe->landing, 0, sizeof pipe->landing);
    pipe->landed = 0;
    pipe->count = 0;
}
