#include "message.h"

#include "formation.h"

enum { BIT_CANDIDATE = 4, BIT_FAULT = 8, BIT_TO_ALL = 16, ROLE_MASK = 3 };

static void write_pose(struct writer *out, const struct pose *pose)
{
    write_i24(out, pose->at.x);
    write_i24(out, pose->at.y);
    write_u16(out, pose->theta);
}

static void read_pose(struct reader *in, struct pose *pose)
{
    pose->at.x = read_i24(in);
    pose->at.y = read_i24(in);
    pose->theta = read_u16(in);
}

/* -32,768 has no positive twin; nothing that is sent needs it. */
static int16_t read_i16(struct reader *in)
{
    int16_t value = (int16_t)read_u16(in);

    return value == INT16_MIN ? -INT16_MAX : value;
}

static void write_mission(struct writer *out, const struct message_mission *m)
{
    write_u8(out, m->sequence);
    write_u8(out, m->version);
    write_u8(out, m->mission);
    write_u8(out, m->candidate);
    write_u8(out, m->law);
    write_u8(out, m->allocation);
    write_u16(out, m->k);
    write_u16(out, m->k_theta);
    write_u16(out, (uint16_t)m->v_max);
    write_u16(out, (uint16_t)m->omega_max);
    write_u16(out, (uint16_t)m->track);
    write_u16(out, (uint16_t)m->wheel_max);
    write_u8(out, m->latency);
}

static bool read_mission(struct reader *in, struct message_mission *m)
{
    m->sequence = read_u8(in);
    m->version = read_u8(in);
    m->mission = read_u8(in);
    m->candidate = read_u8(in) & 1;
    m->law = read_u8(in);
    m->allocation = read_u8(in);
    m->k = read_u16(in);
    m->k_theta = read_u16(in);
    m->v_max = read_i16(in);
    m->omega_max = read_i16(in);
    m->track = read_i16(in);
    m->wheel_max = read_i16(in);
    m->latency = read_u8(in);
    return m->sequence == 0 && m->mission != 0 && m->law <= LAW_PID &&
           m->allocation <= ALLOCATION_ASSIGNED && m->v_max > 0 && m->omega_max > 0 &&
           m->track > 0 && m->wheel_max > 0;
}

static void write_vertices(struct writer *out, const struct message_vertices *m)
{
    write_u8(out, m->sequence);
    write_u8(out, m->formation);
    write_u8(out, m->scale);
    write_u16(out, m->total);
    write_u16(out, m->first);
    write_u8(out, m->count);
    for (uint8_t i = 0; i < m->count && i < VERTICES_PER_MESSAGE; i++) {
        write_i24(out, m->vertex[i].distance);
        write_u16(out, m->vertex[i].psi);
    }
}

static bool read_vertices(struct reader *in, struct message_vertices *m)
{
    m->sequence = read_u8(in);
    m->formation = read_u8(in);
    m->scale = read_u8(in);
    m->total = read_u16(in);
    m->first = read_u16(in);
    m->count = read_u8(in);
    if (m->formation == 0 || m->scale > FORMATION_SCALE_MAX || m->count == 0 ||
        m->count > VERTICES_PER_MESSAGE || m->first >= m->total || m->count > m->total - m->first)
        return false;
    for (uint8_t i = 0; i < m->count; i++) {
        m->vertex[i].distance = read_i24(in);
        m->vertex[i].psi = read_u16(in);
    }
    return true;
}

static void write_knot(struct writer *out, const struct message_knot *m)
{
    write_u8(out, m->sequence);
    write_i32(out, m->knot.time);
    write_pose(out, &m->knot.pose);
    write_u16(out, (uint16_t)m->knot.v);
    write_u16(out, (uint16_t)m->knot.omega);
}

static bool read_knot(struct reader *in, struct message_knot *m)
{
    m->sequence = read_u8(in);
    m->knot.time = read_i32(in);
    read_pose(in, &m->knot.pose);
    m->knot.v = read_i16(in);
    m->knot.omega = read_i16(in);
    return m->knot.time >= 0;
}

