#include "server_state.h"

#include <string.h>

static void hear_beacon(struct server *s, size_t robot, const struct message_beacon *beacon)
{
    struct member *m = &s->member[robot];
    struct server_view *view = &m->view;

    if (!m->known || view->role != beacon->role)
        server_add_report(s, REPORT_ROLE, robot, beacon->role, view->role);
    if (beacon->role == ROLE_LEADER && (view->role != ROLE_LEADER || view->term != beacon->term))
        server_add_report(s, REPORT_ELECTION, robot, beacon->term, view->term);
    if (view->vertex != beacon->vertex)
        server_add_report(s, REPORT_VERTEX, robot, beacon->vertex, view->vertex);
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
    bool ours = status->mission == m->mission;

    server_meet(s, robot, status->id);
    m->view.version = status->version;
    m->view.reset_cause = status->reset_cause;
    m->view.vertices_max = status->vertices_max;
    if ((m->view.faults ^ status->faults) & FAULT_BATTERY)
        s->assign_due = true;
    if (m->view.faults != status->faults)
        server_add_report(s, REPORT_FAULT, robot, status->faults, m->view.faults);
    if (status->bad_frames > m->bad_frames) {
        server_add_report(s, REPORT_LINK, robot, status->bad_frames, m->bad_frames);
        s->bad_frames += (uint64_t)(status->bad_frames - m->bad_frames);
        m->view.bad_frames += (uint32_t)(status->bad_frames - m->bad_frames);
    }
    m->bad_frames = status->bad_frames;
    m->view.state = status->state;
    m->view.faults = status->faults;
    m->view.battery = status->battery;
    m->view.tick_cycles = status->tick_cycles;
    m->view.stack_free = status->stack_free;
    bool first = !m->met;
    m->met = true;
    if (!m->view.linked)
        return;

    /* What it has, nobody here has sent: another server used that number. */
    if (first && s->config->waits && ours) {
        downlink_begin(s, robot);
        return;
    }
    bool agreed = ours ? upload_acknowledge(&m->upload, status->expected) : !m->upload.taken;
    if (!agreed) {
        server_add_report(s, REPORT_RESTART, robot, 0, 0);
        downlink_begin(s, robot);
    }
}

static void count_bad(struct server *s, size_t robot)
{
    s->bad_frames++;
    s->member[robot].view.bad_frames++;
}

static void hear(struct server *s, size_t robot)
{
    struct frame_decoder *decoder = &s->member[robot].decoder;
    uint16_t id = s->config->robots[robot].id;
    struct message message;

    s->member[robot].view.frames++;
    if (!message_read(&message, decoder->payload, decoder->length)) {
        count_bad(s, robot);
    } else if (message.type == MESSAGE_BEACON && message.beacon.id == id && takes_part(s, robot)) {
        hear_beacon(s, robot, &message.beacon);
        relay_beacon(s, robot, &message.beacon, decoder);
    } else if (message.type == MESSAGE_STATUS)
        hear_status(s, robot, &message.status);
    s->received_frames++;
}

void server_receive(struct server *s, size_t robot, const uint8_t *bytes, size_t count)
{
    const uint8_t *next = bytes;

    s->received_bytes += count;
    while (next != bytes + count) {
        enum frame_event event = frame_scan(&s->member[robot].decoder, &next, bytes + count);

        if (event == FRAME_READY)
            hear(s, robot);
        else if (event == FRAME_BAD)
            count_bad(s, robot);
    }
}
