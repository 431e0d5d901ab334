#include "server.h"

#include "assignment.h"
#include "network.h"
#include "outbox.h"
#include "upload.h"

#include <math.h>
#include <string.h>

/* Mission time while robots are being told what to do, and where the count-down starts: far
 * apart, so that robots see the jump (firmware/core/clock.h), and long enough before 0 for the
 * candidates to hear one another and elect. */
#define PREPARE_MS (-60000)
#define PREPARE_END_MS (-10000)
#define COUNTDOWN_MS (-500)

/* Knots sent ahead of the one in force: the robot's window less the two it is between. */
#define KNOTS_AHEAD (KNOTS_MAX - 2)

/* Keep-alives and emergency stops are repeated at 10 Hz. */
#define REPEAT_TICKS 5

#define REPORTS_PER_ROBOT 4
#define NO_VERTEX UINT16_MAX

struct member {
    struct server_view view;
    struct frame_decoder decoder;
    struct upload upload;
    struct server_pose pose;
    uint32_t beacons;           /* heard, numbers them for the loss */
    uint8_t uploaded_formation; /* number, 0 = none */
    uint16_t uploaded_vertex;   /* NO_VERTEX = none */
    uint16_t assigned;          /* vertex it should hold, with rigid and optimal */
    uint32_t next_knot;
    uint16_t bad_frames;        /* it has reported */
    bool pose_due;
    bool known;                 /* has sent a beacon since its link came up */
};

struct server {
    const struct server_config *config;
    uint64_t tick;
    int32_t time;
    bool started;
    bool estopped;
    uint16_t formation;        /* index */
    uint8_t formation_number;  /* on the wire, 1..255 */
    uint16_t formation_of[256]; /* index by number */
    uint32_t knot;             /* in force */
    size_t leader;
    bool assign_due;
    uint64_t received_frames, bytes, bad_frames;
    struct network network;
    struct member *member;
    struct outbox *outbox;
    bool *event_done;
    struct assignment_node *nodes;
    uint32_t *chosen;
    size_t *followers;
    uint16_t *vertices;
    size_t report_room, report_first, report_count;
    struct server_report *report;
    size_t order_room, order_count, order_first;
    struct server_order *order;
};

/* ---- memory ---------------------------------------------------------------------------- */

/* Carves arrays out of one block; with no block it only counts. */
struct carver {
    unsigned char *block;
    size_t used;
};

static void *carve(struct carver *carver, size_t count, size_t size)
{
    size_t at = (carver->used + 15) & ~(size_t)15;

    carver->used = at + count * size;
    return carver->block == NULL ? NULL : carver->block + at;
}

static double longest_delay(const struct server_config *config)
{
    double delay = config->delay;

    for (size_t i = 0; i < config->event_count; i++)
        if (config->events[i].action == EVENT_DELAY)
            delay = fmax(delay, config->events[i].value);
    return delay;
}

static uint32_t ticks_of(double seconds)
{
    return (uint32_t)lround(seconds * TICKS_PER_S);
}

static size_t largest_formation(const struct server_config *config)
{
    size_t largest = 0;

    for (size_t i = 0; i < config->formation_count; i++)
        if (config->formations[i].count > largest)
            largest = config->formations[i].count;
    return largest;
}

static size_t power_of_two_above(size_t n)
{
    size_t power = 1;

    while (power < n)
        power *= 2;
    return power;
}

