#include "play.h"

#include "formation.h"
#include "random.h"

#include <math.h>
#include <string.h>

#define TRACK_M 0.08
#define WHEEL_MAX_M_S 2.0
#define OTHER_ID 10 /* of the first of them */
#define LEADER 1
#define SECOND_FORMATION 250
#define START_MS (-500)

const struct play_part play_candidate = {
    .candidate = true, .law = LAW_FL, .allocation = ALLOCATION_CPA, .vertices = 5, .others = 6};
const struct play_part play_follower = {
    .law = LAW_FL, .allocation = ALLOCATION_CPA, .vertices = 5, .others = 6};

static int16_t narrow(double value)
{
    return (int16_t)lround(value * NARROW_PER_M);
}

static angle_t angle(double rad)
{
    return (angle_t)(int32_t)lround(rad / (2 * M_PI) * ANGLE_TURN);
}

static struct pose pose(double x, double y, double theta)
{
    return (struct pose){{(int32_t)lround(x * NARROW_PER_M), (int32_t)lround(y * NARROW_PER_M)},
                         angle(theta)};
}

static uint32_t draw(struct play *play)
{
    return random_next(&play->state);
}

static int32_t now(const struct play *play)
{
    return START_MS + (int32_t)play->period * TICK_MS;
}

void play_begin(struct play *play, const struct play_part *part, uint32_t seed)
{
    *play = (struct play){.part = *part, .state = seed, .x = -1, .y = 0.5};
}

/* One in eight that may be lost is, and one in sixteen has a bit flipped. */
static void send(struct play *play, const struct message *message, bool safe)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];
    uint8_t frame[FRAME_BYTES_MAX];
    uint8_t length = frame_encode(frame, payload, message_write(payload, message));

    if (length > play->room || (!safe && draw(play) % 8 == 0))
        return;
    if (!safe && draw(play) % 16 == 0) {
        uint32_t bit = draw(play) % (8u * length);

        frame[bit / 8] ^= (uint8_t)(1 << bit % 8);
    }
    memcpy(play->bytes + play->count, frame, length);
    play->count += length;
    play->room -= length;
}

static void send_mission(struct play *play)
{
    struct message message = {.type = MESSAGE_MISSION,
                              .mission = {.version = PROTOCOL_VERSION,
                                          .mission = 9,
                                          .candidate = play->part.candidate,
                                          .law = play->part.law,
                                          .allocation = play->part.allocation,
                                          .k = GAIN_ONE,
                                          .k_theta = 3 * GAIN_ONE,
                                          .v_max = narrow(1.5),
                                          .omega_max = 4 * RATE_ONE,
                                          .track = narrow(TRACK_M),
                                          .wheel_max = narrow(WHEEL_MAX_M_S),
                                          .latency = 5}};

    send(play, &message, true);
    play->sequence = 1;
}

/* A spiral about the leader. Its last vertex is the farthest. */
static struct polar_vertex vertex(const struct play *play, int i)
{
    double distance = i == 0 ? 0 : 0.4 + 0.2 * play->formation + 0.02 * i;

    return (struct polar_vertex){(int32_t)lround(distance * NARROW_PER_M),
                                 angle(1.2 * i + play->formation)};
}

/* The next vertices of the formation that is on its way. */
static void send_vertices(struct play *play)
{
    uint8_t total = play->part.vertices, left = total - play->placed;
    struct message message = {
        .type = MESSAGE_VERTICES,
        .vertices = {.sequence = play->sequence++,
                     .formation = play->formation,
                     .scale = formation_scale(vertex(play, total - 1).distance),
                     .total = total,
                     .first = play->placed,
                     .count = left < VERTICES_PER_MESSAGE ? left : VERTICES_PER_MESSAGE}};

    for (int i = 0; i < message.vertices.count; i++)
        message.vertices.vertex[i] = vertex(play, play->placed + i);
    play->placed += message.vertices.count;
    send(play, &message, true);
}

static void send_assignment(struct play *play)
{
    struct message message = {
        .type = MESSAGE_ASSIGN,
        .assign = {.sequence = play->sequence++, .vertex = 1 + draw(play) % play->part.vertices}};

    send(play, &message, true);
}

static void send_knot(struct play *play)
{
    double t = play->knot_time / 1000.0;
    struct message message = {
        .type = MESSAGE_KNOT,
        .knot = {.sequence = play->sequence++,
                 .knot = {.time = play->knot_time,
                          .pose = pose(0.3 * t, 0.2 * sin(t), atan2(0.2 * cos(t), 0.3)),
                          .v = narrow(hypot(0.3, 0.2 * cos(t))),
                          .omega = (int16_t)lround(-0.3 * sin(t) * RATE_ONE)}}};

    send(play, &message, true);
    play->knot_time += 400;
}

static struct message_beacon beacon(const struct play *play, uint16_t id)
{
    double t = now(play) / 1000.0 + id;

