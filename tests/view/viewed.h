/* viewed.h: a view for tests, on a port that is free, with one run to look at. */
#ifndef VIEWED_H
#define VIEWED_H

#include "client.h"
#include "view.h"

#define VIEWED_PAGE "muster.view.v1"

struct viewed {
    struct view *view;
    const char *url, *token;
    char host[64];   /* HOST:PORT */
    char origin[80]; /* of our own page */
};

void viewed_open(struct viewed *viewed, uint32_t acts);
void viewed_close(struct viewed *viewed);

/* A viewer with our page, that has had its hello. */
void viewed_join(const struct viewed *viewed, struct client *client);

/* A scene of so many bytes of CDR, told from others by its time. */
void viewed_scene(const struct viewed *viewed, int32_t time_ms, size_t count);

/* A request with the token; `rest` begins with the act's word. */
void viewed_ask(const struct viewed *viewed, struct client *client, unsigned number,
                const char *rest);

/* The next act, which is waited for. */
struct act viewed_act(const struct viewed *viewed);

/* The next message is this text. */
void viewed_expect(struct client *client, const char *text);

/* The next text, whatever binary messages come before it; copied to `text`. */
void viewed_text(struct client *client, char *text, size_t room);

#endif