static size_t lay_out(struct server *s, const struct server_config *config, void *block)
{
    struct carver carver = {block, 0};
    size_t robots = config->robot_count;
    size_t sides = robots + largest_formation(config) + 1;

    carve(&carver, 1, sizeof *s);
    s->network.station_count = robots;
    s->network.cell_count = power_of_two_above(2 * robots);
    /* Beacons come at 20 Hz at most, and one more for every change of role. */
    s->network.flight_room = robots * (4 + ticks_of(longest_delay(config)));
    s->report_room = REPORTS_PER_ROBOT * robots + config->event_count + 1;
    s->order_room = robots + config->event_count;

    s->network.station = carve(&carver, robots, sizeof *s->network.station);
    s->network.cell = carve(&carver, s->network.cell_count, sizeof *s->network.cell);
    s->network.flight = carve(&carver, s->network.flight_room, sizeof *s->network.flight);
    s->member = carve(&carver, robots, sizeof *s->member);
    s->outbox = carve(&carver, robots, sizeof *s->outbox);
    s->event_done = carve(&carver, config->event_count, sizeof *s->event_done);
    s->nodes = carve(&carver, sides, sizeof *s->nodes);
    s->chosen = carve(&carver, sides, sizeof *s->chosen);
    s->followers = carve(&carver, robots, sizeof *s->followers);
    s->vertices = carve(&carver, sides, sizeof *s->vertices);
    s->report = carve(&carver, s->report_room, sizeof *s->report);
    s->order = carve(&carver, s->order_room, sizeof *s->order);
    return carver.used;
}

size_t server_footprint(const struct server_config *config)
{
    struct server layout;

    return lay_out(&layout, config, NULL);
}

static void take_formation(struct server *s, uint16_t formation)
{
    s->formation = formation;
    s->formation_number = s->formation_number == UINT8_MAX ? 1 : s->formation_number + 1;
    s->formation_of[s->formation_number] = formation;
    s->assign_due = true;
}

struct server *server_init(void *memory, const struct server_config *config)
{
    struct server *s = memory;

    memset(memory, 0, server_footprint(config));
    lay_out(s, config, memory);
    s->config = config;
    s->time = PREPARE_MS;
    s->leader = SERVER_NOBODY;
    s->network.seed = config->seed;
    s->network.range = config->range;
    s->network.loss = config->loss;
    s->network.delay_ticks = ticks_of(config->delay);
    for (size_t i = 0; i < config->robot_count; i++)
        s->network.station[i].id = config->robots[i].id;
    take_formation(s, config->formation);
    return s;
}

/* ---- reports and orders ---------------------------------------------------------------- */

static void report(struct server *s, enum server_report_kind kind, size_t robot, uint32_t value,
                   uint32_t was)
{
    if (s->report_count == s->report_room)
        return;
    size_t place = (s->report_first + s->report_count++) % s->report_room;
    s->report[place] = (struct server_report){
        .kind = kind,
        .robot = robot == SERVER_NOBODY ? 0 : s->config->robots[robot].id,
        .value = value,
        .was = was,
    };
}

bool server_next_report(struct server *s, struct server_report *next)
{
    if (s->report_count == 0)
        return false;
    *next = s->report[s->report_first];
    s->report_first = (s->report_first + 1) % s->report_room;
    s->report_count--;
    return true;
}

static void give_order(struct server *s, enum event_action action, size_t robot)
{
    if (s->order_count == s->order_room)
        return;
    size_t place = (s->order_first + s->order_count++) % s->order_room;
    s->order[place] = (struct server_order){action, robot};
}

bool server_next_order(struct server *s, struct server_order *next)
{
    if (s->order_count == 0)
        return false;
    *next = s->order[s->order_first];
    s->order_first = (s->order_first + 1) % s->order_room;
    s->order_count--;
    return true;
}

/* ---- what robots are told -------------------------------------------------------------- */

static bool host_allocates(const struct server *s)
{
    return s->config->allocation == SERVER_RIGID || s->config->allocation == SERVER_OPTIMAL;
}

static void begin_upload(struct server *s, size_t robot)
{
    struct member *m = &s->member[robot];

    upload_begin(&m->upload);
    m->uploaded_formation = 0;
    m->uploaded_vertex = NO_VERTEX;
    m->next_knot = s->knot;
}

static void add_formation(struct server *s, struct member *m)
{
    uint16_t total = s->config->formations[s->formation].count;
    size_t parts = (total + VERTICES_PER_MESSAGE - 1u) / VERTICES_PER_MESSAGE;

    if (m->uploaded_formation == s->formation_number || upload_room(&m->upload) < parts)
        return;
    m->uploaded_formation = s->formation_number;
    for (uint16_t first = 0; first < total; first += VERTICES_PER_MESSAGE)
        upload_add(&m->upload,
                   (struct upload_item){UPLOAD_VERTICES, s->formation_number, first});
}