    return (struct message_beacon){.id = id,
                                   .time = (uint16_t)now(play),
                                   .pose = pose(cos(t) + 0.3 * t - 1, sin(2 * t), t),
                                   .v = narrow(0.3),
                                   .omega = RATE_ONE / 2,
                                   .term = 2,
                                   .formation = 1 + (play->period > SECOND_FORMATION)};
}

static void send_leader(struct play *play)
{
    struct message message = {.type = MESSAGE_BEACON, .beacon = beacon(play, LEADER)};

    message.beacon.role = ROLE_LEADER;
    message.beacon.candidate = message.beacon.to_all = true;
    message.beacon.vertex = 1;
    send(play, &message, false);
}

/* They never agree on who holds what, and now and then one is faulty. */
static void send_other(struct play *play, uint16_t id)
{
    struct message message = {.type = MESSAGE_BEACON, .beacon = beacon(play, id)};

    message.beacon.role = ROLE_FOLLOWER;
    message.beacon.vertex = 1 + draw(play) % play->part.vertices;
    message.beacon.leader_age = draw(play) % 32;
    message.beacon.fault = draw(play) % 64 == 0;
    send(play, &message, false);
}

/* A candidate that would rather lead itself: a later term than the leader's, or an earlier one. */
static void send_rival(struct play *play, uint16_t id)
{
    struct message message = {.type = MESSAGE_BEACON, .beacon = beacon(play, id)};

    message.beacon.role = draw(play) % 4 == 0 ? ROLE_LEADER : ROLE_CANDIDATE;
    message.beacon.candidate = message.beacon.to_all = true;
    message.beacon.term = 1 + draw(play) % 4;
    send(play, &message, false);
}

static void send_others(struct play *play)
{
    /* The leader falls silent for two seconds, while another would like to lead. */
    bool silent = play->period >= 300 && play->period <= 400;

    if (!play->part.candidate && !silent && play->period % 3 == 0)
        send_leader(play);
    if (silent && play->period % 16 == 0)
        send_rival(play, OTHER_ID + play->part.others);
    for (uint16_t i = 0; i < play->part.others; i++)
        if ((play->period + i) % 5 == 0)
            send_other(play, OTHER_ID + i);
}

static void send_orders(struct play *play)
{
    if (play->period == PLAY_MISSION)
        send_mission(play);
    if (play->period == 2 || play->period == SECOND_FORMATION) {
        play->formation++;
        play->placed = 0;
    }
    if (play->formation > 0 && play->placed < play->part.vertices)
        send_vertices(play);
    else if (play->part.allocation == ALLOCATION_ASSIGNED && play->period % 100 == 50)
        send_assignment(play);
    if (play->part.candidate && play->period > 2 && play->knot_time < now(play) + 4000)
        send_knot(play);
}

/* An emergency stop whose bytes come right behind the control tick, while the robot is still busy
 * with a long message that came right before it: it has to wait for the next tick. */
static void send_late_estop(struct play *play, uint16_t before_phase)
{
    struct message estop = {.type = MESSAGE_ESTOP};
    struct message vertices = {.type = MESSAGE_VERTICES,
                               .vertices = {.sequence = play->sequence++,
                                            .formation = 3,
                                            .total = VERTICES_PER_MESSAGE,
                                            .count = VERTICES_PER_MESSAGE}};
    uint8_t payload[FRAME_PAYLOAD_MAX], frame[FRAME_BYTES_MAX];
    uint8_t length = frame_encode(frame, payload, message_write(payload, &vertices));

    play->count = before_phase - length;
    memset(play->bytes, 0, play->count); /* an idle link */
    play->room -= play->count;
    send(play, &vertices, true);
    send(play, &estop, true);
}

static void send_all(struct play *play)
{
    struct message own = {.type = MESSAGE_POSE,
                          .pose = {now(play), pose(play->x, play->y, play->theta)}};
    struct message alive = {.type = MESSAGE_KEEPALIVE, .keepalive = {now(play)}};
    bool tracked = play->period < 500 || play->period > 530; /* out of the cameras' sight */

    send(play, tracked ? &own : &alive, false);
    send_orders(play);
    send_others(play);
}

void play_next(struct play *play, const struct link_timing *timing)
{
    play->count = 0;
    play->room = timing->slots;
    if (play->period == 580)
        send_late_estop(play, timing->before_phase);
    else
        send_all(play);
    play->period++;
}

void play_drive(struct play *play, int16_t left, int16_t right)
{
    double l = left * WHEEL_MAX_M_S / PWM_STEPS, r = right * WHEEL_MAX_M_S / PWM_STEPS;
    double v = (l + r) / 2, turn = (r - l) / TRACK_M * TICK_MS / 1000;

    play->x += v * TICK_MS / 1000 * cos(play->theta + turn / 2);
    play->y += v * TICK_MS / 1000 * sin(play->theta + turn / 2);
    play->theta += turn;
}
