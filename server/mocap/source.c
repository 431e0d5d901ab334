#include "source_state.h"

#include "address.h"

#include <arpa/inet.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#define BACKOFF_LEAST_US 500000
#define BACKOFF_MOST_US 5000000
#define CONNECT_US 3000000 /* a stream that is not up after that is dialled anew */
#define ASKS_MAX 8         /* in one go */

static bool is_natnet(const struct source_settings *settings)
{
    return settings->protocol == &natnet_protocol;
}

static enum source_kind kind_of(const struct source_settings *settings)
{
    if (settings->file != NULL)
        return SOURCE_FILE;
    if (settings->protocol->stream)
        return SOURCE_STREAM;
    return settings->protocol->ask != NULL && settings->server != NULL ? SOURCE_ASKED
                                                                       : SOURCE_LISTENED;
}

static bool sensible(const struct source_settings *settings, char *error, size_t room)
{
    const struct capture_protocol *protocol = settings->protocol;
    enum source_kind kind = kind_of(settings);
    const char *amiss = NULL;

    if (kind == SOURCE_FILE && protocol->port != 0)
        amiss = "comes from the network, not from a file";
    else if (kind != SOURCE_FILE && protocol->port == 0)
        amiss = "needs a file";
    else if (kind == SOURCE_STREAM && settings->server == NULL)
        amiss = "needs the host name or address of the system";
    else if (kind == SOURCE_LISTENED && is_natnet(settings) && settings->options.version[0] == 0)
        amiss = "needs the address of the system, or the version that it speaks";
    if (amiss != NULL)
        snprintf(error, room, "%s: %s", protocol->name, amiss);
    return amiss == NULL;
}

static uint16_t port_of(const struct source *source)
{
    const struct source_settings *settings = source->settings;

    bool natnet_data = source->kind == SOURCE_LISTENED && is_natnet(settings);

    if (natnet_data && settings->options.data_port != 0)
        return settings->options.data_port;
    if (settings->port != 0)
        return settings->port;
    return natnet_data ? NATNET_DATA_PORT : settings->protocol->port;
}

static bool find_group(struct source *source, char *error, size_t room)
{
    const char *text = source->settings->group;

    if (text == NULL && source->kind == SOURCE_LISTENED && is_natnet(source->settings) &&
        !source->settings->options.unicast)
        text = NATNET_GROUP;
    source->group = (struct sockaddr_in){.sin_port = htons(port_of(source))};
    if (text == NULL)
        return true;
    source->group.sin_family = AF_INET;
    if (inet_pton(AF_INET, text, &source->group.sin_addr) == 1 &&
        IN_MULTICAST(ntohl(source->group.sin_addr.s_addr)))
        return true;
    snprintf(error, room, "%s: no multicast group, which are 224.0.0.0 to 239.255.255.255", text);
    return false;
}

static bool find_addresses(struct source *source, char *error, size_t room)
{
    const struct source_settings *settings = source->settings;

    if (!find_group(source, error, room))
        return false;
    if (settings->server != NULL &&
        !address_of(settings->server, port_of(source), &source->system, error, room))
        return false;
    return settings->interface == NULL ||
           socket_interface_find(settings->interface, &source->interface, error, room);
}

static bool watch_channel(struct source *source, struct channel *channel, int fd, uint32_t events)
{
    channel->watch.fd = fd;
    channel->empty_us = loop_now();
    return fd >= 0 && loop_watch(source->loop, &channel->watch, events);
}

static void close_channel(struct source *source, struct channel *channel)
{
    if (channel->watch.fd < 0)
        return;
    int error = errno;
    loop_forget(source->loop, &channel->watch);
    close(channel->watch.fd);
    channel->watch.fd = -1;
    errno = error;
}

static void back_off(struct source *source, int64_t now_us)
{
    source->backoff_us = source->backoff_us == 0 ? BACKOFF_LEAST_US : source->backoff_us * 2;
    if (source->backoff_us > BACKOFF_MOST_US)
        source->backoff_us = BACKOFF_MOST_US;
    source->retry_us = now_us + source->backoff_us;
}

/* What is asked, or else what is listened to. */
static const struct sockaddr_in *peer(const struct source *source)
{
    return source->system.sin_family != 0 ? &source->system : &source->group;
}

