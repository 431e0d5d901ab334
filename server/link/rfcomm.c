#define _GNU_SOURCE /* SOCK_NONBLOCK */

#include "stream.h"

#include <bluetooth/bluetooth.h>
#include <bluetooth/hci.h>
#include <bluetooth/hci_lib.h>
#include <bluetooth/rfcomm.h>
#include <bluetooth/sdp.h>
#include <bluetooth/sdp_lib.h>
#include <errno.h>
#include <fcntl.h>
#include <sys/epoll.h>
#include <sys/socket.h>

/* Longer is no use: a search takes 50 to 90 ms, and channel 1 is the one of nearly every module. */
#define SEARCH_US 1000000
#define CHANNEL_DEFAULT 1
#define CHANNEL_MAX 30

/* A link that is dead takes bytes until this is full. */
#define SEND_BUFFER 2048

/* An adapter keeps what it cannot deliver, in a few buffers for all of its links: one robot out of
 * range holds up the others until the link's supervision timeout ends it, after 20 s unless the
 * host says otherwise (Bluetooth Core, HCI_Write_Link_Supervision_Timeout). So it ends when the
 * robot itself takes its link for lost, after 500 ms, in slots of 0.625 ms. A shorter fade costs
 * nobody more than a pause; to page a robot anew takes seconds. */
#define SUPERVISION_SLOTS 800

static bdaddr_t as_bluez(const uint8_t written[6])
{
    bdaddr_t address;

    baswap(&address, (const bdaddr_t *)written);
    return address;
}

/* Without bluetoothd there is nobody to ask for a pairing: low security does without where the
 * robot does. */
static bool set_options(int fd)
{
    struct bt_security security = {.level = BT_SECURITY_LOW};
    int size = SEND_BUFFER;

    return setsockopt(fd, SOL_BLUETOOTH, BT_SECURITY, &security, sizeof security) == 0 &&
           setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &size, sizeof size) == 0;
}

/* The local address picks the adapter. */
static enum stream_step dial_channel(struct stream *stream, uint8_t channel)
{
    struct sockaddr_rc from = {.rc_family = AF_BLUETOOTH, .rc_bdaddr = as_bluez(stream->adapter)};
    struct sockaddr_rc to = {.rc_family = AF_BLUETOOTH,
                             .rc_bdaddr = as_bluez(stream->settings->address.bluetooth),
                             .rc_channel = channel};
    int fd = socket(AF_BLUETOOTH, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, BTPROTO_RFCOMM);

    stream->watch.fd = fd;
    stream->awaited = EPOLLOUT;
    stream->search.channel = channel;
    if (fd < 0 || !set_options(fd) || bind(fd, (struct sockaddr *)&from, sizeof from) != 0)
        return STREAM_FAILED;
    if (connect(fd, (struct sockaddr *)&to, sizeof to) == 0)
        return STREAM_CONNECTED;
    return errno == EINPROGRESS || errno == EAGAIN ? STREAM_UNDER_WAY : STREAM_FAILED;
}

static uint8_t channel_of(const sdp_record_t *record)
{
    sdp_list_t *protocols;

    if (sdp_get_access_protos(record, &protocols) != 0)
        return 0;
    int port = sdp_get_proto_port(protocols, RFCOMM_UUID);
    sdp_list_foreach(protocols, (sdp_list_func_t)sdp_list_free, NULL);
    sdp_list_free(protocols, NULL);
    return port >= 1 && port <= CHANNEL_MAX ? (uint8_t)port : 0;
}

/* The answer is a sequence of records; the first one with a channel counts. */
static void on_answer(uint8_t type, uint16_t status, uint8_t *bytes, size_t size, void *context)
{
    struct channel_search *search = context;
    uint8_t data_type;
    int left = (int)size;
    int length = 0;

    if (type != SDP_SVC_SEARCH_ATTR_RSP || status != 0 || bytes == NULL)
        return;
    int step = sdp_extract_seqtype(bytes, left, &data_type, &length);
    while (step > 0 && step < left && search->found == 0) {
        bytes += step;
        left -= step;
        step = 0;
        sdp_record_t *record = sdp_extract_pdu(bytes, left, &step);
        if (record == NULL)
            return;
        search->found = channel_of(record);
        sdp_record_free(record);
    }
}

/* The session's callback is called from within sdp_process(), and then only. */
static bool ask(struct channel_search *search, int64_t now_us)
{
    uuid_t serial_port;
    uint16_t wanted = SDP_ATTR_PROTO_DESC_LIST;
    sdp_list_t *services = NULL;
    sdp_list_t *attributes = NULL;

    sdp_uuid16_create(&serial_port, SERIAL_PORT_SVCLASS_ID);
    services = sdp_list_append(services, &serial_port);
    attributes = sdp_list_append(attributes, &wanted);
    int rc = sdp_set_notify(search->session, on_answer, search);
    if (rc == 0)
        rc = sdp_service_search_attr_async(search->session, services, SDP_ATTR_REQ_INDIVIDUAL,
                                           attributes);
    sdp_list_free(services, NULL);
    sdp_list_free(attributes, NULL);
    search->asked = true;
    search->until_us = now_us + SEARCH_US;
    return rc == 0;
}