static void add_knots(struct server *s, size_t robot)
{
    struct member *m = &s->member[robot];

    if (!s->config->robots[robot].candidate)
        return;
    while (m->next_knot < s->config->knot_count && m->next_knot <= s->knot + KNOTS_AHEAD &&
           upload_room(&m->upload) > 0)
        upload_add(&m->upload,
                   (struct upload_item){.kind = UPLOAD_KNOT, .index = m->next_knot++});
}

static void add_assignment(struct server *s, struct member *m)
{
    if (!host_allocates(s) || m->uploaded_vertex == m->assigned || upload_room(&m->upload) == 0)
        return;
    m->uploaded_vertex = m->assigned;
    upload_add(&m->upload, (struct upload_item){.kind = UPLOAD_ASSIGN, .index = m->assigned});
}

static void fill_vertices(const struct server *s, const struct upload_item *item,
                          struct message_vertices *part)
{
    const struct server_formation *formation =
        &s->config->formations[s->formation_of[item->formation]];
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

static int32_t wide_of(double metres)
{
    return (int32_t)lround(metres * NARROW_PER_M);
}

static angle_t angle_of(double radians)
{
    double turns = radians / (2 * M_PI);

    return (angle_t)(int64_t)llround((turns - floor(turns)) * ANGLE_TURN);
}

static void send_message(struct outbox *outbox, struct outbox_room *room,
                         const struct message *message)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];
    uint8_t frame[FRAME_BYTES_MAX];

    outbox_send(outbox, room, frame,
                frame_encode(frame, payload, message_write(payload, message)));
}

static void send_pose(struct server *s, size_t robot, struct outbox_room *room)
{
    struct member *m = &s->member[robot];
    struct message message = {.type = MESSAGE_POSE};

    if (!m->pose_due)
        return;
    m->pose_due = false;
    if (m->pose.tracked) {
        message.pose.time = s->time;
        message.pose.pose.at = (struct vec32){wide_of(m->pose.x), wide_of(m->pose.y)};
        message.pose.pose.theta = angle_of(m->pose.theta);
    } else if (s->tick % REPEAT_TICKS == 0) {
        message.type = MESSAGE_KEEPALIVE;
        message.keepalive.time = s->time;
    } else {
        return;
    }
    send_message(&s->outbox[robot], room, &message);
}

static void send_estop(struct server *s, size_t robot, struct outbox_room *room)
{
    bool heard = s->member[robot].view.faults & FAULT_ESTOP;
    struct message message = {.type = MESSAGE_ESTOP};

    if (s->estopped && !heard && s->tick % REPEAT_TICKS == 0 && room->left > 0)
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

    if (!s->member[robot].view.linked)
        return 0;
    outbox_resume(outbox, &room);
    if (room.left > 0)
        send_pose(s, robot, &room);
    send_estop(s, robot, &room);
    send_orders(s, robot, &room, room_for / 2);
    outbox_send_beacons(outbox, &room);
    send_orders(s, robot, &room, 0);

    size_t taken = room_for - room.left;
    s->bytes += taken;
    return taken;
}

/* ---- what robots say ------------------------------------------------------------------- */

void server_link(struct server *s, size_t robot, bool up)
{
    struct member *m = &s->member[robot];

    if (m->view.linked == up)
        return;
    m->view = (struct server_view){.linked = up};
    m->known = false;
    m->bad_frames = 0;
    s->network.station[robot].linked = up;
    s->assign_due = true;
    frame_decoder_init(&m->decoder);
    outbox_clear(&s->outbox[robot]);
    begin_upload(s, robot);
}

static void hear_beacon(struct server *s, size_t robot, const struct message_beacon *beacon)
{
    struct member *m = &s->member[robot];
    struct server_view *view = &m->view;

    if (!m->known || view->role != beacon->role)
        report(s, REPORT_ROLE, robot, beacon->role, view->role);
    if (beacon->role == ROLE_LEADER && (view->role != ROLE_LEADER || view->term != beacon->term))
        report(s, REPORT_ELECTION, robot, beacon->term, view->term);
    if (view->vertex != beacon->vertex)
        report(s, REPORT_VERTEX, robot, beacon->vertex, view->vertex);
    m->known = true;
    view->role = beacon->role;
    view->term = beacon->term;
    view->vertex = beacon->vertex;
}

