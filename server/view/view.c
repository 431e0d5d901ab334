#define _GNU_SOURCE /* getentropy */

#include "view.h"

#include "view_state.h"

#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/random.h>
#include <unistd.h>

#define REEL_BYTES ((size_t)64 << 20)
#define VERSION 1

/* ---- beginning and end ----------------------------------------------------------------- */

static json_t *words_of(uint32_t acts)
{
    json_t *words = json_array();

    for (int kind = 0; kind < ACT_COUNT; kind++)
        if ((acts & ACT_BIT(kind)) != 0)
            json_array_append_new(words, json_string(act_words[kind]));
    return words;
}

/* Takes the reference. */
static char *text_of(json_t *json)
{
    char *text = json_dumps(json, JSON_COMPACT);

    json_decref(json);
    return text;
}

/* A name that has been cut may be text no longer. */
static json_t *name_of(const char *name)
{
    json_t *text = json_string(name);

    return text != NULL ? text : json_string("");
}

static char *hello(const struct view_about *about)
{
    return text_of(json_pack("{s:{s:i,s:s,s:o,s:f,s:o}}", "hello", "version", VERSION, "kind",
                             about->kind, "title", name_of(about->title), "duration",
                             about->duration, "acts", words_of(about->acts)));
}

static bool make_token(char token[2 * TOKEN_BYTES + 1])
{
    uint8_t bytes[TOKEN_BYTES];

    if (getentropy(bytes, sizeof bytes) != 0)
        return false;
    for (int i = 0; i < TOKEN_BYTES; i++)
        snprintf(token + 2 * i, 3, "%02x", bytes[i]);
    return true;
}

static void introduce(struct view *view, const struct view_options *options,
                      const struct view_about *about)
{
    char name[PLACE_HOST_MAX + 8];

    snprintf(view->kind, sizeof view->kind, "%s", about->kind);
    view->rules = (struct request_rules){view->token, view->kind, about->acts};
    place_name(view->listener, name, sizeof name);
    snprintf(view->url, sizeof view->url, "http://%s/#%s", name, view->token);
    gethostname(view->machine, sizeof view->machine - 1);
    snprintf(view->address, sizeof view->address, "%s",
             options->address != NULL ? options->address : "");
}

static bool begin(struct view *view, const struct view_options *options,
                  const struct view_about *about, char *error, size_t room)
{
    view->reel = reel_open(REEL_BYTES);
    view->hello = hello(about);
    view->act_event = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    if (view->reel == NULL || view->hello == NULL || view->act_event < 0 ||
        !make_token(view->token) || !make_token(view->session)) {
        snprintf(error, room, "no memory, descriptors or random numbers for a view: %s",
                 strerror(errno));
        return false;
    }
    view->listener = place_listen(options, error, room);
    if (view->listener < 0)
        return false;
    introduce(view, options, about);
    return view_thread_begin(view, error, room);
}

/* Who waits for it lends the view's thread his priority: it has a low one of its own. */
static void make_lock(pthread_mutex_t *lock)
{
    pthread_mutexattr_t kind;

    pthread_mutexattr_init(&kind);
    pthread_mutexattr_setprotocol(&kind, PTHREAD_PRIO_INHERIT);
    pthread_mutex_init(lock, &kind);
    pthread_mutexattr_destroy(&kind);
}

struct view *view_open(const struct view_options *options, const struct view_about *about,
                       char *error, size_t room)
{
    struct view *view = calloc(1, sizeof *view);

    if (view == NULL) {
        snprintf(error, room, "no memory for a view");
        return NULL;
    }
    make_lock(&view->lock);
    view->listener = view->act_event = view->spare = view->timer = -1;
    if (begin(view, options, about, error, room))
        return view;
    view_close(view);
    return NULL;
}

static void close_descriptor(int descriptor)
{
    if (descriptor >= 0)
        close(descriptor);
}

