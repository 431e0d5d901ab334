/* foxglove.h: Foxglove's WebSocket protocol, version 1, as a server of the topics of topic.h.
 *
 * Pure: texts and bytes in and out. github.com/foxglove/ws-protocol has its specification; the
 * sub-protocol's younger name stands for the same. Viewers follow the time that they are told,
 * which is mission time: 0 where that is below 0, for stamps have no sign. */
#ifndef FOXGLOVE_H
#define FOXGLOVE_H

#include "topic.h"

#define FOXGLOVE_PROTOCOL "foxglove.sdk.v1"
#define FOXGLOVE_PROTOCOL_OLD "foxglove.websocket.v1"

/* What one viewer wants. Zeros: nothing. */
struct foxglove {
    bool wanted[TOPIC_COUNT];
    bool fresh[TOPIC_COUNT]; /* set when it begins to want one: the newest message is due at once */
    uint32_t subscription[TOPIC_COUNT]; /* ids that it chose */
};

/* Texts to begin with, in this order, for free(). NULL: no memory. `session` is another one each
 * time that a server starts. */
char *foxglove_server_info(const char *name, const char *session);
char *foxglove_advertise(void);

/* Takes a message of the viewer's: anything. False when it is to be answered by the text `reply`,
 * at least FOXGLOVE_REPLY_MAX bytes. */
#define FOXGLOVE_REPLY_MAX 256
bool foxglove_hear_text(struct foxglove *viewer, const char *text, size_t count, char *reply);
bool foxglove_hear_binary(char *reply); /* whatever it is: nothing is published here */

/* What goes before a message (topic_write, scene_event_write) to a viewer that wants the topic, in
 * one binary message with it. */
#define FOXGLOVE_HEAD 13
void foxglove_head(const struct foxglove *viewer, enum topic topic, int32_t time_ms, uint8_t *head);

/* A binary message that sets a viewer's time: to be sent before what happened then. */
#define FOXGLOVE_TIME 9
void foxglove_time(int32_t time_ms, uint8_t *bytes);

#endif