static void relay_beacon(struct server *s, size_t robot, const struct message_beacon *beacon,
                         const struct frame_decoder *decoder)
{
    bool to_all = beacon->to_all && s->config->robots[robot].candidate;
    struct beacon_frame frame = {.sender = beacon->id};
    uint8_t bytes[FRAME_BYTES_MAX];

    frame.length = frame_encode(bytes, decoder->payload, decoder->length);
    if (frame.length > sizeof frame.bytes) {
        s->bad_frames++; /* a later version's, too long for this one */
        return;
    }
    memcpy(frame.bytes, bytes, frame.length);
    network_send(&s->network, s->tick + 1, robot, s->member[robot].beacons++, to_all, &frame);
}

static void hear_status(struct server *s, size_t robot, const struct message_status *status)
{
    struct member *m = &s->member[robot];
    bool ours = status->mission == s->config->mission.mission;

    if (m->view.faults != status->faults)
        report(s, REPORT_FAULT, robot, status->faults, m->view.faults);
    if (status->bad_frames > m->bad_frames) {
        report(s, REPORT_LINK, robot, status->bad_frames, m->bad_frames);
        s->bad_frames += (uint64_t)(status->bad_frames - m->bad_frames);
    }
    m->bad_frames = status->bad_frames;
    m->view.state = status->state;
    m->view.faults = status->faults;
    m->view.battery = status->battery;
    m->view.tick_cycles = status->tick_cycles;
    m->view.stack_free = status->stack_free;

    bool agreed = ours ? upload_acknowledge(&m->upload, status->expected)
                       : m->upload.acknowledged == 0;
    if (!agreed) {
        report(s, REPORT_RESTART, robot, 0, 0);
        begin_upload(s, robot);
    }
}

static void hear(struct server *s, size_t robot)
{
    struct frame_decoder *decoder = &s->member[robot].decoder;
    uint16_t id = s->config->robots[robot].id;
    struct message message;

    if (!message_read(&message, decoder->payload, decoder->length))
        s->bad_frames++;
    else if (message.type == MESSAGE_BEACON && message.beacon.id == id) {
        hear_beacon(s, robot, &message.beacon);
        relay_beacon(s, robot, &message.beacon, decoder);
    } else if (message.type == MESSAGE_STATUS)
        hear_status(s, robot, &message.status);
    s->received_frames++;
}

void server_receive(struct server *s, size_t robot, const uint8_t *bytes, size_t count)
{
    s->bytes += count;
    for (size_t i = 0; i < count; i++) {
        switch (frame_decode(&s->member[robot].decoder, bytes[i])) {
        case FRAME_READY:
            hear(s, robot);
            break;
        case FRAME_BAD:
            s->bad_frames++;
            break;
        case FRAME_PENDING:
            break;
        }
    }
}

/* ---- the tick -------------------------------------------------------------------------- */

size_t server_waits_for(const struct server *s)
{
    for (size_t i = 0; i < s->config->robot_count; i++)
        if (s->member[i].view.linked && !upload_done(&s->member[i].upload))
            return i;
    return SERVER_NOBODY;
}

static bool anyone_linked(const struct server *s)
{
    for (size_t i = 0; i < s->config->robot_count; i++)
        if (s->member[i].view.linked)
            return true;
    return false;
}

static void advance_time(struct server *s)
{
    s->tick++;
    s->time += TICK_MS;
    if (!s->started) {
        if (s->time > PREPARE_MS + TICK_MS && anyone_linked(s) &&
            server_waits_for(s) == SERVER_NOBODY) {
            s->started = true;
            s->time = COUNTDOWN_MS;
        } else if (s->time >= PREPARE_END_MS) {
            s->time = PREPARE_MS;
        }
    } else if (s->time == 0) {
        report(s, REPORT_START, SERVER_NOBODY, 0, 0);
    }
    while (s->knot + 1 < s->config->knot_count && s->config->knots[s->knot + 1].time <= s->time)
        s->knot++;
}

