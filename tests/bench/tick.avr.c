/* Whole control ticks of a follower among 100 vertices and 32 neighbours: the bytes of a tick
 * decoded and the step after them.
 *
 * The vertices stand in a line. Every ten ticks the robot finds itself at another place of it where
 * 31 neighbours hold the vertices closest to it, and stand on them; now and then there is a new
 * leader, and its taboo list is empty again. */
#include "brain.h"
#include "mark.h"
#include "random.h"
#include "ticks.h"

#include <string.h>

#define VERTICES 100
#define SPACING (NARROW_PER_M / 2)
#define FOLLOWERS (NEIGHBOURS_MAX - 1)
#define FIRST_FOLLOWER 200 /* id */
#define OWN_ID 100
#define RING_BYTES 255
#define STAGE_TICKS 10
#define REIGN_TICKS 50

static struct brain brain;
static struct brain_input input;
static struct brain_output output;

static uint8_t ring[RING_BYTES];
static uint8_t filled;
static struct message message;

static uint16_t tick;
static uint8_t sequence;
static uint32_t state = 4;
static int16_t place; /* the robot's place in the line: a vertex's index, from 0 */
static uint8_t speaker;

static int32_t now(void)
{
    return -500 + (int32_t)tick * TICK_MS;
}

static bool put(void)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];
    uint8_t frame[FRAME_BYTES_MAX];
    uint8_t length = frame_encode(frame, payload, message_write(payload, &message));

    if (length > RING_BYTES - filled)
        return false;
    memcpy(ring + filled, frame, length);
    filled += length;
    return true;
}

/* Where a vertex of the line is, about a leader that goes along x. */
static struct vec32 vertex_at(int16_t index)
{
    return (struct vec32){now() * 2, (int32_t)index * SPACING};
}

static void put_mission(void)
{
    message = (struct message){.type = MESSAGE_MISSION,
                               .mission = {.version = PROTOCOL_VERSION,
                                           .mission = 1,
                                           .law = LAW_FL,
                                           .allocation = ALLOCATION_CPA,
                                           .k = GAIN_ONE,
                                           .k_theta = 3 * GAIN_ONE,
                                           .v_max = 4 * NARROW_PER_M,
                                           .omega_max = 10 * RATE_ONE,
                                           .track = NARROW_PER_M / 10,
                                           .wheel_max = 4 * NARROW_PER_M}};
    sequence = 1;
    put();
}

static void put_vertices(uint16_t first)
{
    message = (struct message){.type = MESSAGE_VERTICES,
                               .vertices = {.sequence = sequence++,
                                            .formation = 1,
                                            .scale = formation_scale((int32_t)VERTICES * SPACING),
                                            .total = VERTICES,
                                            .first = first}};
    struct message_vertices *v = &message.vertices;

    for (; v->count < VERTICES_PER_MESSAGE && first < VERTICES; first++)
        v->vertex[v->count++] = (struct polar_vertex){(int32_t)first * SPACING, ANGLE_QUARTER};
    put();
}

static void put_pose(void)
{
    struct vec32 at = vertex_at(place);

    at.y += (int32_t)(random_next(&state) % SPACING) - SPACING / 2;
    message =
        (struct message){.type = MESSAGE_POSE, .pose = {now(), {at, (angle_t)random_next(&state)}}};
    put();
}

/* An order that changes nothing, and has to be acknowledged by a status. */
static void put_order(void)
{
    message =
        (struct message){.type = MESSAGE_ASSIGN, .assign = {.sequence = sequence++, .vertex = 1}};
    put();
}

static bool put_beacon(uint16_t id, struct vec32 at, uint16_t vertex)
{
    uint8_t reign = (uint8_t)(tick / REIGN_TICKS);
    bool leads = vertex == 1;

    message = (struct message){.type = MESSAGE_BEACON,
                               .beacon = {.id = id,
                                          .time = (uint16_t)now(),
                                          .pose = {at, 0},
                                          .v = NARROW_PER_M / 2,
                                          .omega = 1,
                                          .role = leads ? ROLE_LEADER : ROLE_FOLLOWER,
                                          .candidate = leads,
                                          .to_all = leads,
                                          .term = reign + 1u,
                                          .vertex = vertex,
                                          .formation = 1}};
    return put();
}

static bool put_leader(void)
{
    return put_beacon(1 + tick / REIGN_TICKS % 2, vertex_at(0), 1);
}

/* A follower on the vertex that it holds, one of those around the robot. */
static bool put_follower(void)
{
    int16_t index = place - FOLLOWERS / 2 + speaker;
    bool sent = put_beacon(FIRST_FOLLOWER + speaker, vertex_at(index), (uint16_t)index + 1);

    if (sent)
        speaker = speaker == FOLLOWERS - 1 ? 0 : speaker + 1;
    return sent;
}

static void move_on(void)
{
    if (tick % STAGE_TICKS == 0)
        place = (int16_t)(1 + FOLLOWERS / 2 +
                          random_next(&state) % (VERTICES - 2 - 2 * (FOLLOWERS / 2)));
}

static void fill_ring(void)
{
    filled = 0;
    put_pose();
    put_order();
    put_leader();
    while (put_follower())
        ;
}

static void decode(void)
{
    brain_bytes(&brain, ring, ring + filled);
}

static void step(void)
{
    brain_step(&brain, &input, &output);
}

static void measure_tick(void)
{
    measure(decode);
    measure(step);
    struct tick_result result = {output.left, output.right, brain.allocation.held,
                                 brain.neighbours.count, output.length};
    tell(&result, sizeof result);
    tick++;
}

static void begin(void)
{
    struct parameters parameters;

    parameters_default(&parameters);
    parameters.value[PARAMETER_ID] = OWN_ID;
    parameters_write(ring, &parameters);
    brain_init(&brain, ring);
    put_mission();
    decode();
    step();
    for (tick = 1; tick < 40; tick++) {
        filled = 0;
        if (sequence <= (VERTICES + VERTICES_PER_MESSAGE - 1) / VERTICES_PER_MESSAGE)
            put_vertices((uint16_t)(sequence - 1) * VERTICES_PER_MESSAGE);
        put_pose();
        decode();
        step();
    }
}

int main(void)
{
    calibrate();
    begin();
    for (uint16_t i = 0; i < TICKS_FULL; i++) {
        move_on();
        fill_ring();
        measure_tick();
    }
    for (uint8_t i = 0; i < TICKS_QUIET; i++) {
        filled = 0;
        put_pose();
        measure_tick();
    }
    mark(MARK_DONE);
    for (;;)
        ;
}