void source_lost(struct source *source, const char *why)
{
    char system[SOCKET_WORDS_MAX];
    int64_t now_us = loop_now();

    intake_flush(source);
    close_channel(source, &source->command);
    close_channel(source, &source->data);
    if (source->standing != STANDING_REFUSED)
        standing_complain(source, "%s: %s", socket_words(peer(source), system), why);
    standing_set(source, STANDING_NOTHING, now_us);
    back_off(source, now_us);
}

/* Listens to the group, or to a port. False with errno. */
static bool open_data(struct source *source, int64_t now_us)
{
    const struct sockaddr_in *group = &source->group;
    uint16_t port = ntohs(group->sin_port);

    source->data_opened_us = now_us;
    int fd = group->sin_family == 0 ? socket_listen(port)
                                    : socket_join(group->sin_addr, port, &source->interface);
    if (watch_channel(source, &source->data, fd, EPOLLIN))
        return true;
    close_channel(source, &source->data);
    return false;
}

static bool open_stream(struct source *source, int64_t now_us)
{
    int fd = socket_connect(&source->system);

    source->connecting = true;
    if (!watch_channel(source, &source->command, fd, EPOLLOUT))
        return false;
    if (source->settings->options.data_port == 0)
        return true;
    source->group.sin_port = htons(source->settings->options.data_port);
    return open_data(source, now_us);
}

static bool open_datagrams(struct source *source, int64_t now_us)
{
    if (source->kind == SOURCE_LISTENED)
        return open_data(source, now_us);
    return watch_channel(source, &source->command, socket_ask(), EPOLLIN);
}

static void open_network(struct source *source, int64_t now_us)
{
    char system[SOCKET_WORDS_MAX];

    source->settings->protocol->begin(source->session, &source->settings->options);
    source->waiting = 0;
    bool opened = source->kind == SOURCE_STREAM ? open_stream(source, now_us)
                                                : open_datagrams(source, now_us);

    if (!opened) {
        source_lost(source, strerror(errno));
        return;
    }
    source->opened_us = now_us;
    snprintf(source->words, sizeof source->words, "%s: waiting for %s",
             source->settings->protocol->name, socket_words(peer(source), system));
    source_ask(source, now_us);
}

static bool is_open(const struct source *source)
{
    return source->command.watch.fd >= 0 || source->data.watch.fd >= 0;
}

static void join(struct source *source, int64_t now_us)
{
    char group[SOCKET_WORDS_MAX];

    if (source->settings->interface == NULL && source->system.sin_family != 0)
        source->interface = socket_interface_towards(&source->system);
    if (!open_data(source, now_us))
        standing_complain(source, "cannot listen to %s: %s", socket_words(&source->group, group),
                          strerror(errno));
}

/* NatNet's group is joined as soon as the system has told which it is, or somebody its version. */
static void follow_streaming(struct source *source, int64_t now_us)
{
    const struct source_settings *settings = source->settings;
    struct natnet_streaming streaming = natnet_streaming(source->session);
    uint16_t port = settings->options.data_port != 0 ? settings->options.data_port : streaming.port;
    struct sockaddr_in group = {.sin_family = AF_INET, .sin_port = htons(port)};

    if (settings->options.unicast || (!streaming.answered && settings->options.version[0] == 0))
        return;
    memcpy(&group.sin_addr, streaming.group, sizeof group.sin_addr);
    if (settings->group != NULL)
        group.sin_addr = source->group.sin_addr;
    else if (!IN_MULTICAST(ntohl(group.sin_addr.s_addr)))
        inet_pton(AF_INET, NATNET_GROUP, &group.sin_addr);
    if (memcmp(&group, &source->group, sizeof group) != 0)
        close_channel(source, &source->data);
    if (source->data.watch.fd >= 0 || now_us - source->data_opened_us < BACKOFF_LEAST_US)
        return;
    source->group = group;
    join(source, now_us);
}

/* A switch may have forgotten who is in a group: joining again tells it. */
static void join_again(struct source *source, int64_t now_us)
{
    int64_t since_us =
        source->frame_us > source->data_opened_us ? source->frame_us : source->data_opened_us;

    if (source->group.sin_family == 0 || source->data.watch.fd < 0 ||
        now_us - since_us < SOURCE_ANEW_US)
        return;
    close_channel(source, &source->data);
    join(source, now_us);
}

