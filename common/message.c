#include "message.h"

#include "formation.h"
#include "rom.h"
#include "wire.h"

enum { BIT_CANDIDATE = 4, BIT_FAULT = 8, BIT_TO_ALL = 16, ROLE_MASK = 3 };
enum { BIT_CORRECTED = 1 };

static void write_pose(uint8_t **out, const struct pose *pose)
{
    put_i24(out, pose->at.x);
    put_i24(out, pose->at.y);
    put_u16(out, pose->theta);
}

static void read_pose(const uint8_t **in, struct pose *pose)
{
    pose->at.x = take_i24(in);
    pose->at.y = take_i24(in);
    pose->theta = take_u16(in);
}

/* -32,768 has no positive twin; nothing that is sent needs it. */
static int16_t read_i16(const uint8_t **in)
{
    int16_t value = (int16_t)take_u16(in);

    return value == INT16_MIN ? -INT16_MAX : value;
}

static void write_mission(uint8_t **out, const struct message_mission *m)
{
    put_u8(out, m->sequence);
    put_u8(out, m->version);
    put_u8(out, m->mission);
    put_u8(out, m->candidate);
    put_u8(out, m->law);
    put_u8(out, m->allocation);
    put_u16(out, m->k);
    put_u16(out, m->k_theta);
    put_u16(out, (uint16_t)m->v_max);
    put_u16(out, (uint16_t)m->omega_max);
    put_u16(out, (uint16_t)m->track);
    put_u16(out, (uint16_t)m->wheel_max);
    put_u8(out, m->latency);
}

static bool read_mission(const uint8_t **in, struct message_mission *m)
{
    m->sequence = take_u8(in);
    m->version = take_u8(in);
    m->mission = take_u8(in);
    m->candidate = take_u8(in) & 1;
    m->law = take_u8(in);
    m->allocation = take_u8(in);
    m->k = take_u16(in);
    m->k_theta = take_u16(in);
    m->v_max = read_i16(in);
    m->omega_max = read_i16(in);
    m->track = read_i16(in);
    m->wheel_max = read_i16(in);
    m->latency = take_u8(in);
    return m->sequence == 0 && m->mission != 0 && m->law <= LAW_PID &&
           m->allocation <= ALLOCATION_ASSIGNED && m->v_max > 0 && m->omega_max > 0 &&
           m->track > 0 && m->wheel_max > 0;
}

static void write_vertices(uint8_t **out, const struct message_vertices *m)
{
    put_u8(out, m->sequence);
    put_u8(out, m->formation);
    put_u8(out, m->scale);
    put_u16(out, m->total);
    put_u16(out, m->first);
    put_u8(out, m->count);
    for (uint8_t i = 0; i < m->count && i < VERTICES_PER_MESSAGE; i++) {
        put_i24(out, m->vertex[i].distance);
        put_u16(out, m->vertex[i].psi);
    }
}

enum { VERTICES_HEAD = 9, VERTEX_BYTES = 5 };

_Static_assert(VERTICES_HEAD + VERTICES_PER_MESSAGE * VERTEX_BYTES <= FRAME_PAYLOAD_MAX,
               "the longest message fits a frame");

static bool read_vertices(const uint8_t **in, uint8_t length, struct message_vertices *m)
{
    m->sequence = take_u8(in);
    m->formation = take_u8(in);
    m->scale = take_u8(in);
    m->total = take_u16(in);
    m->first = take_u16(in);
    m->count = take_u8(in);
    if (m->formation == 0 || m->scale > FORMATION_SCALE_MAX || m->count == 0 ||
        m->count > VERTICES_PER_MESSAGE || m->first >= m->total || m->count > m->total - m->first ||
        length < VERTICES_HEAD + m->count * VERTEX_BYTES)
        return false;
    for (uint8_t i = 0; i < m->count; i++) {
        m->vertex[i].distance = take_i24(in);
        m->vertex[i].psi = take_u16(in);
    }
    return true;
}

static void write_knot(uint8_t **out, const struct message_knot *m)
{
    put_u8(out, m->sequence);
    put_i32(out, m->knot.time);
    write_pose(out, &m->knot.pose);
    put_u16(out, (uint16_t)m->knot.v);
    put_u16(out, (uint16_t)m->knot.omega);
}

