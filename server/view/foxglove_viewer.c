/* foxglove_viewer.c: those with Foxglove's protocol (foxglove.h). They get the newest scene, at
 * most 30 times a second, and every event that is kept. */
#include "view_state.h"

#include <stdlib.h>
#include <string.h>

#define FRAME_US 33333

/* One after the other before anything else has its turn. */
#define EVENTS_AT_ONCE 64

/* ---- the frame ------------------------------------------------------------------------- */

/* The list with room for `count` elements; as it was when there is no memory. */
static void *grow(void *list, size_t *room, size_t count, size_t size)
{
    void *larger = count > *room ? realloc(list, count * size) : NULL;

    if (larger == NULL)
        return list;
    *room = count;
    return larger;
}

/* What is played counts from the other end: no scene of the reel has its number. */
static bool find_newest(const struct view *view, struct reel_message *newest)
{
    const struct played *played = &view->played;

    if (played->number == 0)
        return reel_newest(view->reel, newest);
    *newest = (struct reel_message){
        .number = UINT32_MAX - played->number, .bytes = played->bytes, .count = played->count};
    return true;
}

/* Copies the newest scene, when it is another one. */
static bool copy_newest(struct view *view)
{
    struct frame *frame = &view->frame;
    struct reel_message newest;

    pthread_mutex_lock(&view->lock);
    bool good =
        find_newest(view, &newest) && (frame->number == 0 || newest.number != frame->scene_number);
    if (good) {
        frame->bytes = grow(frame->bytes, &frame->room, newest.count, 1);
        good = frame->room >= newest.count;
    }
    if (good) {
        memcpy(frame->bytes, newest.bytes, newest.count);
        frame->count = newest.count;
        frame->scene_number = newest.number;
    }
    pthread_mutex_unlock(&view->lock);
    return good;
}

static bool read_frame(struct frame *frame)
{
    size_t robots, vertices;

    if (!scene_counts(frame->bytes, frame->count, &robots, &vertices))
        return false;
    frame->robots = grow(frame->robots, &frame->robot_room, robots, sizeof *frame->robots);
    frame->vertices = grow(frame->vertices, &frame->vertex_room, vertices, sizeof *frame->vertices);
    return scene_read(&frame->scene, frame->robots, frame->robot_room, frame->vertices,
                      frame->vertex_room, frame->bytes, frame->count);
}

static bool make_frame(struct view *view, lws_usec_t now)
{
    struct frame *frame = &view->frame;

    if (!copy_newest(view) || !read_frame(frame))
        return false;
    frame->made = now;
    frame->number++;
    return true;
}

bool foxglove_viewers_tell(struct view *view)
{
    lws_usec_t now = lws_now_usecs();

    if (view->foxgloves == NULL)
        return false;
    if (now - view->frame.made < FRAME_US)
        return true;
    make_frame(view, now);
    peers_ask(view->foxgloves);
    return false;
}

/* ---- sending --------------------------------------------------------------------------- */

static bool greet(struct view *view, struct foxglove_viewer *viewer)
{
    char *text = viewer->greetings == 0 ? foxglove_server_info("muster", view->session)
                                        : foxglove_advertise();
    bool sent = text != NULL && peer_send_text(view, &viewer->peer, text);

    viewer->greetings++;
    free(text);
    return sent;
}

static bool reply(struct view *view, struct foxglove_viewer *viewer)
{
    bool sent = peer_send_text(view, &viewer->peer, viewer->reply);

    viewer->reply[0] = '\0';
    return sent;
}

static size_t write_event(struct view *view, struct foxglove_viewer *viewer)
{
    struct reel_message event;
    size_t count = 0;

    pthread_mutex_lock(&view->lock);
    if (reel_event(view->reel, viewer->event, &event) &&
        view_buffer(view, FOXGLOVE_HEAD + event.count)) {
        foxglove_head(&viewer->foxglove, TOPIC_EVENTS, event.time_ms, view->buffer + LWS_PRE);
        memcpy(view->buffer + LWS_PRE + FOXGLOVE_HEAD, event.bytes, event.count);
        count = FOXGLOVE_HEAD + event.count;
        viewer->event = event.number + 1;
    }
    pthread_mutex_unlock(&view->lock);
    return count;
}

/* True when there may be more. */
static bool send_events(struct view *view, struct foxglove_viewer *viewer, bool *sent)
{
    if (!viewer->foxglove.wanted[TOPIC_EVENTS])
        return false;
    for (int i = 0; i < EVENTS_AT_ONCE && *sent; i++) {
        size_t count = write_event(view, viewer);

        if (count == 0)
            return false;
        *sent = peer_send(view, &viewer->peer, count);
    }
    return true;
}