static enum stream_step search_channel(struct stream *stream)
{
    struct channel_search *search = &stream->search;
    bdaddr_t from = as_bluez(stream->adapter);
    bdaddr_t to = as_bluez(stream->settings->address.bluetooth);

    *search = (struct channel_search){.session = sdp_connect(&from, &to, SDP_NON_BLOCKING)};
    if (search->session == NULL)
        return STREAM_FAILED;
    stream->watch.fd = sdp_get_socket(search->session);
    stream->awaited = EPOLLOUT;
    return fcntl(stream->watch.fd, F_SETFD, FD_CLOEXEC) == 0 ? STREAM_UNDER_WAY : STREAM_FAILED;
}

static void end_search(struct stream *stream)
{
    sdp_close(stream->search.session);
    stream->search.session = NULL;
    stream->watch.fd = -1;
}

static enum stream_step dial_found(struct stream *stream)
{
    uint8_t found = stream->search.found;

    loop_forget(stream->loop, &stream->watch);
    end_search(stream);
    return dial_channel(stream, found != 0 ? found : CHANNEL_DEFAULT);
}

static enum stream_step go_on_searching(struct stream *stream, uint32_t events, int64_t now_us)
{
    struct channel_search *search = &stream->search;

    if (search->asked) {
        bool over = events != 0 ? sdp_process(search->session) != 0 : now_us >= search->until_us;
        return over ? dial_found(stream) : STREAM_UNDER_WAY;
    }
    if (events == 0)
        return STREAM_UNDER_WAY;
    int error = stream_error(stream);
    if (error == 0 && ask(search, now_us)) {
        stream->awaited = EPOLLIN;
        return STREAM_UNDER_WAY;
    }
    if (error == 0 || error == ECONNREFUSED) /* a robot without SDP */
        return dial_found(stream);
    errno = error;
    return STREAM_FAILED;
}

static enum stream_step dial(struct stream *stream)
{
    uint8_t channel = stream->settings->address.channel;

    if (channel == 0)
        channel = stream->search.channel;
    return channel != 0 ? dial_channel(stream, channel) : search_channel(stream);
}

static enum stream_step go_on(struct stream *stream, uint32_t events, int64_t now_us)
{
    if (stream->search.session != NULL)
        return go_on_searching(stream, events, now_us);
    if (events == 0)
        return STREAM_UNDER_WAY;
    enum stream_step step = stream_connected(stream);
    if (step == STREAM_FAILED && errno == ECONNREFUSED)
        stream->search.channel = 0; /* to be looked up anew */
    return step;
}

/* A command to the adapter: its answer is not waited for. False with errno. */
static bool limit_supervision(const struct stream *stream)
{
    struct rfcomm_conninfo connection;
    socklen_t size = sizeof connection;
    bdaddr_t own = as_bluez(stream->adapter);
    char adapter[sizeof "00:00:00:00:00:00"];

    if (getsockopt(stream->watch.fd, SOL_RFCOMM, RFCOMM_CONNINFO, &connection, &size) != 0)
        return false;
    ba2str(&own, adapter);
    int hci = hci_open_dev(hci_devid(adapter));
    if (hci < 0)
        return false;
    write_link_supervision_timeout_cp limit = {htobs(connection.hci_handle),
                                               htobs(SUPERVISION_SLOTS)};
    bool sent = hci_send_cmd(hci, OGF_HOST_CTL, OCF_WRITE_LINK_SUPERVISION_TIMEOUT,
                             WRITE_LINK_SUPERVISION_TIMEOUT_CP_SIZE, &limit) == 0;
    hci_close_dev(hci);
    return sent;
}

static const char *settle(struct stream *stream)
{
    return limit_supervision(stream) ? NULL
                                     : "would hold up its adapter for 20 s when it drops out: "
                                       "`muster` may not set that without CAP_NET_RAW";
}

static void hang_up(struct stream *stream)
{
    if (stream->search.session != NULL)
        end_search(stream);
    else
        stream_close(stream);
}

static const char *words(int error)
{
    switch (error) {
    case EHOSTDOWN: return "the robot does not answer: is it on, and near enough?";
    case ETIMEDOUT: return "out of range, or switched off";
    case ECONNRESET: return "the robot's side broke off the link";
    case ECONNREFUSED:
        return "the robot refuses the channel; without one in its address it is looked up";
    case EBUSY:
        return "the robot is in use already: by another program, or by a tty of `rfcomm bind`";
    case EMLINK: return "the adapter has as many links as it can";
    case ECONNABORTED:
    case EHOSTUNREACH:
    case EADDRNOTAVAIL:
    case ENETDOWN:
    case ENODEV:
        return "the adapter is down or unplugged; `hciconfig` can put it up, with `up` behind its "
               "name";
    case EACCES: return "the robot wants to be paired first";
    case EAFNOSUPPORT:
    case EPROTONOSUPPORT: return "this kernel has no RFCOMM: `modprobe rfcomm`";
    default: return NULL;
    }
}

const struct stream_kind stream_rfcomm = {
    .is_socket = true,
    .patience_us = 8000000,
    .dial = dial,
    .go_on = go_on,
    .settle = settle,
    .hang_up = hang_up,
    .words = words,
};
