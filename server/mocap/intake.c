#include "source_state.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/socket.h>

/* At most so much in one go, so that a flood does not keep all else waiting. */
#define DATAGRAMS_MAX 256
#define READS_MAX 16

/* Datagrams may overtake one another by so many frames; else the system has been started anew. */
#define OVERTAKEN_MAX 8

static void tell(struct source *source, const struct capture_frame *frame, int64_t arrival_us)
{
    if (frame == NULL)
        return;
    source->frames++;
    standing_frame(source, loop_now());
    source->owner->frame(source->owner->context, frame, arrival_us);
}

/* Not for every frame where two systems talk at once. */
static void tell_anew(struct source *source, uint32_t number)
{
    int64_t now_us = loop_now();

    if (source->anew_us == 0 || now_us - source->anew_us >= SOURCE_ANEW_US)
        standing_say(source,
                     "frames are numbered from %u again, after %u: the system was started "
                     "anew, or there are two",
                     number, source->number);
    source->anew_us = now_us;
}

static bool overtaken(struct source *source, const struct capture_frame *frame)
{
    uint32_t behind = source->number - frame->number;

    if (!frame->numbered)
        return false;
    if (source->numbered && behind > 0 && behind <= OVERTAKEN_MAX)
        return true;
    if (source->numbered && frame->number < source->number)
        tell_anew(source, frame->number);
    source->numbered = true;
    source->number = frame->number;
    return false;
}

void intake_frame(struct source *source, int64_t arrival_us)
{
    struct newest *newest = &source->newest;

    if (overtaken(source, newest_blank(newest))) {
        newest->skipped++;
        return;
    }
    const struct capture_frame *displaced = newest_hold(newest, arrival_us);
    tell(source, displaced, newest->displaced_us);
    if (source->settings->every)
        intake_flush(source);
}

void intake_flush(struct source *source)
{
    int64_t arrival_us = source->newest.arrival_us;

    tell(source, newest_release(&source->newest), arrival_us);
}

static void told(struct source *source, const char *words)
{
    char system[SOCKET_WORDS_MAX];

    bool again = strcmp(source->told, words) == 0;

    snprintf(source->told, sizeof source->told, "%s", words);
    if (!again && source->system.sin_family != 0)
        standing_say(source, "%s: %s", socket_words(&source->system, system), words);
    else if (!again)
        standing_say(source, "%s", words);
    if (source->standing != STANDING_FLOWING)
        standing_set(source, STANDING_ANSWERED, loop_now());
}

static void broken(struct source *source, const char *words)
{
    source->broken++;
    snprintf(source->amiss, sizeof source->amiss, "%s", words);
}

static void refused(struct source *source, const char *words)
{
    standing_set(source, STANDING_REFUSED, loop_now());
    snprintf(source->amiss, sizeof source->amiss, "%s", words);
    standing_complain(source, "%s", words);
}

static enum capture_news take(struct source *source, const uint8_t *bytes, size_t count,
                              size_t *used, int64_t arrival_us)
{
    char words[CAPTURE_WORDS_MAX] = "";
    struct capture_frame *blank = newest_blank(&source->newest);
    enum capture_news news =
        source->settings->protocol->take(source->session, bytes, count, used, blank, words);

    switch (news) {
    case CAPTURE_NOTHING: break;
    case CAPTURE_FRAME: intake_frame(source, arrival_us); break;
    case CAPTURE_TOLD: told(source, words); break;
    case CAPTURE_BROKEN: broken(source, words); break;
    case CAPTURE_REFUSED: refused(source, words); break;
    }
    return news;
}

size_t intake_feed(struct source *source, const uint8_t *bytes, size_t count, int64_t arrival_us,
                   bool *whole)
{
    size_t total = 0, used = 0;

    *whole = true;
    do {
        enum capture_news news = take(source, bytes + total, count - total, &used, arrival_us);

        total += used;
        *whole = news != CAPTURE_BROKEN && news != CAPTURE_REFUSED;
    } while (*whole && used > 0 && total < count);
    return total;
}

static bool is_stranger(struct source *source, const struct sockaddr_in *from)
{
    if (source->system.sin_family == 0 || from->sin_addr.s_addr == source->system.sin_addr.s_addr)
        return false;
    source->stranger = *from;
    return true;
}

/* What the network says of what was sent: it may be better later. */
static void unreachable(struct source *source, int error)
{
    char system[SOCKET_WORDS_MAX];

    socket_words(&source->system, system);
    if (source->standing == STANDING_FLOWING)
        return;
    if (error == ECONNREFUSED)
        standing_complain(source, "nothing listens at %s: is the system's streaming on?", system);
    else
        standing_complain(source, "%s: %s", system, strerror(error));
}

/* False when there is none. */
static bool take_datagram(struct channel *channel)
{
    struct source *source = channel->source;
    struct sockaddr_in from = {0};
    int64_t arrival_us = 0;
    bool whole;
    ssize_t count = socket_receive(channel->watch.fd, source->datagram, sizeof source->datagram,
                                   &from, channel->empty_us, &arrival_us);

    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK))
        return false;
    if (count < 0)
        unreachable(source, errno);
    else if (!is_stranger(source, &from))
        intake_feed(source, source->datagram, (size_t)count, arrival_us, &whole);
    return true;
}

void intake_datagrams(struct watch *watch, uint32_t events)
{
    struct channel *channel = (struct channel *)watch;
    int64_t now_us = loop_now();

    (void)events;
    for (int i = 0; i < DATAGRAMS_MAX; i++) {
        if (take_datagram(channel))
            continue;
        channel->empty_us = now_us;
        break;
    }
    intake_flush(channel->source);
    source_ask(channel->source, now_us);
}

static void connected(struct source *source)
{
    int64_t now_us = loop_now();
    int error = socket_error(source->command.watch.fd);
    char system[SOCKET_WORDS_MAX];

    if (error != 0) {
        source_lost(source, strerror(error));
        return;
    }
    source->connecting = false;
    loop_watch(source->loop, &source->command.watch, EPOLLIN);
    standing_say(source, "connected to %s", socket_words(&source->system, system));
    standing_set(source, STANDING_ANSWERED, now_us);
    source_ask(source, now_us);
}

/* False when it is lost. */
static bool take_stream(struct source *source)
{
    bool whole;
    size_t used = intake_feed(source, source->stream, source->waiting, loop_now(), &whole);

    source->waiting -= used;
    memmove(source->stream, source->stream + used, source->waiting);
    if (!whole) {
        source_lost(source, source->amiss);
        return false;
    }
    if (source->waiting == sizeof source->stream) {
        source_lost(source, "a message without an end");
        return false;
    }
    return true;
}

/* False when there is nothing, or no stream any more. */
static bool read_stream(struct source *source)
{
    ssize_t count = recv(source->command.watch.fd, source->stream + source->waiting,
                         sizeof source->stream - source->waiting, MSG_DONTWAIT);

    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR))
        return false;
    if (count <= 0) {
        source_lost(source, count == 0 ? "it has closed the connection" : strerror(errno));
        return false;
    }
    source->waiting += (size_t)count;
    return take_stream(source);
}

void intake_stream(struct watch *watch, uint32_t events)
{
    struct source *source = ((struct channel *)watch)->source;

    (void)events;
    if (source->connecting) {
        connected(source);
        return;
    }
    for (int i = 0; i < READS_MAX && read_stream(source); i++)
        ;
    intake_flush(source);
    source_ask(source, loop_now());
}
