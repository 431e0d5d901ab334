#include "endpoint_kinds.h"

#include <bluetooth/bluetooth.h>
#include <bluetooth/hci.h>
#include <bluetooth/hci_lib.h>
#include <bluetooth/rfcomm.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

#define CHANNEL_MAX 30

/* "", CHANNEL or CHANNEL@ADDRESS. Without an address the first adapter that is up. */
static bool read_rest(const char *rest, struct sockaddr_rc *address, char *error, size_t room)
{
    const char *at = strchr(rest, '@');
    size_t digits = at == NULL ? strlen(rest) : (size_t)(at - rest);
    int channel = rest[0] == '\0' ? 1 : atoi(rest);

    if (strspn(rest, "0123456789") != digits || channel < 1 || channel > CHANNEL_MAX ||
        (at != NULL && bachk(at + 1) != 0)) {
        snprintf(error, room,
                 "'%s': CHANNEL or CHANNEL@ADDRESS is allowed, a channel from 1 to %d and an "
                 "address such as 00:11:22:33:44:55",
                 rest, CHANNEL_MAX);
        return false;
    }
    *address = (struct sockaddr_rc){.rc_family = AF_BLUETOOTH, .rc_channel = (uint8_t)channel};
    if (at != NULL)
        return str2ba(at + 1, &address->rc_bdaddr) == 0;
    int adapter = hci_get_route(NULL);
    if (adapter >= 0 && hci_devba(adapter, &address->rc_bdaddr) == 0)
        return true;
    snprintf(error, room, "no Bluetooth adapter that is up: %s", strerror(errno));
    return false;
}

bool endpoint_open_rfcomm(struct endpoint *endpoint, const char *rest, char *error, size_t room)
{
    struct sockaddr_rc address;
    char text[18];

    if (!read_rest(rest, &address, error, room))
        return false;
    ba2str(&address.rc_bdaddr, text);
    int fd = socket(AF_BLUETOOTH, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, BTPROTO_RFCOMM);
    endpoint->listener.fd = fd;
    if (fd < 0 || bind(fd, (const struct sockaddr *)&address, sizeof address) != 0 ||
        listen(fd, 1) != 0) {
        snprintf(error, room, "cannot listen on channel %d of the adapter %s: %s",
                 address.rc_channel, text, strerror(errno));
        return false;
    }
    snprintf(endpoint->link, sizeof endpoint->link, "rfcomm:%s/%d", text, address.rc_channel);
    return true;
}
