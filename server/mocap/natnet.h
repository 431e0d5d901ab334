/* natnet.h: OptiTrack's NatNet, 2.5 to 4.2, of which capture.h has the protocol.
 *
 * The layout follows the version that the system tells in its SERVERINFO, or that the options give
 * where it cannot be asked. Every section of a frame is walked to the last byte: what does not end
 * where it should is of another version, and refused. */
#ifndef NATNET_H
#define NATNET_H

#include <stdbool.h>
#include <stdint.h>

#define NATNET_DATA_PORT 1511
#define NATNET_GROUP "239.255.42.99"

/* How a system streams, as far as it has told. */
struct natnet_streaming {
    bool answered;    /* it has sent a SERVERINFO of a version that is known */
    bool told;        /* it has told all that follows; versions below 3.0 do not */
    bool multicast;   /* to `group`; else to each who asks, where they asked from */
    uint16_t port;    /* of ours that frames come to in the group; NATNET_DATA_PORT until told */
    uint8_t group[4]; /* first byte first; NATNET_GROUP's until told */
};

struct natnet_streaming natnet_streaming(const void *session);

#endif
