/* client.h: a viewer for tests, over a bare socket: it may say and leave out what it likes. What
 * does not come for CLIENT_PATIENCE_S ends the test. */
#ifndef CLIENT_H
#define CLIENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define CLIENT_PATIENCE_S 20

enum client_opcode {
    CLIENT_PART = 0,
    CLIENT_TEXT = 1,
    CLIENT_BINARY = 2,
    CLIENT_CLOSE = 8,
    CLIENT_GONE = 16, /* none: the connection has ended */
};

struct client {
    int fd;
    uint8_t *bytes; /* received and not yet taken */
    size_t count, room;
    size_t taken; /* of them, with the last message */
};

struct client_message {
    enum client_opcode opcode;
    const uint8_t *bytes; /* good until the next one */
    size_t count;
};

/* `url` is the view's, on 127.0.0.1. */
void client_connect(struct client *client, const char *url);
void client_close(struct client *client);

void client_say(struct client *client, const char *bytes, size_t count);

/* Says a whole request and returns the answer's status, its head and body; they are good until the
 * next call. */
struct client_answer {
    int status;
    const char *head, *body;
    size_t count; /* of the body */
};
struct client_answer client_ask(struct client *client, const char *request);

/* A WebSocket with this sub-protocol. NULL leaves out the header. Returns the answer's status: 101;
 * 0 when there was none. */
int client_upgrade(struct client *client, const char *host, const char *protocol,
                   const char *origin);

/* A frame, as small as it can be, masked. */
void client_send(struct client *client, enum client_opcode opcode, bool last, const void *bytes,
                 size_t count);
void client_send_text(struct client *client, const char *text);

struct client_message client_receive(struct client *client);

#endif
