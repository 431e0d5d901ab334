/* view.h: a run for people to look at, and to act on: a page and Foxglove's WebSocket on one port.
 *
 * It lives in a thread of its own. Whoever runs the fleet hands it scenes and events, which are
 * copied and never wait for a viewer; what viewers ask for is taken from a queue. Looking is free
 * to everyone who reaches the port; acting needs the token, in the address that view_url() gives,
 * and a page of this very server. All functions are for one thread, that of the run. */
#ifndef VIEW_H
#define VIEW_H

#include "act.h"

#define VIEW_PORT 8765 /* where Foxglove looks by itself */

struct view_options {
    const char *address; /* of this machine; NULL: loopback */
    uint16_t port;       /* 0: any that is free */
};

/* Reads "PORT", "ADDRESS", "ADDRESS:PORT" or "[ADDRESS]:PORT"; NULL is the default. The address
 * points into `place`, which is changed. False and words in `error`. */
bool view_place(struct view_options *options, char *place, char *error, size_t room);

/* What does not change while a run is looked at. */
struct view_about {
    const char *kind;  /* "sim", "serve", "replay" */
    const char *title; /* the scenario's name */
    double duration;   /* s */
    uint32_t acts;     /* ACT_BIT() of what may be asked for */
};

/* What changes seldom. */
struct view_status {
    const char *phase; /* a word for people: "running", "gathering", "paused", "over", ... */
    bool paused, over;
    double speed; /* asked for, times real time; 0: as fast as it goes */
    size_t formation_count;
    const char *const *formations; /* names that ACT_FORMATION may have */
};

struct view;

/* Starts to serve. NULL and words in `error` when the port is taken and the like. */
struct view *view_open(const struct view_options *options, const struct view_about *about,
                       char *error, size_t room);

/* "http://127.0.0.1:8765/#TOKEN", until the end. */
const char *view_url(const struct view *view);

/* A scene (scene_write) and an event (scene_event_write). The page gets every one that is kept;
 * viewers of Foxglove's kind the newest, at most 30 times a second. */
void view_scene(struct view *view, int32_t time_ms, const uint8_t *fleet, size_t count);

/* Of a run that is over: viewers of Foxglove's kind get the scene played last in place of the
 * newest. The page plays by itself what it was given. */
void view_play(struct view *view, const uint8_t *fleet, size_t count);

void view_event(struct view *view, int32_t time_ms, const uint8_t *log, size_t count);
void view_status(struct view *view, const struct view_status *status);

/* The oldest act not yet taken. False when there is none: that costs no more than a look at a
 * number. */
bool view_next_act(struct view *view, struct act *act);

/* Tells whoever asked. NULL: done; else why not, in words. */
void view_answer(struct view *view, const struct act *act, const char *refusal);

/* Readable while acts are waiting, for poll() or epoll. */
int view_descriptor(const struct view *view);

/* How many are looking. */
size_t view_viewers(const struct view *view);

/* Whether anybody has looked, though he may be gone. */
bool view_looked_at(const struct view *view);

/* Tells the viewers that it is over, and ends. */
void view_close(struct view *view);

#endif