static void find_leader(struct server *s)
{
    size_t leader = SERVER_NOBODY;

    for (size_t i = 0; i < s->config->robot_count; i++) {
        const struct server_view *view = &s->member[i].view;

        if (!view->linked || !s->member[i].known || view->role != ROLE_LEADER)
            continue;
        if (leader == SERVER_NOBODY || view->term > s->member[leader].view.term ||
            (view->term == s->member[leader].view.term &&
             s->config->robots[i].id < s->config->robots[leader].id))
            leader = i;
    }
    if (leader != s->leader)
        s->assign_due = true;
    s->leader = leader;
}

static size_t index_of(const struct server *s, uint16_t id)
{
    if (id == EVENT_LEADER)
        return s->leader;
    for (size_t i = 0; i < s->config->robot_count; i++)
        if (s->config->robots[i].id == id)
            return i;
    return SERVER_NOBODY;
}

static bool event_holds(const struct server *s, const struct event *event)
{
    if (s->time < 0 || (int64_t)(s->time / TICK_MS) < event->at_tick)
        return false;
    if (event->when == NULL)
        return true;
    if (s->leader == SERVER_NOBODY)
        return false;
    const struct server_pose *pose = &s->member[s->leader].pose;
    struct event_view view = {s->time / 1000.0, pose->x, pose->y, pose->theta};
    return event->when(event->condition, &view);
}

static void set_groups(struct server *s, const uint16_t *groups)
{
    for (size_t i = 0; i < s->config->robot_count; i++)
        s->network.station[i].group = groups == NULL ? 0 : groups[i];
}

/* False when the event must wait: it names the leader and there is none. */
static bool carry_out(struct server *s, const struct event *event)
{
    size_t robot = SERVER_NOBODY;

    switch (event->action) {
    case EVENT_KILL:
    case EVENT_REVIVE:
    case EVENT_STALL:
        robot = index_of(s, event->robot);
        if (robot == SERVER_NOBODY)
            return false;
        give_order(s, event->action, robot);
        break;
    case EVENT_MUTE:
    case EVENT_UNMUTE:
        robot = index_of(s, event->robot);
        if (robot == SERVER_NOBODY)
            return false;
        s->network.station[robot].muted = event->action == EVENT_MUTE;
        break;
    case EVENT_FORMATION:
        take_formation(s, event->formation);
        break;
    case EVENT_LOSS:
        s->network.loss = event->value;
        break;
    case EVENT_DELAY:
        s->network.delay_ticks = ticks_of(event->value);
        break;
    case EVENT_RANGE:
        s->network.range = event->value;
        break;
    case EVENT_ESTOP:
        s->estopped = true;
        break;
    case EVENT_PARTITION:
        set_groups(s, event->groups);
        break;
    case EVENT_HEAL:
        set_groups(s, NULL);
        break;
    }
    report(s, REPORT_EVENT, robot, event->action, 0);
    return true;
}

static void run_events(struct server *s)
{
    for (size_t i = 0; i < s->config->event_count; i++)
        if (!s->event_done[i] && event_holds(s, &s->config->events[i]))
            s->event_done[i] = carry_out(s, &s->config->events[i]);
}

/* ---- allocation by the host ------------------------------------------------------------ */

static uint16_t leader_vertex(const struct server_formation *formation)
{
    for (uint16_t i = 0; i < formation->count; i++)
        if (formation->vertex[i].distance == 0)
            return i + 1;
    return 0;
}

/* The k-th robot has vertex k; the leader swaps with the robot whose vertex is the leader's. */
static void assign_rigid(struct server *s, const struct server_formation *formation)
{
    uint16_t leader = leader_vertex(formation);

    for (size_t i = 0; i < s->config->robot_count; i++) {
        uint16_t vertex = i < formation->count ? (uint16_t)(i + 1) : 0;

        if (vertex == leader)
            vertex = s->leader < formation->count ? (uint16_t)(s->leader + 1) : 0;
        s->member[i].assigned = vertex;
    }
    s->member[s->leader].assigned = leader;
}