static bool read_knot(const uint8_t **in, struct message_knot *m)
{
    m->sequence = take_u8(in);
    m->knot.time = take_i32(in);
    read_pose(in, &m->knot.pose);
    m->knot.v = read_i16(in);
    m->knot.omega = read_i16(in);
    return m->knot.time >= 0;
}

uint8_t message_write_beacon(uint8_t *payload, const struct message_beacon *m)
{
    uint8_t *at = payload;
    uint8_t **out = &at;

    put_u8(out, MESSAGE_BEACON);
    put_u16(out, m->id);
    put_u16(out, m->time);
    write_pose(out, &m->pose);
    put_u16(out, (uint16_t)m->v);
    put_u16(out, (uint16_t)m->omega);
    put_u8(out, (uint8_t)(m->role | (m->candidate ? BIT_CANDIDATE : 0) |
                          (m->fault ? BIT_FAULT : 0) | (m->to_all ? BIT_TO_ALL : 0)));
    put_u16(out, m->term);
    put_u8(out, m->leader_age);
    put_u16(out, m->vertex);
    put_u8(out, m->formation);
    return (uint8_t)(at - payload);
}

static bool read_beacon(const uint8_t **in, struct message_beacon *m)
{
    m->id = take_u16(in);
    m->time = take_u16(in);
    read_pose(in, &m->pose);
    m->v = read_i16(in);
    m->omega = read_i16(in);
    uint8_t flags = take_u8(in);
    m->role = flags & ROLE_MASK;
    m->candidate = flags & BIT_CANDIDATE;
    m->fault = flags & BIT_FAULT;
    m->to_all = flags & BIT_TO_ALL;
    m->term = take_u16(in);
    m->leader_age = take_u8(in);
    m->vertex = take_u16(in);
    m->formation = take_u8(in);
    return m->id != 0 && m->id <= ROBOT_ID_MAX && m->role <= ROLE_FOLLOWER;
}

uint8_t message_write_status(uint8_t *payload, const struct message_status *m)
{
    uint8_t *at = payload;
    uint8_t **out = &at;

    put_u8(out, MESSAGE_STATUS);
    put_u16(out, m->id);
    put_u8(out, m->version);
    put_u8(out, m->mission);
    put_u8(out, m->expected);
    put_u8(out, m->state);
    put_u8(out, m->faults);
    put_u8(out, m->reset_cause);
    put_u16(out, m->battery);
    put_u16(out, m->bad_frames);
    put_u16(out, m->overruns);
    put_u16(out, m->tick_cycles);
    put_u16(out, m->stack_free);
    put_u16(out, m->vertices_max);
    return (uint8_t)(at - payload);
}

static void read_status(const uint8_t **in, struct message_status *m)
{
    m->id = take_u16(in);
    m->version = take_u8(in);
    m->mission = take_u8(in);
    m->expected = take_u8(in);
    m->state = take_u8(in);
    m->faults = take_u8(in);
    m->reset_cause = take_u8(in);
    m->battery = take_u16(in);
    m->bad_frames = take_u16(in);
    m->overruns = take_u16(in);
    m->tick_cycles = take_u16(in);
    m->stack_free = take_u16(in);
    m->vertices_max = take_u16(in);
}

uint8_t message_write_answer(uint8_t *payload, const struct message_answer *m)
{
    uint8_t *at = payload;
    uint8_t **out = &at;

    put_u8(out, MESSAGE_ANSWER);
    put_u16(out, m->id);
    put_u8(out, m->tag);
    put_u8(out, m->result);
    put_u8(out, m->index);
    put_i32(out, (int32_t)m->value);
    return (uint8_t)(at - payload);
}

static void read_answer(const uint8_t **in, struct message_answer *m)
{
    m->id = take_u16(in);
    m->tag = take_u8(in);
    m->result = take_u8(in);
    m->index = take_u8(in);
    m->value = (uint32_t)take_i32(in);
}

