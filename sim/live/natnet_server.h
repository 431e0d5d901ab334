/* natnet_server.h: the server's side of NatNet, as a motion-capture system speaks it.
 *
 * Pure: writes datagrams of the bit streams 2.5 to 4.2. There are rigid bodies and nothing else: no
 * markers, skeletons or plates. The layouts are those of server/mocap's decoder, written down
 * independently. */
#ifndef LIVE_NATNET_SERVER_H
#define LIVE_NATNET_SERVER_H

#include "capture.h"

/* The longest datagram that UDP carries. */
#define NATNET_DATAGRAM_MAX 65507

/* Ticks a second of the clock that frames are stamped with. */
#define NATNET_CLOCK_HZ 1000000

struct natnet_server {
    uint8_t version[2];
    bool multicast;     /* else each client gets frames of its own */
    uint8_t group[4];   /* multicast: 239.255.42.99, say */
    uint16_t data_port; /* that frames are sent to, or from */
};

/* Whether this version can be written. */
bool natnet_server_speaks(const uint8_t version[2]);

/* A frame. 0 when it does not fit in. */
size_t natnet_server_frame(const struct natnet_server *server, const struct capture_frame *frame,
                           uint8_t *bytes, size_t room);

/* What there is to answer to a client's datagram, 0 when nothing. `frame` has the bodies' names and
 * numbers; `time` is s by the system's clock. `*client` becomes true when the sender wants frames.
 */
size_t natnet_server_answer(const struct natnet_server *server, const struct capture_frame *frame,
                            double time, const uint8_t *request, size_t count, uint8_t *bytes,
                            size_t room, bool *client);

#endif