/* Followers and vertices, whichever are fewer being the rows. */
struct matching {
    const struct server *server;
    const struct server_formation *formation;
    bool vertices_are_rows;
};

static double matching_cost(const void *context, size_t row, size_t column)
{
    const struct matching *m = context;
    const struct server *s = m->server;
    size_t robot = s->followers[m->vertices_are_rows ? column : row];
    uint16_t vertex = s->vertices[m->vertices_are_rows ? row : column];
    const struct polar_vertex *v = &m->formation->vertex[vertex - 1];
    const struct server_pose *leader = &s->member[s->leader].pose;
    const struct server_pose *pose = &s->member[robot].pose;
    double distance = (double)v->distance / NARROW_PER_M;
    double direction = leader->theta + v->psi * 2 * M_PI / ANGLE_TURN;

    return hypot(leader->x + distance * cos(direction) - pose->x,
                 leader->y + distance * sin(direction) - pose->y);
}

static void assign_optimal(struct server *s, const struct server_formation *formation)
{
    uint16_t leader = leader_vertex(formation);
    size_t followers = 0;
    size_t vertices = 0;

    for (size_t i = 0; i < s->config->robot_count; i++) {
        s->member[i].assigned = 0;
        if (s->member[i].view.linked && i != s->leader)
            s->followers[followers++] = i;
    }
    for (uint16_t v = 1; v <= formation->count; v++)
        if (v != leader)
            s->vertices[vertices++] = v;

    struct matching matching = {s, formation, vertices < followers};
    size_t rows = vertices < followers ? vertices : followers;
    size_t columns = vertices < followers ? followers : vertices;
    assignment_solve(rows, columns, matching_cost, &matching, s->nodes, s->chosen);
    for (size_t row = 0; row < rows; row++) {
        size_t follower = matching.vertices_are_rows ? s->chosen[row] : row;
        size_t vertex = matching.vertices_are_rows ? row : s->chosen[row];

        s->member[s->followers[follower]].assigned = s->vertices[vertex];
    }
    s->member[s->leader].assigned = leader;
}

static void assign(struct server *s)
{
    const struct server_formation *formation = &s->config->formations[s->formation];

    if (!s->assign_due || !host_allocates(s) || s->leader == SERVER_NOBODY)
        return;
    s->assign_due = false;
    if (s->config->allocation == SERVER_RIGID)
        assign_rigid(s, formation);
    else
        assign_optimal(s, formation);
}

void server_tick(struct server *s, const struct server_pose *poses)
{
    advance_time(s);
    for (size_t i = 0; i < s->config->robot_count; i++) {
        struct station *station = &s->network.station[i];

        s->member[i].pose = poses[i];
        s->member[i].pose_due = true;
        station->x = poses[i].x;
        station->y = poses[i].y;
        station->tracked = poses[i].tracked;
    }
    find_leader(s);
    run_events(s);
    assign(s);
    network_deliver(&s->network, s->tick, s->outbox);
    for (size_t i = 0; i < s->config->robot_count; i++) {
        struct member *m = &s->member[i];

        if (!m->view.linked)
            continue;
        add_formation(s, m);
        add_knots(s, i);
        add_assignment(s, m);
        upload_wait(&m->upload);
    }
}

/* ---- looking in ------------------------------------------------------------------------ */

int32_t server_time(const struct server *s)
{
    return s->time;
}

size_t server_leader(const struct server *s)
{
    return s->leader;
}

uint16_t server_formation(const struct server *s)
{
    return s->formation;
}

const struct server_view *server_look(const struct server *s, size_t robot)
{
    return &s->member[robot].view;
}

struct server_counters server_count(const struct server *s)
{
    struct server_counters counters = {
        .frames = s->received_frames,
        .bytes = s->bytes,
        .dropped = s->network.dropped,
        .bad_frames = s->bad_frames,
    };

    for (size_t i = 0; i < s->config->robot_count; i++) {
        counters.frames += s->outbox[i].frames;
        counters.dropped += s->outbox[i].dropped;
    }
    return counters;
}
