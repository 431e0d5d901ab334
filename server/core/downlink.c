#include "server_state.h"
#include "units.h"

#include <string.h>

/* Knots sent ahead of the one in force: the robot's window less the two it is between. */
#define KNOTS_AHEAD (KNOTS_MAX - 2)

/* Keep-alives and emergency stops are repeated at 10 Hz. */
#define REPEAT_TICKS 5

bool host_allocates(const struct server *s)
{
    return s->config->allocation == SERVER_RIGID || s->config->allocation == SERVER_OPTIMAL;
}

void downlink_begin(struct server *s, size_t robot)
{
    struct member *m = &s->member[robot];

    upload_begin(&m->upload);
    m->view.acknowledged = false;
    m->mission = m->mission == UINT8_MAX ? 1 : m->mission + 1;
    m->uploaded_formation = 0;
    m->uploaded_vertex = NO_VERTEX;
    m->next_knot = s->knot;
}

bool takes_part(const struct server *s, size_t robot)
{
    const struct member *m = &s->member[robot];

    return m->view.linked && (m->met || !s->config->waits);
}

static void add_formation(struct server *s, struct member *m)
{
    uint16_t total = server_formation_at(s, s->formation)->count;
    size_t parts = (total + VERTICES_PER_MESSAGE - 1u) / VERTICES_PER_MESSAGE;

    if (m->uploaded_formation == s->formation_number || upload_room(&m->upload) < parts)
        return;
    m->uploaded_formation = s->formation_number;
    for (uint16_t first = 0; first < total; first += VERTICES_PER_MESSAGE)
        upload_add(&m->upload, (struct upload_item){UPLOAD_VERTICES, s->formation_number, first});
}

static void add_knots(struct server *s, size_t robot)
{
    struct member *m = &s->member[robot];

    if (!s->config->robots[robot].candidate)
        return;
    while (m->next_knot < s->config->knot_count && m->next_knot <= s->knot + KNOTS_AHEAD &&
           upload_room(&m->upload) > 0)
        upload_add(&m->upload, (struct upload_item){.kind = UPLOAD_KNOT, .index = m->next_knot++});
}

static void add_assignment(struct server *s, struct member *m)
{
    if (!host_allocates(s) || m->uploaded_vertex == m->assigned || upload_room(&m->upload) == 0)
        return;
    m->uploaded_vertex = m->assigned;
    upload_add(&m->upload, (struct upload_item){.kind = UPLOAD_ASSIGN, .index = m->assigned});
}

void downlink_tick(struct server *s, size_t robot)
{
    struct member *m = &s->member[robot];

    add_formation(s, m);
    add_knots(s, robot);
    add_assignment(s, m);
    upload_wait(&m->upload);
    if (upload_done(&m->upload))
        m->view.acknowledged = true;
}

static void fill_vertices(const struct server *s, const struct upload_item *item,
                          struct message_vertices *part)
{
    const struct server_formation *formation =
        server_formation_at(s, s->formation_of[item->formation]);
    uint32_t left = formation->count - item->index;

    part->formation = item->formation;
    part->scale = formation->scale;
    part->total = formation->count;
    part->first = (uint16_t)item->index;
    part->count = left < VERTICES_PER_MESSAGE ? (uint8_t)left : VERTICES_PER_MESSAGE;
    memcpy(part->vertex, &formation->vertex[item->index], part->count * sizeof *part->vertex);
}