static void write_beacon(struct writer *out, const struct message_beacon *m)
{
    write_u16(out, m->id);
    write_u16(out, m->time);
    write_pose(out, &m->pose);
    write_u16(out, (uint16_t)m->v);
    write_u16(out, (uint16_t)m->omega);
    write_u8(out, (uint8_t)(m->role | (m->candidate ? BIT_CANDIDATE : 0) |
                            (m->fault ? BIT_FAULT : 0) | (m->to_all ? BIT_TO_ALL : 0)));
    write_u16(out, m->term);
    write_u8(out, m->leader_age);
    write_u16(out, m->vertex);
    write_u8(out, m->formation);
}

static bool read_beacon(struct reader *in, struct message_beacon *m)
{
    m->id = read_u16(in);
    m->time = read_u16(in);
    read_pose(in, &m->pose);
    m->v = read_i16(in);
    m->omega = read_i16(in);
    uint8_t flags = read_u8(in);
    m->role = flags & ROLE_MASK;
    m->candidate = flags & BIT_CANDIDATE;
    m->fault = flags & BIT_FAULT;
    m->to_all = flags & BIT_TO_ALL;
    m->term = read_u16(in);
    m->leader_age = read_u8(in);
    m->vertex = read_u16(in);
    m->formation = read_u8(in);
    return m->id != 0 && m->id <= ROBOT_ID_MAX && m->role <= ROLE_FOLLOWER;
}

static void write_status(struct writer *out, const struct message_status *m)
{
    write_u16(out, m->id);
    write_u8(out, m->version);
    write_u8(out, m->mission);
    write_u8(out, m->expected);
    write_u8(out, m->state);
    write_u8(out, m->faults);
    write_u8(out, m->reset_cause);
    write_u16(out, m->battery);
    write_u16(out, m->bad_frames);
    write_u16(out, m->overruns);
    write_u16(out, m->tick_cycles);
    write_u16(out, m->stack_free);
    write_u16(out, m->vertices_max);
}

static void read_status(struct reader *in, struct message_status *m)
{
    m->id = read_u16(in);
    m->version = read_u8(in);
    m->mission = read_u8(in);
    m->expected = read_u8(in);
    m->state = read_u8(in);
    m->faults = read_u8(in);
    m->reset_cause = read_u8(in);
    m->battery = read_u16(in);
    m->bad_frames = read_u16(in);
    m->overruns = read_u16(in);
    m->tick_cycles = read_u16(in);
    m->stack_free = read_u16(in);
    m->vertices_max = read_u16(in);
}

uint8_t message_write(uint8_t *payload, const struct message *message)
{
    struct writer out = {payload, FRAME_PAYLOAD_MAX, true};

    write_u8(&out, message->type);
    switch (message->type) {
    case MESSAGE_POSE:
        write_i32(&out, message->pose.time);
        write_pose(&out, &message->pose.pose);
        break;
    case MESSAGE_KEEPALIVE: write_i32(&out, message->keepalive.time); break;
    case MESSAGE_MISSION: write_mission(&out, &message->mission); break;
    case MESSAGE_VERTICES: write_vertices(&out, &message->vertices); break;
    case MESSAGE_KNOT: write_knot(&out, &message->knot); break;
    case MESSAGE_ASSIGN:
        write_u8(&out, message->assign.sequence);
        write_u16(&out, message->assign.vertex);
        break;
    case MESSAGE_BEACON: write_beacon(&out, &message->beacon); break;
    case MESSAGE_STATUS: write_status(&out, &message->status); break;
    }
    return (uint8_t)(FRAME_PAYLOAD_MAX - out.left);
}

bool message_read(struct message *message, const uint8_t *payload, uint8_t length)
{
    struct reader in = {payload, length, true};
    bool in_range = true;

    message->type = read_u8(&in);
    switch (message->type) {
    case MESSAGE_POSE:
        message->pose.time = read_i32(&in);
        read_pose(&in, &message->pose.pose);
        break;
    case MESSAGE_KEEPALIVE: message->keepalive.time = read_i32(&in); break;
    case MESSAGE_MISSION: in_range = read_mission(&in, &message->mission); break;
    case MESSAGE_VERTICES: in_range = read_vertices(&in, &message->vertices); break;
    case MESSAGE_KNOT: in_range = read_knot(&in, &message->knot); break;
    case MESSAGE_ASSIGN:
        message->assign.sequence = read_u8(&in);
        message->assign.vertex = read_u16(&in);
        break;
    case MESSAGE_BEACON: in_range = read_beacon(&in, &message->beacon); break;
    case MESSAGE_STATUS: read_status(&in, &message->status); break;
    }
    return in.ok && in_range;
}