static bool send_bytes(struct source *source, const uint8_t *bytes, size_t count)
{
    const struct sockaddr *to = (const struct sockaddr *)&source->system;
    socklen_t length = source->kind == SOURCE_STREAM ? 0 : sizeof source->system;

    return sendto(source->command.watch.fd, bytes, count, MSG_NOSIGNAL | MSG_DONTWAIT,
                  length > 0 ? to : NULL, length) == (ssize_t)count;
}

/* What a datagram socket could not send is asked for again later. */
void source_ask(struct source *source, int64_t now_us)
{
    const struct capture_protocol *protocol = source->settings->protocol;
    uint8_t bytes[CAPTURE_ASK_MAX];
    bool stream = source->kind == SOURCE_STREAM;

    if (protocol->ask == NULL || source->command.watch.fd < 0 || (stream && source->connecting))
        return;
    for (int i = 0; i < ASKS_MAX; i++) {
        size_t count = protocol->ask(source->session, now_us, bytes, sizeof bytes);

        if (count == 0)
            return;
        if (!send_bytes(source, bytes, count) && stream) {
            source_lost(source, strerror(errno));
            return;
        }
    }
}

static void tend_stream(struct source *source, int64_t now_us)
{
    int64_t since_us =
        source->frame_us > source->standing_us ? source->frame_us : source->standing_us;

    if (source->connecting && now_us - source->opened_us >= CONNECT_US)
        source_lost(source, strerror(ETIMEDOUT));
    else if (!source->connecting && source->standing == STANDING_SILENT &&
             now_us - since_us >= SOURCE_ANEW_US)
        source_lost(source, "silent for too long");
}

void source_tick(struct source *source, int64_t now_us)
{
    if (source->kind != SOURCE_FILE && !is_open(source) && now_us >= source->retry_us)
        open_network(source, now_us);
    if (source->kind == SOURCE_STREAM && is_open(source))
        tend_stream(source, now_us);
    source_ask(source, now_us);
    if (source->kind == SOURCE_ASKED && is_natnet(source->settings))
        follow_streaming(source, now_us);
    join_again(source, now_us);
    standing_judge(source, now_us);
}

const char *source_words(const struct source *source)
{
    return source->words;
}

struct source_count source_counts(const struct source *source)
{
    return (struct source_count){source->frames, source->newest.skipped, source->broken};
}

static void set_up(struct source *source, struct loop *loop, const struct source_settings *settings,
                   const struct source_owner *owner)
{
    struct channel *channels[] = {&source->command, &source->data, &source->timer};

    source->loop = loop;
    source->settings = settings;
    source->owner = owner;
    source->kind = kind_of(settings);
    source->replay.file = -1;
    source->standing_us = source->opened_us = loop_now();
    for (size_t i = 0; i < sizeof channels / sizeof *channels; i++) {
        channels[i]->source = source;
        channels[i]->watch.fd = -1;
        channels[i]->watch.urgent = true;
        channels[i]->watch.ready = intake_datagrams;
    }
    if (source->kind == SOURCE_STREAM)
        source->command.watch.ready = intake_stream;
}

struct source *source_open(struct loop *loop, const struct source_settings *settings,
                           const struct source_owner *owner, char *error, size_t room)
{
    struct source *source;

    if (!sensible(settings, error, room))
        return NULL;
    source = calloc(1, sizeof *source + settings->protocol->session_bytes);
    if (source == NULL) {
        snprintf(error, room, "%s: not enough memory", settings->protocol->name);
        return NULL;
    }
    set_up(source, loop, settings, owner);
    if (!find_addresses(source, error, room) ||
        (source->kind == SOURCE_FILE && !replay_open(source, error, room))) {
        source_close(source);
        return NULL;
    }
    if (source->kind != SOURCE_FILE)
        open_network(source, loop_now());
    return source;
}

void source_close(struct source *source)
{
    if (source == NULL)
        return;
    close_channel(source, &source->command);
    close_channel(source, &source->data);
    close_channel(source, &source->timer);
    replay_close(source);
    free(source);
}