static void write_ask(uint8_t **out, const struct message_ask *m)
{
    put_u8(out, m->tag);
    put_u8(out, m->action);
    put_u8(out, m->index);
    put_i32(out, (int32_t)m->value);
}

static void read_ask(const uint8_t **in, struct message_ask *m)
{
    m->tag = take_u8(in);
    m->action = take_u8(in);
    m->index = take_u8(in);
    m->value = (uint32_t)take_i32(in);
}

static void write_drive(uint8_t **out, const struct message_drive *m)
{
    put_u16(out, (uint16_t)m->left);
    put_u16(out, (uint16_t)m->right);
    put_u8(out, m->corrected ? BIT_CORRECTED : 0);
}

static bool read_drive(const uint8_t **in, struct message_drive *m)
{
    m->left = read_i16(in);
    m->right = read_i16(in);
    m->corrected = take_u8(in) & BIT_CORRECTED;
    return abs32(m->left) <= PWM_STEPS && abs32(m->right) <= PWM_STEPS;
}

uint8_t message_write(uint8_t *payload, const struct message *message)
{
    uint8_t *out = payload;

    put_u8(&out, message->type);
    switch (message->type) {
    case MESSAGE_POSE:
        put_i32(&out, message->pose.time);
        write_pose(&out, &message->pose.pose);
        break;
    case MESSAGE_KEEPALIVE: put_i32(&out, message->keepalive.time); break;
    case MESSAGE_MISSION: write_mission(&out, &message->mission); break;
    case MESSAGE_VERTICES: write_vertices(&out, &message->vertices); break;
    case MESSAGE_KNOT: write_knot(&out, &message->knot); break;
    case MESSAGE_ASSIGN:
        put_u8(&out, message->assign.sequence);
        put_u16(&out, message->assign.vertex);
        break;
    case MESSAGE_ASK: write_ask(&out, &message->ask); break;
    case MESSAGE_DRIVE: write_drive(&out, &message->drive); break;
    case MESSAGE_BEACON: return message_write_beacon(payload, &message->beacon);
    case MESSAGE_STATUS: return message_write_status(payload, &message->status);
    case MESSAGE_ANSWER: return message_write_answer(payload, &message->answer);
    }
    return (uint8_t)(out - payload);
}

/* What version 1 made of a message; one without vertices for MESSAGE_VERTICES. */
static uint8_t least_length(uint8_t type)
{
    static const uint8_t robots[] ROM = {1, 13, 5, 20, VERTICES_HEAD, 18, 4, 1, 8, 6, 1};
    static const uint8_t others[] ROM = {BEACON_BYTES, STATUS_BYTES, ANSWER_BYTES};

    if (type < sizeof robots)
        return rom_u8(&robots[type]);
    uint8_t other = type - MESSAGE_BEACON;
    return other < sizeof others ? rom_u8(&others[other]) : 1;
}

bool message_read(struct message *message, const uint8_t *payload, uint8_t length)
{
    const uint8_t *in = payload;

    if (length == 0)
        return false;
    message->type = take_u8(&in);
    if (length < least_length(message->type))
        return false;
    switch (message->type) {
    case MESSAGE_POSE:
        message->pose.time = take_i32(&in);
        read_pose(&in, &message->pose.pose);
        break;
    case MESSAGE_KEEPALIVE: message->keepalive.time = take_i32(&in); break;
    case MESSAGE_MISSION: return read_mission(&in, &message->mission);
    case MESSAGE_VERTICES: return read_vertices(&in, length, &message->vertices);
    case MESSAGE_KNOT: return read_knot(&in, &message->knot);
    case MESSAGE_ASSIGN:
        message->assign.sequence = take_u8(&in);
        message->assign.vertex = take_u16(&in);
        break;
    case MESSAGE_ASK: read_ask(&in, &message->ask); break;
    case MESSAGE_DRIVE: return read_drive(&in, &message->drive);
    case MESSAGE_BEACON: return read_beacon(&in, &message->beacon);
    case MESSAGE_STATUS: read_status(&in, &message->status); break;
    case MESSAGE_ANSWER: read_answer(&in, &message->answer); break;
    }
    return true;
}
