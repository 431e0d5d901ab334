/* viewer.c: those with our page; docs/VIEWING.md has their protocol. */
#include "view_state.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>

/* Of records in one message: as much as a page draws at once, or little enough that newer ones soon
 * overtake. */
#define BATCH 65536

#define REQUESTS_PER_S 100

/* ---- texts ----------------------------------------------------------------------------- */

char *viewer_answer(uint32_t number, const char *refusal)
{
    json_t *answer =
        json_pack("{s:{s:I,s:s?}}", "answer", "number", (json_int_t)number, "refused", refusal);
    char *text = json_dumps(answer, JSON_COMPACT);

    json_decref(answer);
    return text;
}

/* Takes the text. False: he asks, and reads no answers. */
static bool post(struct viewer *viewer, char *text)
{
    if (text == NULL || viewer->outbox_count == OUTBOX_MAX) {
        free(text);
        return false;
    }
    viewer->outbox[(viewer->outbox_first + viewer->outbox_count++) % OUTBOX_MAX] = text;
    return true;
}

/* ---- sending --------------------------------------------------------------------------- */

static bool send_outbox(struct view *view, struct viewer *viewer)
{
    char *text = viewer->outbox[viewer->outbox_first];
    bool sent = peer_send_text(view, &viewer->peer, text);

    viewer->outbox_first = (viewer->outbox_first + 1) % OUTBOX_MAX;
    viewer->outbox_count--;
    free(text);
    return sent;
}

/* The status when it is new to him; NULL when it is not. */
static char *take_status(struct view *view, struct viewer *viewer)
{
    char *text = NULL;

    pthread_mutex_lock(&view->lock);
    if (viewer->status_number != view->status_number)
        text = strdup(view->status);
    viewer->status_number = view->status_number;
    pthread_mutex_unlock(&view->lock);
    return text;
}

/* The records that are next, in the buffer. */
static size_t take_records(struct view *view, struct viewer *viewer)
{
    size_t count = 0;

    pthread_mutex_lock(&view->lock);
    size_t room = reel_room(view->reel) > BATCH ? reel_room(view->reel) : BATCH;
    if (view_buffer(view, room))
        count = reel_take(view->reel, &viewer->reader, view->buffer + LWS_PRE, room);
    pthread_mutex_unlock(&view->lock);
    return count;
}

/* Sends one message. Returns what the callback is to return. */
static int send_next(struct view *view, struct viewer *viewer)
{
    char *status;
    size_t count;
    bool sent;

    if (!viewer->greeted) {
        viewer->greeted = true;
        sent = peer_send_text(view, &viewer->peer, view->hello);
    } else if (viewer->outbox_count > 0) {
        sent = send_outbox(view, viewer);
    } else if ((status = take_status(view, viewer)) != NULL) {
        sent = peer_send_text(view, &viewer->peer, status);
        free(status);
    } else if ((count = take_records(view, viewer)) > 0) {
        sent = peer_send(view, &viewer->peer, count);
    } else if (view->over) {
        return peer_hang_up(&viewer->peer, LWS_CLOSE_STATUS_GOINGAWAY);
    } else {
        return 0;
    }
    if (!sent)
        return -1;
    peer_ask(&viewer->peer);
    return 0;
}

static struct viewer *find(struct view *view, uint32_t number)
{
    for (struct peer *peer = view->pages; peer != NULL; peer = peer->next) {
        struct viewer *viewer = (struct viewer *)peer;

        if (viewer->number == number)
            return viewer;
    }
    return NULL;
}

/* Those who are gone get no answer; those who do not read theirs go when they ask again. */
static void hand_out_answers(struct view *view)
{
    pthread_mutex_lock(&view->lock);
    while (view->answer_count > 0) {
        const struct view_answer *answer = &view->answer[view->answer_first];
        struct viewer *viewer = find(view, answer->viewer);

        if (viewer != NULL)
            post(viewer, answer->text);
        else
            free(answer->text);
        view->answer_first = (view->answer_first + 1) % ANSWERS_MAX;
        view->answer_count--;
    }
    pthread_mutex_unlock(&view->lock);
}

void viewers_tell(struct view *view)
{
    hand_out_answers(view);
    peers_ask(view->pages);
}

/* ---- requests -------------------------------------------------------------------------- */

static bool hand_on(struct view *view, const struct act *act)
{
    pthread_mutex_lock(&view->lock);
    bool room = view->act_count < ACTS_MAX;
    if (room)
        view->act[(view->act_first + view->act_count) % ACTS_MAX] = *act;
    if (room && view->act_count++ == 0)
        eventfd_write(view->act_event, 1);
    pthread_mutex_unlock(&view->lock);
    return room;
}

static bool too_often(struct viewer *viewer)
{
    lws_usec_t now = lws_now_usecs();

    if (now - viewer->second >= LWS_US_PER_SEC) {
        viewer->second = now;
        viewer->requests = 0;
    }
    return ++viewer->requests > REQUESTS_PER_S;
}

/* Why nothing will come of it; NULL: it is on its way. */
static const char *judge(struct view *view, struct viewer *viewer, struct act *act,
                         enum request_end end, const char *words)
{
    if (too_often(viewer))
        return "more than 100 requests a second";
    if (end != REQUEST_GOOD)
        return words;
    act->viewer = viewer->number;
    return hand_on(view, act) ? NULL : "too many requests are waiting";
}

static bool on_request(struct view *view, struct viewer *viewer)
{
    char words[REQUEST_WORDS_MAX];
    struct act act;
    enum request_end end =
        request_read(&view->rules, viewer->peer.text, viewer->peer.count, &act, words);
    const char *refusal = judge(view, viewer, &act, end, words);

    if (end == REQUEST_UNANSWERABLE || refusal == NULL)
        return true;
    peer_ask(&viewer->peer);
    return post(viewer, viewer_answer(act.number, refusal));
}

static int on_received(struct view *view, struct viewer *viewer, const char *bytes, size_t count)
{
    switch (peer_hear(&viewer->peer, bytes, count)) {
    case HEARD_PART: return 0;
    case HEARD_BINARY: return peer_hang_up(&viewer->peer, LWS_CLOSE_STATUS_UNACCEPTABLE_OPCODE);
    case HEARD_TOO_MUCH: return peer_hang_up(&viewer->peer, LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE);
    case HEARD_TEXT: break;
    }
    if (on_request(view, viewer))
        return 0;
    return peer_hang_up(&viewer->peer, LWS_CLOSE_STATUS_POLICY_VIOLATION);
}

/* ---- coming and going ------------------------------------------------------------------ */

static void welcome(struct view *view, struct viewer *viewer, struct lws *wsi)
{
    viewer->number = ++view->last_viewer;
    peer_enter(view, &view->pages, &viewer->peer, wsi);
}

static void dismiss(struct view *view, struct viewer *viewer)
{
    peer_leave(view, &view->pages, &viewer->peer);
    for (size_t i = 0; i < viewer->outbox_count; i++)
        free(viewer->outbox[(viewer->outbox_first + i) % OUTBOX_MAX]);
}

int viewer_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                    size_t count)
{
    struct view *view = view_of(wsi);
    struct viewer *viewer = user;

    switch (reason) {
    case LWS_CALLBACK_ESTABLISHED: welcome(view, viewer, wsi); return 0;
    case LWS_CALLBACK_SERVER_WRITEABLE: peer_asked(&viewer->peer); return send_next(view, viewer);
    case LWS_CALLBACK_RECEIVE: return on_received(view, viewer, in, count);
    case LWS_CALLBACK_CLOSED: dismiss(view, viewer); return 0;
    default: return 0;
    }
}