static struct message order_message(const struct server *s, size_t robot,
                                    const struct upload_item *item, uint8_t sequence)
{
    struct message message = {0};

    switch ((enum upload_kind)item->kind) {
    case UPLOAD_MISSION:
        message.type = MESSAGE_MISSION;
        message.mission = s->config->mission;
        message.mission.sequence = sequence;
        message.mission.mission = s->member[robot].mission;
        message.mission.candidate = s->config->robots[robot].candidate;
        message.mission.allocation = host_allocates(s) ? ALLOCATION_ASSIGNED
                                     : s->config->allocation == SERVER_CPA_LITERAL
                                         ? ALLOCATION_CPA_LITERAL
                                         : ALLOCATION_CPA;
        break;
    case UPLOAD_VERTICES:
        message.type = MESSAGE_VERTICES;
        fill_vertices(s, item, &message.vertices);
        message.vertices.sequence = sequence;
        break;
    case UPLOAD_KNOT:
        message.type = MESSAGE_KNOT;
        message.knot = (struct message_knot){sequence, s->config->knots[item->index]};
        break;
    case UPLOAD_ASSIGN:
        message.type = MESSAGE_ASSIGN;
        message.assign = (struct message_assign){sequence, (uint16_t)item->index};
        break;
    }
    return message;
}

static void send_message(struct outbox *outbox, struct outbox_room *room,
                         const struct message *message)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];
    uint8_t frame[FRAME_BYTES_MAX];

    outbox_send(outbox, room, frame, frame_encode(frame, payload, message_write(payload, message)));
}

static void send_pose(struct server *s, size_t robot, struct outbox_room *room)
{
    struct member *m = &s->member[robot];
    struct message message = {.type = MESSAGE_POSE};

    m->pose_due = false;
    message.pose.time = s->time - m->pose.age_ms;
    message.pose.pose.at = (struct vec32){wide_of(m->pose.x), wide_of(m->pose.y)};
    message.pose.pose.theta = angle_of(m->pose.theta);
    send_message(&s->outbox[robot], room, &message);
}

/* At most once a tick. */
static void send_keepalive(struct server *s, size_t robot, int32_t time, struct outbox_room *room)
{
    struct message message = {.type = MESSAGE_KEEPALIVE, .keepalive = {.time = time}};

    if (s->member[robot].told == s->tick)
        return;
    s->member[robot].told = s->tick;
    send_message(&s->outbox[robot], room, &message);
}

static void send_life(struct server *s, size_t robot, struct outbox_room *room)
{
    const struct member *m = &s->member[robot];

    if (room->left == 0)
        return;
    if (m->view.halted)
        send_keepalive(s, robot, PREPARE_MS, room);
    else if (m->pose_due && m->pose.tracked)
        send_pose(s, robot, room);
    else if (!m->pose.tracked && s->tick % REPEAT_TICKS == 0)
        send_keepalive(s, robot, s->time, room);
}

static void send_estop(struct server *s, size_t robot, struct outbox_room *room)
{
    bool heard = s->member[robot].view.faults & FAULT_ESTOP;
    struct message message = {.type = MESSAGE_ESTOP};

    if (s->estopped && !heard && (s->tick - s->estop_tick) % REPEAT_TICKS == 0 && room->left > 0)
        send_message(&s->outbox[robot], room, &message);
}

/* Leaves `spare` bytes of the room to others. */
static void send_orders(struct server *s, size_t robot, struct outbox_room *room, size_t spare)
{
    struct upload_item item;
    uint8_t sequence;

    while (room->left > spare && upload_next(&s->member[robot].upload, &item, &sequence)) {
        struct message message = order_message(s, robot, &item, sequence);

        send_message(&s->outbox[robot], room, &message);
    }
}

size_t server_take(struct server *s, size_t robot, uint8_t *bytes, size_t room_for)
{
    struct outbox *outbox = &s->outbox[robot];
    struct outbox_room room = {bytes, room_for};

    if (!s->member[robot].wired || s->member[robot].view.stranger)
        return 0;
    outbox_resume(outbox, &room);
    send_life(s, robot, &room);
    send_estop(s, robot, &room);
    if (takes_part(s, robot)) {
        size_t half = room_for / 2;

        /* Of a slow link's little room the pose may leave less than half. */
        send_orders(s, robot, &room, room.left > half ? half : room.left / 2);
        outbox_send_beacons(outbox, &room);
        send_orders(s, robot, &room, 0);
    }

    size_t taken = room_for - room.left;
    s->member[robot].bytes += taken;
    return taken;
}
