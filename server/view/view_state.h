/* view_state.h: a view's own memory, seen by its parts only.
 *
 *   view.c     what the run's thread calls
 *   thread.c   the view's thread, over libwebsockets: beginning, end, when to look for news
 *   http.c     the page's files, and who may connect at all
 *   peer.c     what all that look have in common
 *   viewer.c   those with our page
 *   foxglove_viewer.c  those with Foxglove's protocol
 */
#ifndef VIEW_STATE_H
#define VIEW_STATE_H

#include "foxglove.h"
#include "place.h"
#include "reel.h"
#include "request.h"

#include <libwebsockets.h>
#include <pthread.h>
#include <stdatomic.h>

#define VIEW_PROTOCOL "muster.view.v1"

#define VIEWERS_MAX 32
#define ACTS_MAX 64
#define ANSWERS_MAX 128

/* For so long a viewer may take nothing of what waits for him. */
#define STUCK_S 30

#define TOKEN_BYTES 16

struct view_answer {
    uint32_t viewer;
    char *text;
};

/* The scene that Foxglove's viewers are to get in place of the newest. */
struct played {
    uint32_t number; /* counts them; 0: none yet */
    uint8_t *bytes;
    size_t count, room;
};

/* The scene that Foxglove's viewers get. */
struct frame {
    uint32_t number;       /* counts them; 0: none yet */
    uint32_t scene_number; /* number of its scene */
    lws_usec_t made;
    uint8_t *bytes;
    size_t count, room;
    struct scene scene;
    struct scene_robot *robots;
    size_t robot_room;
    struct scene_point *vertices;
    size_t vertex_room;
};

struct view {
    /* Of the beginning. */
    struct request_rules rules;
    char kind[16];
    char token[2 * TOKEN_BYTES + 1];
    char session[2 * TOKEN_BYTES + 1]; /* by which Foxglove knows one run from the next */
    char *hello;
    char url[PLACE_HOST_MAX + 64];
    char machine[PLACE_HOST_MAX], address[PLACE_HOST_MAX]; /* names of this host; "" */

    /* Of both threads. */
    pthread_mutex_t lock; /* of what follows, for no longer than copying takes */
    struct reel *reel;
    struct played played;
    char *status;
    uint32_t status_number; /* counts its changes; 0: none yet */
    struct act act[ACTS_MAX];
    size_t act_first;
    struct view_answer answer[ANSWERS_MAX];
    size_t answer_first, answer_count;

    atomic_size_t act_count; /* changed under the lock */
    int act_event;           /* readable while there are acts */
    atomic_size_t viewers;
    atomic_bool looked_at; /* there has been one */
    atomic_uint news;      /* counts what the run's thread has handed over */
    atomic_bool awake;     /* the view's thread looks for news by itself */
    atomic_bool over;

    /* Of the view's thread. */
    pthread_t thread;
    bool running;
    struct lws_context *context;
    int listener;
    int spare;     /* a descriptor to have when there are no more */
    int timer;     /* to the next look for news */
    unsigned seen; /* of the news */
    lws_sorted_usec_list_t end;
    bool late; /* it waits for viewers no longer */
    struct peer *pages, *foxgloves;
    uint32_t last_viewer; /* number */
    struct frame frame;
    uint8_t *buffer; /* LWS_PRE, then what is being sent */
    size_t buffer_room;
};

/* ---- thread.c -------------------------------------------------------------------------- */

/* False and words in `error`. */
bool view_thread_begin(struct view *view, char *error, size_t room);
void view_thread_end(struct view *view);

/* There is news. From any thread. */
void view_wake(struct view *view);

/* In the view's thread, when it was woken. */
void view_woken(struct view *view);

struct view *view_of(struct lws *wsi);

/* Room for so many bytes of a message at buffer + LWS_PRE. */
bool view_buffer(struct view *view, size_t bytes);

/* ---- http.c ---------------------------------------------------------------------------- */

struct http_request {
    const uint8_t *bytes; /* that are still to be sent */
    size_t count;
};

int http_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                  size_t count);

/* ---- peer.c ---------------------------------------------------------------------------- */

/* Somebody who looks. */
struct peer {
    struct peer *next;
    struct lws *wsi;
    bool asked;                   /* to be told when more can be sent */
    char text[REQUEST_BYTES_MAX]; /* that is being received */
    size_t count;
};

enum heard {
    HEARD_PART,
    HEARD_TEXT, /* it is whole */
    HEARD_BINARY,
    HEARD_TOO_MUCH,
};

void peer_enter(struct view *view, struct peer **list, struct peer *peer, struct lws *wsi);
void peer_leave(struct view *view, struct peer **list, struct peer *peer);

/* It is told as soon as it can take more; when it cannot for STUCK_S, it is dropped. */
void peer_ask(struct peer *peer);
void peer_asked(struct peer *peer);
void peers_ask(struct peer *list);

/* A text that is whole is to be used at once. */
enum heard peer_hear(struct peer *peer, const char *bytes, size_t count);
bool peer_send_text(struct view *view, struct peer *peer, const char *text);

/* What stands in the view's buffer. */
bool peer_send(struct view *view, struct peer *peer, size_t count);

/* Returns what the callback is to return. */
int peer_hang_up(struct peer *peer, enum lws_close_status why);

/* ---- viewer.c -------------------------------------------------------------------------- */

#define OUTBOX_MAX 256 /* more than what is read at once may ask for */

struct viewer {
    struct peer peer; /* first */
    uint32_t number;
    bool greeted;
    uint32_t status_number;
    struct reel_reader reader;
    char *outbox[OUTBOX_MAX]; /* texts */
    size_t outbox_first, outbox_count;
    lws_usec_t second; /* that began then, and the requests in it */
    unsigned requests;
};

int viewer_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                    size_t count);

/* There may be something for each of them. */
void viewers_tell(struct view *view);

/* {"answer": ...}; to be freed. NULL: no memory. */
char *viewer_answer(uint32_t number, const char *refusal);

/* ---- foxglove_viewer.c ----------------------------------------------------------------- */

struct foxglove_viewer {
    struct peer peer; /* first */
    struct foxglove foxglove;
    unsigned greetings;             /* that it has had */
    uint32_t frame;                 /* that it has had; 0: none */
    uint32_t event;                 /* that is next */
    char reply[FOXGLOVE_REPLY_MAX]; /* "": none */
};

int foxglove_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                      size_t count);

/* Likewise. True when there will be, in a while: not every scene is sent. */
bool foxglove_viewers_tell(struct view *view);

#endif