static size_t write_topic(struct view *view, const struct foxglove_viewer *viewer, enum topic topic)
{
    const struct frame *frame = &view->frame;
    size_t room = topic == TOPIC_FLEET ? frame->count : topic_room(&frame->scene);

    if (!view_buffer(view, FOXGLOVE_HEAD + room))
        return 0;
    uint8_t *head = view->buffer + LWS_PRE;
    uint8_t *body = head + FOXGLOVE_HEAD;
    foxglove_head(&viewer->foxglove, topic, frame->scene.time_ms, head);
    if (topic == TOPIC_FLEET)
        memcpy(body, frame->bytes, frame->count);
    size_t count =
        topic == TOPIC_FLEET ? frame->count : topic_write(topic, &frame->scene, body, room);
    return count > 0 ? FOXGLOVE_HEAD + count : 0;
}

static bool send_time(struct view *view, struct foxglove_viewer *viewer)
{
    if (!view_buffer(view, FOXGLOVE_TIME))
        return false;
    foxglove_time(view->frame.scene.time_ms, view->buffer + LWS_PRE);
    return peer_send(view, &viewer->peer, FOXGLOVE_TIME);
}

/* What is due of the frame: all, or what was wanted after it had been sent. */
static bool send_frame(struct view *view, struct foxglove_viewer *viewer)
{
    bool is_new = viewer->frame != view->frame.number;
    bool sent = !is_new || send_time(view, viewer);

    for (enum topic topic = 0; topic < TOPIC_COUNT && sent; topic++) {
        bool due = viewer->foxglove.wanted[topic] && (is_new || viewer->foxglove.fresh[topic]);

        if (topic == TOPIC_EVENTS || !due)
            continue;
        viewer->foxglove.fresh[topic] = false;
        size_t count = write_topic(view, viewer, topic);
        sent = count > 0 && peer_send(view, &viewer->peer, count);
    }
    viewer->frame = view->frame.number;
    return sent;
}

/* Sends what there is for it. A frame is several messages, which libwebsockets keeps until they
 * have gone; before that it is not asked again. */
static int send_next(struct view *view, struct foxglove_viewer *viewer)
{
    bool sent = true;
    bool more = true;

    if (viewer->greetings < 2) {
        sent = greet(view, viewer);
    } else if (viewer->reply[0] != '\0') {
        sent = reply(view, viewer);
    } else {
        more = send_events(view, viewer, &sent);
        if (view->frame.number > 0 && sent)
            sent = send_frame(view, viewer);
    }
    if (sent && !more && view->over)
        return peer_hang_up(&viewer->peer, LWS_CLOSE_STATUS_GOINGAWAY);
    if (sent && more)
        peer_ask(&viewer->peer);
    return sent ? 0 : -1;
}

/* ---- hearing --------------------------------------------------------------------------- */

static int on_received(struct foxglove_viewer *viewer, const char *bytes, size_t count)
{
    struct peer *peer = &viewer->peer;

    switch (peer_hear(peer, bytes, count)) {
    case HEARD_PART: return 0;
    case HEARD_BINARY: foxglove_hear_binary(viewer->reply); break;
    case HEARD_TOO_MUCH: return peer_hang_up(peer, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE);
    case HEARD_TEXT:
        foxglove_hear_text(&viewer->foxglove, peer->text, peer->count, viewer->reply);
        break;
    }
    peer_ask(peer);
    return 0;
}

static void welcome(struct view *view, struct foxglove_viewer *viewer, struct lws *wsi)
{
    peer_enter(view, &view->foxgloves, &viewer->peer, wsi);
    view_woken(view); /* while nobody looks there are no frames */
}

int foxglove_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                      size_t count)
{
    struct view *view = view_of(wsi);
    struct foxglove_viewer *viewer = user;

    switch (reason) {
    case LWS_CALLBACK_ESTABLISHED: welcome(view, viewer, wsi); return 0;
    case LWS_CALLBACK_SERVER_WRITEABLE: peer_asked(&viewer->peer); return send_next(view, viewer);
    case LWS_CALLBACK_RECEIVE: return on_received(viewer, in, count);
    case LWS_CALLBACK_CLOSED: peer_leave(view, &view->foxgloves, &viewer->peer); return 0;
    default: return 0;
    }
}