void view_close(struct view *view)
{
    if (view == NULL)
        return;
    view_thread_end(view);
    for (size_t i = 0; i < view->answer_count; i++)
        free(view->answer[(view->answer_first + i) % ANSWERS_MAX].text);
    close_descriptor(view->listener);
    close_descriptor(view->act_event);
    close_descriptor(view->spare);
    close_descriptor(view->timer);
    reel_close(view->reel);
    free(view->hello);
    free(view->status);
    free(view->played.bytes);
    free(view->buffer);
    free(view->frame.bytes);
    free(view->frame.robots);
    free(view->frame.vertices);
    pthread_mutex_destroy(&view->lock);
    free(view);
}

const char *view_url(const struct view *view)
{
    return view->url;
}

/* ---- what happens ---------------------------------------------------------------------- */

static void add(struct view *view, enum reel_kind kind, int32_t time_ms, const uint8_t *message,
                size_t count)
{
    pthread_mutex_lock(&view->lock);
    reel_add(view->reel, kind, time_ms, message, count);
    pthread_mutex_unlock(&view->lock);
    view_wake(view);
}

void view_scene(struct view *view, int32_t time_ms, const uint8_t *fleet, size_t count)
{
    add(view, REEL_SCENE, time_ms, fleet, count);
}

void view_event(struct view *view, int32_t time_ms, const uint8_t *log, size_t count)
{
    add(view, REEL_EVENT, time_ms, log, count);
}

void view_play(struct view *view, const uint8_t *fleet, size_t count)
{
    struct played *played = &view->played;

    pthread_mutex_lock(&view->lock);
    if (count > played->room) {
        uint8_t *larger = realloc(played->bytes, count);

        played->bytes = larger != NULL ? larger : played->bytes;
        played->room = larger != NULL ? count : played->room;
    }
    if (count <= played->room) {
        memcpy(played->bytes, fleet, count);
        played->count = count;
        played->number++;
    }
    pthread_mutex_unlock(&view->lock);
    view_wake(view);
}

static char *status_text(const struct view_status *status)
{
    json_t *formations = json_array();

    for (size_t i = 0; i < status->formation_count; i++)
        json_array_append_new(formations, json_string(status->formations[i]));
    return text_of(json_pack("{s:{s:s,s:b,s:b,s:f,s:o}}", "status", "phase", status->phase,
                             "paused", status->paused, "over", status->over, "speed", status->speed,
                             "formations", formations));
}

void view_status(struct view *view, const struct view_status *status)
{
    char *text = status_text(status);
    bool same = text == NULL || (view->status != NULL && strcmp(text, view->status) == 0);

    if (same) {
        free(text);
        return;
    }
    pthread_mutex_lock(&view->lock);
    free(view->status);
    view->status = text;
    view->status_number++;
    pthread_mutex_unlock(&view->lock);
    view_wake(view);
}

/* ---- acts ------------------------------------------------------------------------------ */

bool view_next_act(struct view *view, struct act *act)
{
    eventfd_t value;

    if (view->act_count == 0)
        return false;
    pthread_mutex_lock(&view->lock);
    *act = view->act[view->act_first];
    view->act_first = (view->act_first + 1) % ACTS_MAX;
    if (--view->act_count == 0)
        eventfd_read(view->act_event, &value);
    pthread_mutex_unlock(&view->lock);
    return true;
}

/* When nobody has fetched answers for long the oldest goes. */
void view_answer(struct view *view, const struct act *act, const char *refusal)
{
    struct view_answer answer = {act->viewer, viewer_answer(act->number, refusal)};

    pthread_mutex_lock(&view->lock);
    if (view->answer_count == ANSWERS_MAX) {
        free(view->answer[view->answer_first].text);
        view->answer_first = (view->answer_first + 1) % ANSWERS_MAX;
        view->answer_count--;
    }
    view->answer[(view->answer_first + view->answer_count++) % ANSWERS_MAX] = answer;
    pthread_mutex_unlock(&view->lock);
    view_wake(view);
}

int view_descriptor(const struct view *view)
{
    return view->act_event;
}

size_t view_viewers(const struct view *view)
{
    return view->viewers;
}

bool view_looked_at(const struct view *view)
{
    return view->looked_at;
}
